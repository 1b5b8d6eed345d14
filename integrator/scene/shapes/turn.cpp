// SPDX-License-Identifier: Apache-2.0
#include "integrator/scene/shapes/turn.h"

#include <cmath>

namespace noli::integrator {
namespace {

constexpr double quarter_pi = 0x1.921fb54442d18p-1;  ///< pi/4, rounded

/// x in [0, pi/4].
CosSin by_series(double x) {
  if (x == quarter_pi) return {0x1.6a09e667f3bcdp-1, 0x1.6a09e667f3bcdp-1};  // both the same: sqrt(1/2)
  const double y = x * x;
  double cosine = 1, sine = 1;
  for (int n = 18; n >= 2; n -= 2) {
    cosine = 1 - y / (n * (n - 1)) * cosine;
    sine = 1 - y / (n * (n + 1)) * sine;
  }
  return {cosine, x * sine};
}

/// The angle octant * 45 degrees + x in an even octant, (octant + 1) * 45 degrees - x in an odd one; x in [0, pi/4].
CosSin in_octant(unsigned octant, double x) {
  const CosSin a = by_series(x);
  switch (octant) {
    case 0: return {a.cos, a.sin};
    case 1: return {a.sin, a.cos};
    case 2: return {-a.sin, a.cos};
    case 3: return {-a.cos, a.sin};
    case 4: return {-a.cos, -a.sin};
    case 5: return {-a.sin, -a.cos};
    case 6: return {a.sin, -a.cos};
    default: return {a.cos, -a.sin};
  }
}

}  // namespace

CosSin part_of_turn(std::uint64_t k, std::uint64_t n) {
  const std::uint64_t eighths = 8 * (k % n), octant = eighths / n, rest = eighths % n;
  const std::uint64_t part = octant % 2 == 0 ? rest : n - rest;
  return in_octant(static_cast<unsigned>(octant), quarter_pi * (static_cast<double>(part) / static_cast<double>(n)));
}

CosSin of_degrees(double degrees) {
  double rest = std::fmod(degrees, 360.0);  // exact, as every remainder is
  if (rest < 0) {
    const CosSin mirrored = of_degrees(-rest);
    return {mirrored.cos, -mirrored.sin};
  }
  unsigned octant = 0;
  for (; rest >= 45; rest -= 45) ++octant;  // exact: both are multiples of the last place of the greater
  if (octant % 2 == 1) rest = 45 - rest;
  return in_octant(octant, quarter_pi * (rest / 45));
}

}  // namespace noli::integrator
