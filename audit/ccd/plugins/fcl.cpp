// SPDX-License-Identifier: Apache-2.0
//
// FCL, the Flexible Collision Library, as it is installed (https://github.com/flexible-collision-library/fcl; written
// for 0.7): the two functions by which its continuous collision of meshes (continuousCollide with
// CCDC_POLYNOMIAL_SOLVER) asks about a vertex and a face, and about two edges. No line of the method is here; what is
// judged is the code in libfcl.
//
// What this does not do: hand on the tolerance, for FCL has none to be told (its constants are 1e-7 for what counts as
// zero and for the resolution in time, 1e-5 for what counts as inside); use FCL's hierarchies of boxes.
#include <fcl/config.h>
#include <fcl/narrowphase/detail/traversal/collision/intersect.h>
#include <noli/ccd_plugin.h>

#include "points.h"

using Intersect = fcl::detail::Intersect<double>;

extern "C" uint32_t noli_ccd_version() { return NOLI_CCD_VERSION; }

extern "C" const char* noli_ccd_description() { return "FCL " FCL_VERSION ", as installed"; }

extern "C" int noli_ccd_query(int kind, const double x_t0[12], const double x_t1[12], double /*tolerance*/,
                              double* time_of_impact) try {
  const auto x = noli::plugins::points_as<fcl::Vector3d>(x_t0), y = noli::plugins::points_as<fcl::Vector3d>(x_t1);
  fcl::Vector3d place;  // where they meet, which nobody asks
  double time = 2;
  const bool hit =
      kind == NOLI_CCD_EDGE_EDGE
          ? Intersect::intersect_EE(x[0], x[1], x[2], x[3], y[0], y[1], y[2], y[3], &time, &place)
          : Intersect::intersect_VF(x[1], x[2], x[3], x[0], y[1], y[2], y[3], y[0], &time, &place);  // face, vertex
  if (!hit) return NOLI_CCD_NO_HIT;
  *time_of_impact = time;
  return NOLI_CCD_HIT;
} catch (...) {
  return NOLI_CCD_FAILED;
}
