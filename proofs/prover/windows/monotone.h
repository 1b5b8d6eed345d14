// SPDX-License-Identifier: Apache-2.0
//
// Shows with a few inequalities per face that a sheet does not touch itself.
//
// Notation
//   K, r, D   a sheet, its layout and the convex polygon that it covers (proofs/prover/windows/sheet.h); R the edges of
//             a face in the layout, a 2x2 matrix
//   F         the map of K to the positions of the sheet at some time, linear on each face; E the edges of a face there
//   f_u, f_v  tangents of a face, the columns of E R^-1: how fast F moves as the layout moves along its first and its
//             second axis
//   p, q      two vectors;   a = p.f_u, c = q.f_v, 2 b = p.f_v + q.f_u
//
// Claim: if there are p and q with a > 0, c > 0, a c > b^2 for all faces whose layout meets a rectangle Q, then
// different points of K whose layouts are in Q are at different places. Proof. Let d = r(y) - r(x), not zero. The
// segment from r(x) to r(y) is in D and in Q, which are convex. Along it, F changes by d_u f_u + d_v f_v per unit of
// its length |d|, with the tangents of the face that it goes through, and (d_u p + d_v q) . (d_u f_u + d_v f_v) = a
// d_u^2 + 2 b d_u d_v + c d_v^2 > 0. So (d_u p + d_v q) . (F(y) - F(x)) > 0.
//
// The tangents are affine in the positions. So while corners move linearly, the tangents are between those at both
// ends. If corners stray by up to a radius, the tangents stray by that times the entries of R^-1. Faces are stored as a
// box around their tangents at both ends, radii added. The inequalities must hold for the whole box: that of all faces
// together or, with the same p and q, that of each face.
//
// Rounding. Positions are relative to an origin and rounded to float; their radius includes this error. R^-1 is
// replaced by M in float, with |R M - I| <= 2^-16 in each entry, so that E R^-1 is E M times a matrix that differs from
// I by at most 2^-15 in each entry. E M takes a difference, a product and a sum of floats: an error of 3 * 2^-24 of the
// sum of the sizes of its terms. Both errors are less than 2^-14 times the sum of the sizes of all terms of f_u and f_v
// along the same axis.
// Nothing overflows, as positions are below 2^60 and entries of M at most 2^30; products may underflow, by 2^-148 each.
//
// p and q are guessed from the middle of a box; a failure proves nothing.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include <noli/query.h>
#include "proofs/prover/hierarchy.h"

namespace noli {

/// The layout of a face: M by rows. `usable` is false for faces without M.
struct LaidFace {
  std::array<VertexId, 3> vertices;
  std::array<float, 4> m;
  bool usable;
};

/// Takes the face a, b, c of a layout. It is usable only if |R| |M| <= 2^30 (greatest entries), so that the error of
/// the computed R M is below 2^-20.
inline LaidFace laid_face(const std::array<VertexId, 3>& vertices, const Point2& a, const Point2& b, const Point2& c) {
  const double r00 = b[0] - a[0], r01 = c[0] - a[0], r10 = b[1] - a[1], r11 = c[1] - a[1];
  const double per_area = 1 / (r00 * r11 - r01 * r10);
  const std::array<float, 4> m = {static_cast<float>(r11 * per_area), static_cast<float>(-r01 * per_area),
                                  static_cast<float>(-r10 * per_area), static_cast<float>(r00 * per_area)};
  const double most_r = std::max({std::abs(r00), std::abs(r01), std::abs(r10), std::abs(r11)});
  const double most_m = std::max({std::abs(m[0]), std::abs(m[1]), std::abs(m[2]), std::abs(m[3])});
  const std::array<double, 4> off = {r00 * m[0] + r01 * m[2] - 1, r00 * m[1] + r01 * m[3], r10 * m[0] + r11 * m[2],
                                     r10 * m[1] + r11 * m[3] - 1};
  const bool near = std::all_of(off.begin(), off.end(), [](double x) { return std::abs(x) <= 0x1p-17; });
  return {vertices, m, near && most_m <= 0x1p30 && most_r * most_m <= 0x1p30};
}

/// A vertex near a straight line: positions at both ends relative to some origin, and a bound of their errors. The last
/// lane is zero.
struct NearVertex {
  Lanes x_t0, x_t1, radius;
};

/// Bounds of the tangents of some faces. Empty if low is above high.
struct TangentBox {
  Lanes low_u, high_u, low_v, high_v;
};

inline Lanes lanes(float x) { return Lanes{x, x, x, x}; }
inline Lanes absolute(const Lanes& a) { return greatest(a, -a); }

constexpr float unbounded = 0x1p126F;

inline TangentBox empty_tangents() {
  return {lanes(unbounded), lanes(-unbounded), lanes(unbounded), lanes(-unbounded)};
}

inline TangentBox merged(const TangentBox& a, const TangentBox& b) {
  return {least(a.low_u, b.low_u), greatest(a.high_u, b.high_u), least(a.low_v, b.low_v), greatest(a.high_v, b.high_v)};
}

/// The tangents of a face. Precondition: positions and radii are below 2^60.
inline TangentBox tangents_of(const LaidFace& face, const NearVertex& x, const NearVertex& y, const NearVertex& z) {
  if (!face.usable) return {lanes(-unbounded), lanes(unbounded), lanes(-unbounded), lanes(unbounded)};
  const float m00 = face.m[0], m01 = face.m[1], m10 = face.m[2], m11 = face.m[3];
  const Lanes a0 = y.x_t0 - x.x_t0, b0 = z.x_t0 - x.x_t0, a1 = y.x_t1 - x.x_t1, b1 = z.x_t1 - x.x_t1;
  const Lanes u0 = a0 * m00 + b0 * m10, v0 = a0 * m01 + b0 * m11, u1 = a1 * m00 + b1 * m10, v1 = a1 * m01 + b1 * m11;
  const float m0 = std::abs(m00) + std::abs(m01), m1 = std::abs(m10) + std::abs(m11);
  const Lanes a = greatest(absolute(a0), absolute(a1)), b = greatest(absolute(b0), absolute(b1));
  const Lanes stray = (x.radius + y.radius) * m0 + (x.radius + z.radius) * m1;
  // The sum and the products of radii round by 4 * 2^-24 of them; the 2^-14 of `stray` added here is more.
  const Lanes wrong = stray + (a * m0 + b * m1 + stray) * 0x1p-14F + 0x1p-120F;
  return {least(u0, u1) - wrong, greatest(u0, u1) + wrong, least(v0, v1) - wrong, greatest(v0, v1) + wrong};
}

/// p and q.
struct Functionals {
  std::array<double, 3> p, q;
};

/// The functionals for which a = c = 1, b = 0 in the middle of a box.
Functionals functionals_for(const TangentBox& box, int dimension);

/// The least a and c, the greatest |b| of some tangents.
struct Products {
  double a, c, b;
};

Products products(const Functionals& functionals, const TangentBox& box, int dimension);

inline Products merged(const Products& x, const Products& y) {
  return {std::min(x.a, y.a), std::min(x.c, y.c), std::max(x.b, y.b)};
}

/// Whether the inequalities hold for all these tangents; false if any product is NaN.
inline bool hold(const Products& x) {
  return x.a > 0 && x.c > 0 && x.a * x.c > (1 + 0x1p-40) * (x.b * x.b) + 0x1p-1000;
}

/// Whether the inequalities hold for all tangents in the box, with the functionals of its middle.
inline bool is_monotone(const TangentBox& box, int dimension) {
  return hold(products(functionals_for(box, dimension), box, dimension));
}

}  // namespace noli
