// SPDX-License-Identifier: Apache-2.0
//
// Clocks of forces: a force fires at the times k h, k = 1, 2, 3, ..., each the rounded product, never a sum of steps.
#pragma once

#include <cstdint>

namespace noli::integrator {

/// The least k >= 1 with fl(k h) > t. Precondition: h > 0, t >= 0, t / h below 2^52.
inline std::uint64_t first_after(double t, double h) {
  auto k = static_cast<std::uint64_t>(t / h);
  while (k > 0 && static_cast<double>(k) * h > t) --k;
  while (static_cast<double>(k) * h <= t) ++k;
  return k;
}

/// A step, and how often it has been taken.
struct Clock {
  double step = 0;         ///< h [s]
  std::uint64_t next = 1;  ///< k of the next time

  double time() const { return static_cast<double>(next) * step; }
};

}  // namespace noli::integrator
