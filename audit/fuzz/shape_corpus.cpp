// SPDX-License-Identifier: Apache-2.0
#include "audit/fuzz/shape_corpus.h"

#include <algorithm>
#include <system_error>
#include <utility>

#include "trajectory/blocks/sha256.h"
#include "trajectory/text.h"
#include "trajectory/write_file.h"

namespace noli::audit {

namespace fs = std::filesystem;

ShapeCorpus::ShapeCorpus(fs::path folder) : folder_(std::move(folder)) {
  for (const auto& entry : fs::directory_iterator(folder_)) {
    const fs::path shape = entry.path() / "shape";
    if (!fs::exists(shape)) continue;
    names_.push_back(entry.path().filename().string());
    shapes_.insert(first_line(read_whole_file(shape)));
  }
  std::ranges::sort(names_);
}

void ShapeCorpus::add(const std::string& shape, const std::function<void(const fs::path&)>& write) {
  const std::string name = "shape-" + hex(sha256(shape)).substr(0, 16);
  try {
    fs::create_directories(folder(name));
    write(folder(name));
    write_file(folder(name) / "shape", shape + '\n');
  } catch (...) {
    std::error_code ignored;  // what cannot be removed has no shape, and is passed over
    fs::remove_all(folder(name), ignored);
    throw;
  }
  names_.push_back(name);
}

std::string without_numbers(std::string_view message) {
  const auto digit = [](char c) { return c >= '0' && c <= '9'; };
  std::string words;
  for (std::size_t i = 0; i < message.size() && words.size() < 160; ++i) {
    if (!digit(message[i])) words += message[i];
    if (digit(message[i]) && !(i > 0 && digit(message[i - 1]))) words += '#';
  }
  return words;
}

}  // namespace noli::audit
