// SPDX-License-Identifier: Apache-2.0
//
// How long steps are: figure 2 of Harmon et al., "Asynchronous Contact Mechanics" (2009).
//
// Notation
//   step    of a vertex: the time between two of its breakpoints that follow one another. A window's end is one for all
//           vertices, so no step is longer than a window
//   bin b   the steps from 2^((2 b - 1) / 8) to 2^((2 b + 1) / 8) s, the upper end not included: a quarter of an octave
//           about 2^(b / 4) s
//   share   of a bin: how probable it is that a free vertex, at a random instant of the window, is in a step of it
//
// A window is cut into 2^32 ticks, and a vertex counts for those that its steps take: integers, which add up to 2^32 a
// vertex and are the same everywhere.
//
// What this does not do: pinned and scripted vertices are not counted; no step matters to what they do.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "trajectory/world_lines.h"

namespace noli {

/// The number of the lowest bin.
inline constexpr std::int64_t least_step_bin = -4 * 1023;

/// The number of the bin that a step is in. Precondition: positive and finite; what is subnormal is in the lowest.
std::int64_t step_bin(double step);

/// The lower end of a bin [s]; its upper end is that of the next, and that of the highest the greatest double. Not for
/// results that have to be the same everywhere.
double bin_begin(std::int64_t bin);

struct StepHistogram {
  struct Bin {
    std::int64_t number;
    std::uint64_t ticks;  ///< of all free vertices, positive
    friend bool operator==(const Bin&, const Bin&) = default;
  };

  double smallest = 0;    ///< step [s]; 0: nothing is free. Where clocks that have nothing to do with each other fire
                          ///< at almost the same time, it is as small as rounding
  std::vector<Bin> bins;  ///< ascending; those that are empty are not there

  friend bool operator==(const StepHistogram&, const StepHistogram&) = default;

  std::uint64_t ticks() const;
  /// Adds what is in another one.
  void add(const StepHistogram& other);
  /// The step below which a free vertex is for this share of its time [s], steps being spread over their bin evenly in
  /// their logarithm; 0.5 is the median. Precondition: something is free, 0 <= share <= 1. Not for results that have to
  /// be the same everywhere.
  double quantile(double share) const;
};

/// Of a window. `fixed`: of each vertex, not 0 if it is pinned or scripted.
StepHistogram step_histogram(const WorldLines& lines, std::span<const std::uint8_t> fixed);

}  // namespace noli
