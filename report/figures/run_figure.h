// SPDX-License-Identifier: Apache-2.0
//
// Figures of a run, as pictures and as numbers.
//
//   step-histogram   how long the steps of free vertices are over time: figure 2 of Harmon et al. 2009
//                    (certify/runs/step_histogram.h says what is counted)
//   energy           kinetic energy (of velocities half way through the kicks), potentials, their sum, and what damping
//                    has done so far, at the ends of windows
//   momentum         momentum and angular momentum, at the ends of windows
//
// Numbers are of each window; a picture of more windows than it has room for draws neighbours as one.
//
// What this does not do: it computes no motion. In memory: the series of all windows.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "certify/runs/run_series.h"

namespace noli::report {

constexpr std::array<const char*, 3> figure_names = {"step-histogram", "energy", "momentum"};

/// A window of the series.
struct FigureWindow {
  double begin = 0;  ///< [s]
  SeriesRow row;
};

struct FigureData {
  std::string title;  ///< of the scene
  std::uint32_t dimension = 3;
  std::vector<FigureWindow> windows;  ///< at least one
};

struct FigureRequest {
  std::filesystem::path run;
  std::string figure;
  std::string output;  ///< its ending says what is written: .svg or .csv
};

struct FigureOutcome {
  std::uint64_t windows = 0;
  double end = 0;  ///< of the last [s]
  bool open_window = false;
};

/// Throws InputError (no run, a damaged one, one of no windows, of an earlier version), UsageError (no such figure, the
/// output's name, a place that cannot be written to), std::system_error (disk).
FigureOutcome run_figure(const FigureRequest& request);

/// Of each figure, in the order of their names.
using FigureWriters = std::array<std::string (*)(const FigureData&), figure_names.size()>;
/// A first line of names with units, then a line for each window.
FigureWriters csv_writers();
FigureWriters svg_writers();

}  // namespace noli::report
