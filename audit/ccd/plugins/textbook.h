// SPDX-License-Identifier: Apache-2.0
//
// Continuous collision detection as the textbooks have it, without a tolerance: Provot 1997, "Collision and
// self-collision handling in cloth model dedicated to design garments", section 3 (the cubic of coplanarity, then
// barycentric coordinates at its roots). Its time is the unit in which an audit states times.
//
// What was not done: the closed form of the roots (cubic.h says what is in its place); impact zones and rigid groups,
// which are about the response.
//
// What this does not do: give right answers always. Rounding moves roots and barycentric coordinates, and whatever is
// coplanar for the whole step or degenerate at the root is missed.
#pragma once

#include "cubic.h"

namespace noli::plugins {

/// d in the directions a and b, in the least-squares sense: d ~ u a + w b. Not numbers when a and b are parallel.
struct Weights {
  double u, w;
};

inline Weights weights(const Vec& a, const Vec& b, const Vec& d) {
  const double aa = dot(a, a), ab = dot(a, b), bb = dot(b, b), ad = dot(a, d), bd = dot(b, d);
  const double determinant = aa * bb - ab * ab;
  return {(ad * bb - ab * bd) / determinant, (bd * aa - ab * ad) / determinant};
}

/// When the features meet, as the textbook method thinks; a negative number if they do not.
inline double textbook_root(int kind, const Points& x_t0, const Points& x_t1) {
  const Differences d(kind, x_t0, x_t1);
  return first_root(d.coplanarity(), [&](double t) {
    if (kind == NOLI_CCD_EDGE_EDGE) {
      const auto [u, w] = weights(d.p.at(t), d.q.at(t), d.r.at(t));
      return u >= 0 && u <= 1 && w <= 0 && w >= -1;
    }
    const Vec corner = d.p.at(t);
    const auto [u, w] = weights(d.q.at(t) - corner, d.r.at(t) - corner, -1.0 * corner);
    return u >= 0 && w >= 0 && u + w <= 1;
  });
}

/// noli_ccd_query of the textbook method.
inline int textbook_query(int kind, const double x_t0[12], const double x_t1[12], double* time_of_impact) {
  const double root = textbook_root(kind, points(x_t0), points(x_t1));
  if (root < 0) return NOLI_CCD_NO_HIT;
  *time_of_impact = root;
  return NOLI_CCD_HIT;
}

}  // namespace noli::plugins
