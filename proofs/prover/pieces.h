// SPDX-License-Identifier: Apache-2.0
//
// A parallel loop over many small items.
//
// What this does not do: items may not depend on each other.
#pragma once

#include <algorithm>
#include <cstddef>

#include "kernel/parallel.h"

namespace noli {

/// Calls each(i) for each i in [0, count), consecutive ones together.
template <class Each>
void for_each_in_pieces(std::size_t count, int threads, const Each& each) {
  constexpr std::size_t piece = 2048;
  parallel_for((count + piece - 1) / piece, threads, [&](std::size_t p) {
    const std::size_t end = std::min(count, (p + 1) * piece);
    for (std::size_t i = p * piece; i < end; ++i) each(i);
  });
}

}  // namespace noli
