// SPDX-License-Identifier: Apache-2.0
//
// Histograms of the lengths of steps: figure 2 of Harmon et al., "Asynchronous Contact Mechanics" (2009).
//
// Notation
//   step    of a vertex: the time between two consecutive breakpoints of it. A window's end is a breakpoint of all
//           vertices, so no step is longer than a window
//   bin b   the steps from 2^((2 b - 1) / 8) to 2^((2 b + 1) / 8) s, the upper end not included: a quarter of an octave
//           about 2^(b / 4) s
//   share   of a bin: the probability that a free vertex, at a random instant of the window, is in a step of this bin
//
// A window is cut into 2^32 ticks, and each step of a vertex counts the ticks that it takes. These are integers, which
// add up to 2^32 per vertex and are the same on every machine.
//
// Pinned and scripted vertices are not counted, as their motion does not depend on steps.
#pragma once

#include <cstdint>
#include <span>

#include <noli/run.h>
#include "trajectory/world_lines.h"

namespace noli {

/// The histogram of a window. `fixed`: by vertex, nonzero if it is pinned or scripted.
StepHistogram step_histogram(const WorldLines& lines, std::span<const std::uint8_t> fixed);

}  // namespace noli
