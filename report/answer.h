// SPDX-License-Identifier: Apache-2.0
//
// What a command answers: pairs for machines, lines for people, and the verdict, which people read last.
//
// Notation
//   pair       `key=value`; a value that has a blank stands in double quotes
//   place      what stands behind the verdict: where, how much, by whom checked
#pragma once

#include <fmt/format.h>

#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "certify/json.h"

namespace noli::report {

/// A key and its value, which may be anything that can be formatted.
struct AnswerPair {
  template <class T>
  AnswerPair(std::string_view name, const T& thing) : key(name), value(fmt::format("{}", thing)) {}

  std::string key, value;
};

/// How many in a second; 0 where there was no time.
inline double rate(double count, double seconds) { return seconds > 0 ? count / seconds : 0; }

class Answer {
 public:
  explicit Answer(std::string_view verdict, std::initializer_list<AnswerPair> pairs = {})
      : verdict_(verdict), pairs_(pairs) {}

  /// Takes the verdict and the pairs from members of the JSON `result`. An array gives its length; null and an empty
  /// string give "none". "accepted=codes/accepted" is a pair `accepted` with the member `accepted` of `codes`.
  /// Precondition: these members exist.
  Answer(const Json& result, const std::vector<std::string>& members);

  void add(AnswerPair pair) { pairs_.push_back(std::move(pair)); }

  std::string text;     ///< lines above the verdict
  std::string details;  ///< more lines, with --verbose
  std::string next;     ///< what to do now, a sentence; empty: nothing
  std::string place;    ///< one line; empty: the pairs

  /// `verdict=WORD key=value ...`, one line.
  std::string porcelain() const;
  /// The text, the details if they are wanted, and what to do: all above the last line.
  std::string text_above(bool verbose) const;
  /// The verdict in capitals: "NO FINDING".
  std::string verdict_word() const;
  /// The verdict as programs know it: "no_finding".
  const std::string& verdict() const { return verdict_; }
  /// The last line: "NO FINDING  queries 10, findings 0". `word`: the verdict as it is shown, in colour perhaps.
  std::string last_line(const std::string& word) const;
  std::string last_line() const { return last_line(verdict_word()); }

 private:
  std::string verdict_;
  std::vector<AnswerPair> pairs_;
};

}  // namespace noli::report
