// SPDX-License-Identifier: Apache-2.0
//
// How near features came in a window, as seen by the layers of contact that acted.
//
// A layer acts only at its own times, so a pair may have been nearer in between; certify/simulate/exact_gap.h decides
// how near. The extremes are a property of the motion: they do not depend on how many layers certificates activate.
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
  double distance = 0;         ///< as computed by the layer [m]
  std::uint16_t material = 0;  ///< of ContactSettings::materials
  std::uint32_t layer = 0;
};

/// The extreme actions of a window; the first one of several.
struct ContactExtremes {
  std::optional<LayerAction> deepest, nearest;

  void add(const LayerAction& action) {
    if (!deepest || action.layer > deepest->layer) deepest = action;
    if (!nearest || action.distance < nearest->distance) nearest = action;
  }
};

/// A pair came too near: it is at distance 0, needs more layers than the scene allows, or needs a layer whose steps are
/// too short to tell one time from the next.
struct ContactLimit : std::runtime_error {
  ContactLimit(const certificates::Stencil& which, double when)
      : std::runtime_error("contact: a pair of features needs more layers than allowed"), pair(which), time(when) {}
  certificates::Stencil pair;
  double time;  ///< [s]
};

}  // namespace noli::integrator
