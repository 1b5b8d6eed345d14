// SPDX-License-Identifier: Apache-2.0
//
// Computes knot invariants from the curves of a run: integers that no motion without contact changes.
//
// Notation
//   crossing   of two segments of curves in a projection along one direction; its sign is that of (over x under)_z,
//              both along their curves
//
// No vertex may project exactly onto a segment. The direction used is not an axis, to avoid this.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include <noli/mesh.h>

namespace noli::app_tests {

using Curve = std::vector<Position>;

struct Crossing {
  double along_a = 0, along_b = 0;  ///< segment plus fraction of it, on each curve
  bool a_over = false;
  int sign = 0;
};

/// The point, rotated to a direction of view that no scene is aligned with.
inline Position seen_aslant(const Position& p) {
  return {0.8 * p[0] - 0.6 * p[1] + 0.05 * p[2], 0.48 * p[0] + 0.64 * p[1] - 0.6 * p[2],
          0.36 * p[0] + 0.48 * p[1] + 0.8 * p[2]};
}

/// Adds the crossing of segments i of a and j of b, if they cross. The last segment returns to the beginning.
inline void add_crossing(const Curve& a, std::size_t i, const Curve& b, std::size_t j, std::vector<Crossing>& to) {
  const Position p = a[i], q = a[(i + 1) % a.size()], r = b[j], s = b[(j + 1) % b.size()];
  const double ax = q[0] - p[0], ay = q[1] - p[1], bx = s[0] - r[0], by = s[1] - r[1];
  const double det = ax * by - ay * bx;
  if (det == 0) return;
  const double u = ((r[0] - p[0]) * by - (r[1] - p[1]) * bx) / det;
  const double v = ((r[0] - p[0]) * ay - (r[1] - p[1]) * ax) / det;
  if (!(0 <= u && u < 1 && 0 <= v && v < 1)) return;
  const bool over = p[2] + u * (q[2] - p[2]) > r[2] + v * (s[2] - r[2]);
  to.push_back({static_cast<double>(i) + u, static_cast<double>(j) + v, over, (det > 0) == over ? 1 : -1});
}

inline Curve aslant(std::span<const Position> curve) {
  Curve result;
  for (const Position& p : curve) result.push_back(seen_aslant(p));
  return result;
}

/// How often two closed curves wind around each other.
inline int linking_number(std::span<const Position> first, std::span<const Position> second) {
  const Curve a = aslant(first), b = aslant(second);
  std::vector<Crossing> crossings;
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; j < b.size(); ++j) add_crossing(a, i, b, j, crossings);
  }
  int sum = 0;
  for (const Crossing& c : crossings) sum += c.sign;
  return sum / 2;
}

/// Vassiliev's invariant of degree 2 of an open curve whose ends are outside of everything else: 0 for a curve that can
/// be pulled straight, 1 for a trefoil, -1 for a figure of eight. By the formula of Polyak and Viro ("Gauss diagram
/// formulas for Vassiliev invariants", 1994), it is the sum of sign(i) sign(j) over crossings i, j passed in the order
/// i, j, i, j, first i below, then j above.
inline int degree_two_invariant(std::span<const Position> curve) {
  const Curve a = aslant(curve);
  std::vector<Crossing> crossings;
  for (std::size_t i = 0; i + 1 < a.size(); ++i) {
    for (std::size_t j = i + 2; j + 1 < a.size(); ++j) add_crossing(a, i, a, j, crossings);
  }
  int sum = 0;
  for (const Crossing& i : crossings) {
    for (const Crossing& j : crossings) {
      const bool interleaved = i.along_a < j.along_a && j.along_a < i.along_b && i.along_b < j.along_b;
      if (interleaved && !i.a_over && j.a_over) sum += i.sign * j.sign;
    }
  }
  return sum;
}

}  // namespace noli::app_tests
