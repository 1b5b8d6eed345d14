// SPDX-License-Identifier: Apache-2.0
//
// The textbook method, without a tolerance (textbook.h has the paper, and what was not done).
#include "textbook.h"

extern "C" uint32_t noli_ccd_version() { return NOLI_CCD_VERSION; }

extern "C" int noli_ccd_query(int kind, const double x_t0[12], const double x_t1[12], double /*tolerance*/,
                              double* time_of_impact) {
  return noli::plugins::textbook_query(kind, x_t0, x_t1, time_of_impact);
}
