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

#include <noli/run.h>
#include "trajectory/world_lines.h"

namespace noli {

/// Of a window. `fixed`: of each vertex, not 0 if it is pinned or scripted.
StepHistogram step_histogram(const WorldLines& lines, std::span<const std::uint8_t> fixed);

}  // namespace noli
