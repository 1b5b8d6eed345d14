// SPDX-License-Identifier: Apache-2.0
//
// The textbook method with a tolerance: Bridson, Fedkiw and Anderson 2002, "Robust treatment of collisions, contact and
// friction for cloth animation", section 6. The four points are looked at when they are coplanar (Provot's cubic,
// cubic.h) and at the end of the step; they are in contact if the features are then no further apart than a small
// tolerance (the paper: 1e-6). Here also at the beginning of the step, which the paper leaves to its proximity test.
//
// What was not done: the repulsions; a tolerance relative to the features' size, which later authors have.
//
// What this does not do: keep a promise. A double root that rounding takes away is missed whatever the tolerance, and
// what comes near only between two roots is not seen; what stays within the tolerance without contact counts as a hit.
#include "cubic.h"
#include "distance.h"

namespace {
using namespace noli::plugins;
}

extern "C" uint32_t noli_ccd_version() { return NOLI_CCD_VERSION; }

extern "C" int noli_ccd_query(int kind, const double x_t0[12], const double x_t1[12], double tolerance,
                              double* time_of_impact) {
  const Points begin = points(x_t0), end = points(x_t1), change = change_of(begin, end);
  const auto near = [&](const Points& x) { return distance(kind, x) <= tolerance; };
  double time = 0;
  if (!near(begin)) {
    time = first_root(Differences(kind, begin, end).coplanarity(),
                      [&](double t) { return near(moved(begin, change, t)); });
    if (time < 0 && near(end)) time = 1;
  }
  if (time < 0) return NOLI_CCD_NO_HIT;
  *time_of_impact = time;
  return NOLI_CCD_HIT;
}
