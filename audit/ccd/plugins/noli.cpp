// SPDX-License-Identifier: Apache-2.0
//
// Noli's own answers, as a library like any other. The exact arithmetic of include/noli/contact.h; a time of impact is
// the beginning of the kernel's enclosure, early by a part in 2^20 of the step or so. A tolerance of 0 asks for the
// first time itself, rounded down (include/noli/time_of_impact.h), which takes longer.
//
// What this does not do: judge the audit. The truth of an audit is the same kernel's.
#include <noli/ccd_plugin.h>

#include <noli/contact.h>
#include <noli/time_of_impact.h>

namespace {

template <class Query>
int answer(const double* x_t0, const double* x_t1, bool exact_time, double* time_of_impact) {
  Query query;
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      query.x_t0[i][axis] = x_t0[3 * i + axis];
      query.x_t1[i][axis] = x_t1[3 * i + axis];
    }
  }
  const auto enclosure = noli::contact(query);
  if (!enclosure) return NOLI_CCD_NO_HIT;
  *time_of_impact = exact_time ? noli::first_contact(query).value().time.lower() : enclosure->begin;
  return NOLI_CCD_HIT;
}

}  // namespace

extern "C" uint32_t noli_ccd_version() { return NOLI_CCD_VERSION; }

extern "C" int noli_ccd_query(int kind, const double x_t0[12], const double x_t1[12], double tolerance,
                              double* time_of_impact) try {
  if (kind == NOLI_CCD_EDGE_EDGE) return answer<noli::EdgeEdge3>(x_t0, x_t1, tolerance == 0, time_of_impact);
  if (kind == NOLI_CCD_VERTEX_FACE) return answer<noli::VertexFace3>(x_t0, x_t1, tolerance == 0, time_of_impact);
  return NOLI_CCD_FAILED;
} catch (...) {  // no memory
  return NOLI_CCD_FAILED;
}
