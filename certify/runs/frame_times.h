// SPDX-License-Identifier: Apache-2.0
//
// At which times a run has frames: at i / rate, i = 0, 1, 2, ...
#pragma once

#include <cstdint>

namespace noli {

/// Calls each(time) for those of window `index`: after its begin, up to its end; the first window also has that at its
/// begin. So each frame is in one window. each() says whether to go on.
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

}  // namespace noli
