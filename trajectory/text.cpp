// SPDX-License-Identifier: Apache-2.0
#include "trajectory/text.h"

#include <fmt/format.h>

#include <cmath>

#include <noli/errors.h>
#include "trajectory/input_file.h"

namespace noli {

template <class T>
std::string parse_finite(std::string_view word, T& value) {
  const std::errc error = parse_number(word, value);
  if (error == std::errc::result_out_of_range) {
    return fmt::format("{} is outside the range of {}", in_quotes(word), sizeof(T) == 4 ? "float" : "double");
  }
  if (error != std::errc{}) return fmt::format("expected a number, found {}", in_quotes(word));
  if (!std::isfinite(value)) return fmt::format("expected a finite number, found {}", in_quotes(word));
  return {};
}
template std::string parse_finite(std::string_view word, float& value);
template std::string parse_finite(std::string_view word, double& value);

std::string read_whole_file(const std::filesystem::path& path) {
  InputFile file(path);
  std::string bytes = file.read_to_end();
  if (bytes.empty()) throw InputError(path.string(), "", "is empty");
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

std::string message_without_name(std::string_view message, std::string_view name) {
  const std::string begin = on_one_line(name) + ": ";
  if (message.starts_with(begin)) message.remove_prefix(begin.size());
  return std::string(message);
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

std::string escaped_markup(std::string_view text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&': out += "&amp;"; break;
      case '<': out += "&lt;"; break;
      case '>': out += "&gt;"; break;
      case '"': out += "&quot;"; break;
      default:
        if (static_cast<unsigned char>(c) >= 0x20 || c == '\t' || c == '\n' || c == '\r') out += c;
    }
  }
  return out;
}

std::string base64(std::string_view bytes) {
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  const auto byte = [&](std::size_t i) { return i < bytes.size() ? static_cast<unsigned char>(bytes[i]) : 0u; };
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const unsigned group = byte(i) << 16 | byte(i + 1) << 8 | byte(i + 2);
    for (int shift = 18; shift >= 0; shift -= 6) text += digits[group >> shift & 63];
  }
  for (std::size_t missing = (3 - bytes.size() % 3) % 3; missing > 0; --missing) text[text.size() - missing] = '=';
  return text;
}

}  // namespace noli
