// SPDX-License-Identifier: Apache-2.0
#include "noli/trajectory/run_log.h"

#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "noli/trajectory/block_sink.h"

namespace noli {
namespace {

/// How many bytes of the file are whole lines.
std::uint64_t size_of_lines(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::uint64_t size = 0;
  for (std::string line; std::getline(in, line);) {
    if (!in.eof()) size += line.size() + 1;
  }
  return size;
}

}  // namespace

RunLog::RunLog(const std::filesystem::path& folder) {
  const std::filesystem::path path = folder / "log.jsonl";
  const bool exists = std::filesystem::exists(path);
  sink_ = std::make_unique<FileSink>(path, exists ? FileSink::Open::existing : FileSink::Open::create);
  sink_->truncate(size_of_lines(path));
}

RunLog::~RunLog() = default;

void RunLog::append(const nlohmann::ordered_json& entry) {
  sink_->write(entry.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + '\n');
}

}  // namespace noli
