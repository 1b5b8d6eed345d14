// SPDX-License-Identifier: Apache-2.0
//
// The IPC Toolkit (https://github.com/ipc-sim/ipc-toolkit), written for the interface of version 1.4.0: the class
// ipc::TightInclusionCCD, the narrow phase that its step sizes come from unless told otherwise, with its own default
// settings but for the tolerance. No line of the method is here. It is in no Debian package and fetches what it
// stands on, so it is built where CMake is told where it is: with NOLI_WITH_IPC_TOOLKIT.
//
// What this does not do: ask for the time at which features touch. The toolkit stops before they do, at a fifth of
// their first distance, so hits are early by design, and what comes nearer than that without contact is a hit too.
//
// What was not done: running it. It was compiled against a stand-in for the interface, for lack of the package.
#include <ipc/ccd/tight_inclusion_ccd.hpp>

#include "vector.h"

namespace {

Eigen::Vector3d at(const double x[12], std::size_t i) { return {x[3 * i], x[3 * i + 1], x[3 * i + 2]}; }

}  // namespace

extern "C" uint32_t noli_ccd_version() { return NOLI_CCD_VERSION; }

extern "C" const char* noli_ccd_description() { return "IPC Toolkit, as installed"; }

extern "C" int noli_ccd_query(int kind, const double x[12], const double y[12], double tolerance,
                              double* time_of_impact) try {
  const ipc::TightInclusionCCD ccd(tolerance > 0 ? tolerance : ipc::TightInclusionCCD::DEFAULT_TOLERANCE);
  double time = 0;
  const bool hit = kind == NOLI_CCD_EDGE_EDGE ? ccd.edge_edge_ccd(at(x, 0), at(x, 1), at(x, 2), at(x, 3), at(y, 0),
                                                                  at(y, 1), at(y, 2), at(y, 3), time)
                                              : ccd.point_triangle_ccd(at(x, 0), at(x, 1), at(x, 2), at(x, 3), at(y, 0),
                                                                       at(y, 1), at(y, 2), at(y, 3), time);
  if (!hit) return NOLI_CCD_NO_HIT;
  *time_of_impact = time;
  return NOLI_CCD_HIT;
} catch (...) {
  return NOLI_CCD_FAILED;
}
