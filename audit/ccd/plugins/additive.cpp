// SPDX-License-Identifier: Apache-2.0
//
// Additive continuous collision detection: Li, Kaufman and Jiang 2021, "Codimensional incremental potential contact",
// section 6 (Algorithm 1), with the conservative rescaling 0.9, that is s = 0.1, and without thickness (xi = 0).
//
// Notation
//   p      displacements, relative to their mean
//   l      a bound on the speed at which the features approach: the largest |p| of the one plus that of the other
//   g      the gap at which the method stops: s times the distance at the beginning
// While the distance is d, time may go on by (1 - s) d / l; the steps are added up until the gap is g or the step ends.
//
// What was not done: the thickness xi, and the energies and constraint sets of the paper. The tolerance is not used,
// for the method has none: it stops a tenth of the first distance away, so hits are early by design, and what comes
// nearer than that without contact is a hit too.
//
// What this does not do: bound the error of its distances. A limit on the number of steps is ours; there the hit is
// reported at the time that was reached, which is safe.
#include "distance.h"

namespace {

using namespace noli::plugins;

constexpr double s = 0.1;
constexpr int most_steps = 100'000;

Points without_mean(Points p) {
  const Vec mean = 0.25 * (p[0] + p[1] + p[2] + p[3]);
  for (Vec& x : p) x = x - mean;
  return p;
}

double greatest(const Points& p, std::size_t begin, std::size_t end) {
  double best = 0;
  for (std::size_t i = begin; i < end; ++i) best = std::max(best, norm(p[i]));
  return best;
}

}  // namespace

extern "C" uint32_t noli_ccd_version() { return NOLI_CCD_VERSION; }

extern "C" int noli_ccd_query(int kind, const double x_t0[12], const double x_t1[12], double /*tolerance*/,
                              double* time_of_impact) {
  Points x = points(x_t0);
  const Points p = without_mean(change_of(x, points(x_t1)));
  const std::size_t second = kind == NOLI_CCD_EDGE_EDGE ? 2 : 1;
  const double l = greatest(p, 0, second) + greatest(p, second, 4);
  double d = distance(kind, x), t = 0;
  if (d > 0) {
    if (l == 0) return NOLI_CCD_NO_HIT;
    const double g = s * d;
    for (int step = 0; step < most_steps; ++step) {
      const double dt = (1 - s) * d / l;
      x = moved(x, p, dt);
      d = distance(kind, x);
      if (t > 0 && d < g) break;
      t += dt;
      if (t > 1) return NOLI_CCD_NO_HIT;
    }
  }
  *time_of_impact = t;
  return NOLI_CCD_HIT;
}
