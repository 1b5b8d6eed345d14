// SPDX-License-Identifier: Apache-2.0
//
// How every command reads a run: one window at a time, with the row of its series, whose numbers are checked.
//
// The state of a window belongs to the program that wrote it. A run of another program, or of an earlier version of
// this one, has no rows: it is read all the same, until somebody asks for a row.
#pragma once

#include <filesystem>
#include <optional>

#include "certify/runs/run_series.h"
#include "trajectory/blocks/run_file.h"

namespace noli {

class SeriesReader : public RunReader {
 public:
  /// Throws InputError, as RunReader.
  explicit SeriesReader(const std::filesystem::path& run);

  /// As RunReader's. Throws InputError too when the state is a row of this version with numbers that cannot be.
  std::optional<RunWindow> next_window();

  /// Of the window read last. Throws InputError when its state is no row of this version.
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
