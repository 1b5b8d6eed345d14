// SPDX-License-Identifier: Apache-2.0
//
// Finds bodies that begin inside layers of contact, which push them apart from the first moment, and the energy that
// these layers store.
//
// The sum of all energies is that of Simulation::contact_at_start(), up to rounding, or less where one is a least one.
// certify/simulate/start_check.h decides whether anything touches.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "integrator/scene/build_model.h"

namespace noli::integrator {

/// The push between two bodies.
struct StartPush {
  std::array<std::size_t, 2> bodies{};  ///< the lesser first; twice the same one for parts of one body
  double gap = 0;                       ///< the least distance of two of their features [m]
  double thickness = 0;                 ///< of the first layer of these two features [m]
  std::uint32_t layer = 0;              ///< the deepest one that acts, or is counted
  double energy = 0;                    ///< of all layers that act [J]
  bool at_least = false;                ///< there are too many layers and pairs of features to count all
};

/// All pushes at the start, the greatest energy first. Precondition: the model has contact.
template <int Dim>
std::vector<StartPush> find_start_pushes(const BuiltScene<Dim>& scene);

}  // namespace noli::integrator
