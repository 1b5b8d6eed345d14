// SPDX-License-Identifier: Apache-2.0
#include "trajectory/blocks/run_log.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <string_view>

#include <noli/errors.h>
#include "trajectory/blocks/block_sink.h"
#include "trajectory/blocks/crc32c.h"
#include "trajectory/input_file.h"

namespace noli {
namespace {

using Json = nlohmann::ordered_json;

/// Occurs nowhere else in a line: within a JSON string the quotes would be escaped.
constexpr std::string_view seal_begin = R"(,"crc32c":")";
constexpr std::size_t seal_size = seal_begin.size() + 8 + 2;

/// What follows the members of a line.
std::string seal(std::string_view members) { return fmt::format("{}{:08x}\"}}", seal_begin, crc32c(members)); }

std::filesystem::path log_path(const std::filesystem::path& folder) { return folder / "log.jsonl"; }

struct Extent {
  std::uint64_t lines = 0;
  std::uint64_t size = 0;    ///< of whole lines [bytes]
  bool end_missing = false;  ///< the last line lacks its line end
};

class Scan {
 public:
  Scan(std::filesystem::path path, const std::function<void(const Json&)>& take)
      : path_(std::move(path)), take_(take) {}

  Extent operator()() {
    if (!std::filesystem::exists(std::filesystem::status(path_))) return extent_;
    std::ifstream in = open_regular_file(path_);
    for (std::string line; std::getline(in, line);) in.eof() ? take_tail(line) : take(line);
    if (in.bad() || !in.eof())
      throw InputError(path_.string(), "", fmt::format("cannot be read to its end: {}", std::strerror(errno)));
    return extent_;
  }

 private:
  /// A line that is cut off ends before the end of its checksum, or lacks only its line end.
  void take_tail(const std::string& line) {
    const std::size_t at = line.find(seal_begin);
    if (at == std::string::npos || line.size() < at + seal_size) return;
    if (line.size() > at + seal_size) fail("something follows the checksum; expected the end of the line");
    take(line);
    --extent_.size;
    extent_.end_missing = true;
  }

  void take(std::string_view line) {
    const std::string_view members = line.substr(0, line.size() - std::min(seal_size, line.size()));
    const std::string_view end = line.substr(members.size());
    if (!end.starts_with(seal_begin)) fail("expected a line that ends in its checksum, \"crc32c\"");
    if (end != seal(members)) fail("the checksum does not match");
    const Json entry = Json::parse(std::string(members) + '}', nullptr, false);
    if (!entry.is_object()) fail("expected a JSON object");
    take_(entry);
    ++extent_.lines;
    extent_.size += line.size() + 1;
  }

  [[noreturn]] void fail(const std::string& problem) const {
    throw InputError(path_.string(), fmt::format("line {}", extent_.lines + 1),
                     problem +
                         ": the log is damaged, or of an earlier version; without this file the run can be read, but "
                         "not how it ended");
  }

  std::filesystem::path path_;
  const std::function<void(const Json&)>& take_;
  Extent extent_;
};

}  // namespace

std::string log_line(const Json& entry) {
  std::string line = entry.dump(-1, ' ', false, Json::error_handler_t::replace);
  if (!entry.is_object() || entry.empty()) throw std::logic_error("a line of the log without members");
  line.pop_back();
  return line + seal(line) + '\n';
}

void read_log_lines(const std::filesystem::path& folder, const std::function<void(const Json&)>& take) {
  Scan(log_path(folder), take)();
}

RunLog::RunLog(const std::filesystem::path& folder) {
  const std::filesystem::path path = log_path(folder);
  const Extent there = Scan(path, [](const Json&) {})();
  const bool exists = std::filesystem::exists(std::filesystem::symlink_status(path));
  sink_ = std::make_unique<FileSink>(path, exists ? FileSink::Open::existing : FileSink::Open::create);
  sink_->truncate(there.size);
  if (there.end_missing) sink_->write("\n");
}

RunLog::~RunLog() = default;

void RunLog::append(const Json& entry) {
  sink_->write(log_line(entry));
  sink_->sync();
}

}  // namespace noli
