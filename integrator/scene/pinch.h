// SPDX-License-Identifier: Apache-2.0
//
// Scripted bodies that come to touch each other: what is free between them would be pressed to no gap, which takes
// layers without end.
//
// What this does not do: it does not know whether anything will be between them, nor does it look at bodies some of
// whose vertices are free. Positions between breakpoints are rounded.
#pragma once

#include <array>
#include <vector>

#include "integrator/scene/build_model.h"

namespace noli::integrator {

struct Pinch {
  std::array<std::size_t, 2> bodies{};
  double time = 0;  ///< of the first contact, but for rounding [s]
};

/// Pairs of bodies, no vertex of which is free, that are apart at the start and meet before `duration`; the first time
/// of each pair.
template <int Dim>
std::vector<Pinch> find_pinches(const BuiltScene<Dim>& scene, double duration);

}  // namespace noli::integrator
