// SPDX-License-Identifier: Apache-2.0
#include "noli/trajectory/text.h"

#include <fmt/format.h>

#include <cerrno>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <memory>

#include "noli/trajectory/error.h"

namespace noli {
namespace {

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using OpenFile = std::unique_ptr<std::FILE, CloseFile>;

/// Size of a regular file; a guess for anything else (a pipe has none).
std::size_t expected_size(const std::filesystem::path& path) {
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  return error ? std::size_t{1} << 16 : static_cast<std::size_t>(size);
}

/// `error`: what errno said.
[[noreturn]] void fail(const std::string& name, int error, const std::string& problem) {
  if (error == EINTR) throw ReadInterrupted(name);
  throw InputError(name, "", problem);
}

/// Reads to the end of the file, whatever size was expected.
std::string read_to_end(std::FILE* file, std::size_t expected, const std::string& name) {
  std::string bytes(expected + 1, '\0');
  std::size_t used = 0;
  while (const std::size_t got = std::fread(bytes.data() + used, 1, bytes.size() - used, file)) {
    if (std::ferror(file) != 0) break;  // another attempt might wait for more
    used += got;
    if (used == bytes.size()) bytes.resize(2 * used);
  }
  if (std::ferror(file) != 0) fail(name, errno, "cannot be read to its end");
  bytes.resize(used);
  return bytes;
}

template <class T>
std::string parse_finite_as(std::string_view word, T& value) {
  const std::errc error = parse_number(word, value);
  if (error == std::errc::result_out_of_range) {
    return fmt::format("{} is outside the range of {}", in_quotes(word), sizeof(T) == 4 ? "float" : "double");
  }
  if (error != std::errc{}) return fmt::format("expected a number, found {}", in_quotes(word));
  if (!std::isfinite(value)) return fmt::format("expected a finite number, found {}", in_quotes(word));
  return {};
}

}  // namespace

std::string read_whole_file(const std::filesystem::path& path) {
  const std::string name = path.string();
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) throw InputError(name, "", "is a folder, expected a file");
  const OpenFile file(std::fopen(name.c_str(), "rb"));
  if (!file) fail(name, errno, fmt::format("cannot be opened: {}", std::strerror(errno)));
  std::string bytes = read_to_end(file.get(), expected_size(path), name);
  if (bytes.empty()) throw InputError(name, "", "is empty");
  return bytes;
}

std::string line_place(std::size_t line) { return fmt::format("line {}", line); }

std::string byte_place(std::size_t offset) { return fmt::format("byte {}", offset); }

std::string in_quotes(std::string_view word) {
  constexpr std::size_t longest = 40;
  std::string shown = "'";
  for (const char c : word.substr(0, longest)) shown += (c >= ' ' && c <= '~') ? c : '?';
  return shown + (word.size() > longest ? "...'" : "'");
}

std::string first_complaint(std::string_view text) {
  Lines lines(text);
  for (std::string_view line; lines.next(line);) {
    if (line.find(": note: ") == std::string_view::npos) return std::string(line);
  }
  return first_line(text);
}

bool Lines::next(std::string_view& line) {
  if (rest_.empty()) return false;
  const std::size_t end = rest_.find('\n');
  line = rest_.substr(0, end);
  rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
  if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
  number_ = next_number_++;
  return true;
}

std::string parse_finite(std::string_view word, float& value) { return parse_finite_as(word, value); }
std::string parse_finite(std::string_view word, double& value) { return parse_finite_as(word, value); }

}  // namespace noli
