/* SPDX-License-Identifier: Apache-2.0 */
/* A library for `noli audit ccd`: two features meet if the boxes do in which they stay during the step. It misses no
 * contact, and its times are never late; but it says "hit" of much that stays apart. */
#include <noli/ccd_plugin.h>

uint32_t noli_ccd_version(void) { return NOLI_CCD_VERSION; }

/* The least (sign 1) or greatest (sign -1) coordinate of points first, ..., end - 1 along an axis during the step. */
static double extreme(const double* x_t0, const double* x_t1, int first, int end, int axis, int sign) {
  double best = x_t0[3 * first + axis];
  for (int i = first; i < end; ++i) {
    const double a = x_t0[3 * i + axis], b = x_t1[3 * i + axis];
    if (sign * a < sign * best) best = a;
    if (sign * b < sign * best) best = b;
  }
  return best;
}

int noli_ccd_query(int kind, const double x_t0[12], const double x_t1[12], double tolerance, double* time_of_impact) {
  const int second = kind == NOLI_CCD_VERTEX_FACE ? 1 : 2; /* the first point of the second feature */
  (void)tolerance;
  for (int axis = 0; axis < 3; ++axis) {
    if (extreme(x_t0, x_t1, 0, second, axis, 1) > extreme(x_t0, x_t1, second, 4, axis, -1)) return NOLI_CCD_NO_HIT;
    if (extreme(x_t0, x_t1, second, 4, axis, 1) > extreme(x_t0, x_t1, 0, second, axis, -1)) return NOLI_CCD_NO_HIT;
  }
  *time_of_impact = 0;
  return NOLI_CCD_HIT;
}
