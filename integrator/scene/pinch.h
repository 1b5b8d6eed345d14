// SPDX-License-Identifier: Apache-2.0
//
// Finds scripted bodies that come to touch each other: anything free between them would be squeezed to a gap of 0,
// which takes infinitely many layers.
//
// It does not know whether anything will be between them. It ignores bodies with free vertices. Positions between
// breakpoints are rounded.
#pragma once

#include <array>
#include <vector>

#include "integrator/scene/build_model.h"

namespace noli::integrator {

struct Pinch {
  std::array<std::size_t, 2> bodies{};
  double time = 0;  ///< of the first contact, up to rounding [s]
};

/// Pairs of bodies without free vertices that are apart at the start and meet before `duration`; with the first time of
/// each pair.
template <int Dim>
std::vector<Pinch> find_pinches(const BuiltScene<Dim>& scene, double duration);

}  // namespace noli::integrator
