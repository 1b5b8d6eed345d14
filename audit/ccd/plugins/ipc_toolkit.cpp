// SPDX-License-Identifier: Apache-2.0
//
// The IPC Toolkit (https://github.com/ipc-sim/ipc-toolkit), written for the interface of version 1.4.0: the class
// ipc::TightInclusionCCD, the narrow phase that its step sizes come from unless told otherwise, with its own default
// settings but for the tolerance. No line of the method is here. It is in no Debian package and fetches what it
// stands on, so it is built where CMake is told where it is: with NOLI_WITH_IPC_TOOLKIT.
//
// What this does not do: ask for the time at which features touch. The toolkit stops before they do, at a fifth of
// their first distance or at 1e-4, whichever is less, so hits are early by design, and what comes nearer than that
// without contact is a hit too.
//
// What was not done: running it. It was compiled against a stand-in for the interface, for lack of the package.
#include <noli/ccd_plugin.h>
#include <ipc/ccd/tight_inclusion_ccd.hpp>

#include "points.h"

extern "C" uint32_t noli_ccd_version() { return NOLI_CCD_VERSION; }

extern "C" const char* noli_ccd_description() { return "IPC Toolkit, as installed"; }

extern "C" int noli_ccd_query(int kind, const double x_t0[12], const double x_t1[12], double tolerance,
                              double* time_of_impact) try {
  const auto x = noli::plugins::points_as<Eigen::Vector3d>(x_t0), y = noli::plugins::points_as<Eigen::Vector3d>(x_t1);
  const ipc::TightInclusionCCD ccd(tolerance > 0 ? tolerance : ipc::TightInclusionCCD::DEFAULT_TOLERANCE);
  double time = 0;
  const bool hit = kind == NOLI_CCD_EDGE_EDGE
                       ? ccd.edge_edge_ccd(x[0], x[1], x[2], x[3], y[0], y[1], y[2], y[3], time)
                       : ccd.point_triangle_ccd(x[0], x[1], x[2], x[3], y[0], y[1], y[2], y[3], time);
  if (!hit) return NOLI_CCD_NO_HIT;
  *time_of_impact = time;
  return NOLI_CCD_HIT;
} catch (...) {
  return NOLI_CCD_FAILED;
}
