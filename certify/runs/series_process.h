// SPDX-License-Identifier: Apache-2.0
//
// noli_series (certify/series) at work: bytes go to it, and it says at its end whether it has made a file of them.
#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <stdexcept>
#include <string_view>

#include "certify/process/child.h"

namespace noli {

/// The program ended without a file. what() says why: what it said, or how it ended.
struct SeriesLost : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Whoever waited for the program has stopped.
struct SeriesStopped : std::runtime_error {
  SeriesStopped() : std::runtime_error("stopped") {}
};

struct SeriesProgram {
  std::filesystem::path file;                                   ///< of the program
  std::function<bool()> stop = [] { return false; };            ///< asked while it is waited for
  std::chrono::milliseconds patience{std::chrono::minutes(5)};  ///< for which it may take and say nothing

  /// Whether it is there.
  bool available() const;
};

/// The one that lies beside this program.
SeriesProgram series_program();

/// Ended with this if it has not ended.
class SeriesProcess {
 public:
  /// `output`: the file, open for reading and writing. Throws std::system_error when it cannot be started.
  SeriesProcess(const SeriesProgram& program, int output);

  /// Throws SeriesLost, SeriesStopped, std::system_error; nothing may follow then.
  void write(std::string_view bytes);
  /// Waits until it has made its file. Throws the same.
  void finish();

 private:
  [[noreturn]] void took_nothing() const;

  ProgramLimits limits_;
  Child child_;
};

}  // namespace noli
