// SPDX-License-Identifier: Apache-2.0
//
// The distance of two features at one time, in double precision: Ericson, "Real-Time Collision Detection" (2005),
// sections 5.1.5 and 5.1.9 (closest points of a point and a triangle, and of two segments).
//
// What this does not do: bound its error. Where a face or an edge has no extent, it takes the nearest of the edges or
// points that are left.
#pragma once

#include "points.h"

namespace noli::plugins {

inline double clamped(double s) { return std::clamp(s, 0.0, 1.0); }

/// From the origin to the segment a, b.
inline double distance_to_segment(const Vec& a, const Vec& b) {
  const Vec ab = b - a;
  const double length2 = dot(ab, ab);
  return norm(length2 > 0 ? a + clamped(-dot(a, ab) / length2) * ab : a);
}

/// From the origin to the triangle a, b, c: to its plane where the foot is inside, else to its nearest edge.
inline double distance_to_triangle(const Vec& a, const Vec& b, const Vec& c) {
  const Vec n = cross(b - a, c - a);
  const double n2 = dot(n, n);
  const double to_edges = std::min({distance_to_segment(a, b), distance_to_segment(b, c), distance_to_segment(c, a)});
  const bool inside = n2 > 0 && determinant(n, a, b) >= 0 && determinant(n, b, c) >= 0 && determinant(n, c, a) >= 0;
  return inside ? std::min(to_edges, std::abs(dot(a, n)) / std::sqrt(n2)) : to_edges;
}

/// Between the segments a0, a1 and b0, b1.
inline double distance_of_segments(const Vec& a0, const Vec& a1, const Vec& b0, const Vec& b1) {
  const Vec a = a1 - a0, b = b1 - b0, r = a0 - b0;
  const double ends = std::min({distance_to_segment(b0 - a0, b1 - a0), distance_to_segment(b0 - a1, b1 - a1),
                                distance_to_segment(a0 - b0, a1 - b0), distance_to_segment(a0 - b1, a1 - b1)});
  const double aa = dot(a, a), ab = dot(a, b), bb = dot(b, b), ar = dot(a, r), br = dot(b, r);
  const double denominator = aa * bb - ab * ab;
  if (!(denominator > 0)) return ends;  // parallel, or without extent: an end of one is nearest
  const double s = (ab * br - ar * bb) / denominator, t = (aa * br - ab * ar) / denominator;
  if (!(s >= 0 && s <= 1 && t >= 0 && t <= 1)) return ends;
  return std::min(ends, norm(r + s * a - t * b));
}

/// Of the two features of a query.
inline double distance(int kind, const Points& x) {
  if (kind == NOLI_CCD_EDGE_EDGE) return distance_of_segments(x[0], x[1], x[2], x[3]);
  return distance_to_triangle(x[1] - x[0], x[2] - x[0], x[3] - x[0]);
}

}  // namespace noli::plugins
