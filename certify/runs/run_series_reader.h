// SPDX-License-Identifier: Apache-2.0
//
// Reads a run for every command: one window at a time, with the checked row of its series.
//
// The state of a window belongs to the program that wrote it. A run of another program, of an earlier version of this
// one, or of a repair has no rows: it can be read, but asking for a row is an error.
#pragma once

#include <filesystem>
#include <optional>

#include "certify/runs/run_series.h"
#include "trajectory/blocks/run_file.h"

namespace noli {

class SeriesReader : public RunReader {
 public:
  /// Throws InputError, like RunReader.
  explicit SeriesReader(const std::filesystem::path& run);

  /// Like RunReader's. Also throws InputError when the state is a row of this version with impossible numbers.
  std::optional<RunWindow> next_window();

  /// Like RunReader's. The row of the next window is then not compared with that of the one before it.
  void skip_to(const CommitPoint& commit);

  /// The state of the last window read. Throws InputError when it is not a row of this version.
  const WindowState& state() const;
  const SeriesRow& row() const { return state().row; }

 private:
  void take_row(const RunWindow& window);
  [[noreturn]] void refuse(const std::string& problem) const;

  std::filesystem::path run_;
  std::optional<WindowState> state_;
  std::string why_none_;  ///< why the series is missing
};

}  // namespace noli
