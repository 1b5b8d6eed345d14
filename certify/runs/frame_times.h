// SPDX-License-Identifier: Apache-2.0
//
// The frames of a run: those that it recorded, or those at the times i / rate, i = 0, 1, 2, ...
#pragma once

#include <fmt/format.h>

#include <cstdint>

#include <noli/errors.h>
#include "trajectory/blocks/run_file.h"
#include "trajectory/sample.h"

namespace noli {

/// Calls each(time) for the frames of window `index`: after its begin, up to its end; the first window also has the
/// frame at its begin. So each frame is in one window. each() returns whether to go on.
template <class Each>
void for_each_frame_time(std::uint64_t index, double begin, double end, double rate, const Each& each) {
  const double first = begin * rate - 1;
  auto i = first > 0 ? static_cast<std::uint64_t>(first) : 0;
  for (;; ++i) {
    const double t = static_cast<double>(i) / rate;
    if (t > end) return;
    if ((t > begin || (index == 0 && t == begin)) && !each(t)) return;
  }
}

/// Calls each(time, positions) for the frames of a window that was read. If the run recorded only frames, it takes
/// those and ignores the rate. each() returns whether to go on. Throws UsageError if there are too many.
template <class Each>
void for_each_frame(const RunWindow& window, double rate, const Each& each) {
  if (!window.lines) {
    for (const RunFrame& frame : window.frames) {
      if (!each(frame.time, frame.positions)) return;
    }
    return;
  }
  constexpr double most = 1e6;
  if (!(window.end * rate <= most)) {
    throw UsageError(fmt::format("--fps {}: expected at most {:.0f} frames up to {} s", rate, most, window.end));
  }
  for_each_frame_time(window.index, window.begin, window.end, rate,
                      [&](double t) { return each(t, sample(*window.lines, t)); });
}

}  // namespace noli
