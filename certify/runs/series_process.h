// SPDX-License-Identifier: Apache-2.0
//
// Runs noli_series (certify/series): sends it bytes, and learns when it ends whether it has made a file of them.
#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <stdexcept>
#include <string_view>

#include "certify/process/child.h"

namespace noli {

/// The program ended without a file. what() says why: its message, or how it ended.
struct SeriesLost : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The caller was stopped while it waited for the program.
struct SeriesStopped : std::runtime_error {
  SeriesStopped() : std::runtime_error("stopped") {}
};

struct SeriesProgram {
  std::filesystem::path file;                                   ///< the program
  std::function<bool()> stop = [] { return false; };            ///< polled while waiting for it
  std::chrono::milliseconds patience{std::chrono::minutes(5)};  ///< how long it may neither read nor write

  /// Whether the program exists.
  bool available() const;
};

/// The noli_series in the folder of this program.
SeriesProgram series_program();

/// The destructor ends the process if it has not ended.
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
