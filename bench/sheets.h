// SPDX-License-Identifier: Apache-2.0
//
// A generated pair of frames of any size, to see how the work grows: two rough square sheets, one above the other, that
// fall together while the upper one comes down on the lower one.
#pragma once

#include <cstddef>
#include <vector>

#include <noli/mesh.h>

namespace noli::bench {

struct Step {
  Mesh mesh;
  std::vector<Position> x_t0, x_t1;
};

/// At least `faces` faces in all, cells of length 1. The same for the same number, everywhere: no random numbers, no
/// libm. There is contact here and there, as much per face whatever the size.
Step falling_sheets(std::size_t faces);

}  // namespace noli::bench
