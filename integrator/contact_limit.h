// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdexcept>

#include "certificates/stencil.h"

namespace noli::integrator {

/// A pair came so near that it would need more layers than the scene allows, or one whose steps are too short to tell
/// one time from the next, or to no distance at all.
struct ContactLimit : std::runtime_error {
  ContactLimit(const certificates::Stencil& which, double when)
      : std::runtime_error("contact: a pair of features needs more layers than allowed"), pair(which), time(when) {}
  certificates::Stencil pair;
  double time;  ///< [s]
};

}  // namespace noli::integrator
