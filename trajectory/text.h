// SPDX-License-Identifier: Apache-2.0
//
// Shared by the readers of text: lines with their numbers, words, numbers that are a whole word, and loading a file.
// Shared by the writers of XML and HTML: escaped text, and base64.
//
// Nothing here depends on the locale; decimal numbers are rounded correctly (std::from_chars).
#pragma once

#include <charconv>
#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>

namespace noli {

/// The bytes of a file. Throws as InputFile does, and InputError when it is empty.
std::string read_whole_file(const std::filesystem::path& path);

/// "line 12", "byte 345": places for InputError.
std::string line_place(std::size_t line);
std::string byte_place(std::size_t offset);

/// A word of the file in quotes for a one-line message: shortened when long, with '?' for unprintable bytes.
std::string in_quotes(std::string_view word);

/// The text before the first line end.
inline std::string first_line(std::string_view text) { return std::string(text.substr(0, text.find('\n'))); }

/// The message of an InputError without the name of the file that it is about.
std::string message_without_name(std::string_view message, std::string_view name);

/// The first line of a program's standard error that is not a note ("noli: note: ..."); a note if all lines are.
std::string first_complaint(std::string_view text);

/// Walks over the lines of a text. A line ends with LF or CRLF; the last one may end with the text.
class Lines {
 public:
  /// `first` is the number of the first line of `text` in its file.
  explicit Lines(std::string_view text, std::size_t first = 1) : rest_(text), next_number_(first) {}

  /// Moves to the next line, without its line end, and returns whether there was one.
  bool next(std::string_view& line);
  /// Number of the line that next() gave last; 0 before the first.
  std::size_t number() const { return number_; }
  /// What follows the line that next() gave last.
  std::string_view rest() const { return rest_; }

 private:
  std::string_view rest_;
  std::size_t next_number_;
  std::size_t number_ = 0;
};

inline bool is_blank(char c) { return c == ' ' || c == '\t'; }

/// Walks over the words of a line, which are separated by blanks and tabs. Words are short: looking at each character
/// is faster than a search.
class Words {
 public:
  explicit Words(std::string_view line) : rest_(line) {}

  /// The next word, empty when there is none.
  std::string_view next() {
    skip_blanks();
    std::size_t end = 0;
    while (end < rest_.size() && !is_blank(rest_[end])) ++end;
    const std::string_view word = rest_.substr(0, end);
    rest_.remove_prefix(end);
    return word;
  }
  bool at_end() {
    skip_blanks();
    return rest_.empty();
  }

 private:
  void skip_blanks() {
    while (!rest_.empty() && is_blank(rest_.front())) rest_.remove_prefix(1);
  }
  std::string_view rest_;
};

/// Escapes text for content and attributes of XML and HTML. Characters that XML does not allow are dropped.
std::string escaped_markup(std::string_view text);

/// Encodes bytes as text in base64 (RFC 4648, section 4).
std::string base64(std::string_view bytes);

/// Parses the whole of `word` as a number of type T (a leading '+' is allowed). Returns an error code like
/// std::from_chars: invalid_argument when it is not such a number, result_out_of_range when T cannot hold it.
template <class T>
std::errc parse_number(std::string_view word, T& value) {
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (end != word.data() + word.size()) return std::errc::invalid_argument;
  return error;
}

/// Parses the whole of `word` as a finite T, float or double, correctly rounded. Returns "" on success, otherwise what
/// is wrong with the word.
template <class T>
std::string parse_finite(std::string_view word, T& value);

}  // namespace noli
