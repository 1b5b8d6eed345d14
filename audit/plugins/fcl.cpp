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

#include "vector.h"

namespace {

using Intersect = fcl::detail::Intersect<double>;

fcl::Vector3d at(const double x[12], std::size_t i) { return {x[3 * i], x[3 * i + 1], x[3 * i + 2]}; }

}  // namespace

extern "C" uint32_t noli_ccd_version() { return NOLI_CCD_VERSION; }

extern "C" const char* noli_ccd_description() { return "FCL " FCL_VERSION ", as installed"; }

extern "C" int noli_ccd_query(int kind, const double x[12], const double y[12], double /*tolerance*/,
                              double* time_of_impact) try {
  fcl::Vector3d place;  // where they meet, which nobody asks
  double time = 2;
  const bool hit = kind == NOLI_CCD_EDGE_EDGE
                       ? Intersect::intersect_EE(at(x, 0), at(x, 1), at(x, 2), at(x, 3), at(y, 0), at(y, 1), at(y, 2),
                                                 at(y, 3), &time, &place)
                       : Intersect::intersect_VF(at(x, 1), at(x, 2), at(x, 3), at(x, 0), at(y, 1), at(y, 2), at(y, 3),
                                                 at(y, 0), &time, &place);  // the face comes first
  if (!hit) return NOLI_CCD_NO_HIT;
  *time_of_impact = time;
  return NOLI_CCD_HIT;
} catch (...) {
  return NOLI_CCD_FAILED;
}
