// SPDX-License-Identifier: Apache-2.0
//
// How near things came in a window, as far as layers of contact that acted have seen it.
//
// A layer acts at its own times only, so a pair may have been nearer between them: certify/simulate/exact_gap.h says
// how near. What is kept is a property of the motion: certificates, which decide how many layers are looked at, do not
// change it.
#pragma once

#include <cstdint>
#include <optional>
#include <stdexcept>

#include "certificates/stencil.h"

namespace noli::integrator {

/// A layer that acts on a pair.
struct LayerAction {
  certificates::Stencil pair;
  double time = 0;             ///< [s]
  double distance = 0;         ///< as it was computed [m]
  std::uint16_t material = 0;  ///< of ContactSettings::materials
  std::uint32_t layer = 0;
};

/// Of the actions of a window; of several, the first.
struct ContactExtremes {
  std::optional<LayerAction> deepest, nearest;

  void add(const LayerAction& action) {
    if (!deepest || action.layer > deepest->layer) deepest = action;
    if (!nearest || action.distance < nearest->distance) nearest = action;
  }
};

/// A pair came so near that it would need more layers than the scene allows, or one whose steps are too short to tell
/// one time from the next, or to no distance at all.
struct ContactLimit : std::runtime_error {
  ContactLimit(const certificates::Stencil& which, double when)
      : std::runtime_error("contact: a pair of features needs more layers than allowed"), pair(which), time(when) {}
  certificates::Stencil pair;
  double time;  ///< [s]
};

}  // namespace noli::integrator
