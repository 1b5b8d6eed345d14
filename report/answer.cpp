// SPDX-License-Identifier: Apache-2.0
#include "report/answer.h"

#include <algorithm>

#include <noli/errors.h>

namespace noli::report {
namespace {

/// "no_finding" is "NO FINDING".
std::string in_capitals(std::string word) {
  std::ranges::transform(word, word.begin(), [](char c) {
    if (c == '_') return ' ';
    return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  });
  return word;
}

std::string quoted_if_needed(const std::string& value) {
  const bool plain = !value.empty() && value.find_first_of(" \t\"") == std::string::npos;
  if (plain) return value;
  std::string text = "\"";
  for (const char c : value) text += c == '"' ? "'" : std::string(1, c);
  return text + '"';
}

std::string value_text(const Json& value) {
  if (value.is_array()) return std::to_string(value.size());
  if (value.is_number_float()) return digits17(value.get<double>());
  const std::string text = value.is_string() ? value.get<std::string>() : value.is_null() ? "" : value.dump();
  return text.empty() ? "none" : text;
}

}  // namespace

Answer::Answer(const Json& result, const std::vector<std::string>& members)
    : verdict_(result.at("verdict").get<std::string>()) {
  for (const std::string& member : members) {
    const std::size_t at = member.find('=');
    const std::string path = at == std::string::npos ? member : member.substr(at + 1);
    add({member.substr(0, at), value_text(result.at(Json::json_pointer("/" + path)))});
  }
}

std::string Answer::porcelain() const {
  std::string line = "verdict=" + verdict_;
  for (const auto& [key, value] : pairs_) line += ' ' + key + '=' + quoted_if_needed(on_one_line(value));
  return line + '\n';
}

std::string Answer::verdict_word() const { return in_capitals(verdict_); }

std::string Answer::last_line(const std::string& word) const {
  std::string behind = place;
  if (behind.empty()) {
    for (const auto& [key, value] : pairs_) behind += (behind.empty() ? "" : ", ") + key + ' ' + on_one_line(value);
  }
  return word + (behind.empty() ? "" : "  " + behind);
}

std::string Answer::text_above(bool verbose) const {
  return text + (verbose ? details : "") + (next.empty() ? "" : "Next: " + next + '\n');
}

}  // namespace noli::report
