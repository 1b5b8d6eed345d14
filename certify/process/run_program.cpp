// SPDX-License-Identifier: Apache-2.0
#include "certify/process/run_program.h"

#include <string_view>
#include <utility>

namespace noli {
namespace {

/// Whether the word needs no quotes in a shell.
bool plain(const std::string& word) {
  constexpr std::string_view harmless = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_./-+=,:@%";
  return !word.empty() && word.find_first_not_of(harmless) == std::string::npos;
}

std::string shell_word(const std::string& word) {
  if (plain(word)) return word;
  std::string result = "'";
  for (const char c : word) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return result + "'";
}

}  // namespace

ProgramEnd run_program(std::vector<std::string> words, const ProgramLimits& limits) {
  return Child(std::move(words), {.out = Child::piped, .err = Child::piped}).finish(limits);
}

std::string shell_words(const std::vector<std::string>& words) {
  std::string line;
  for (const std::string& word : words) line += (line.empty() ? "" : " ") + shell_word(word);
  return line;
}

}  // namespace noli
