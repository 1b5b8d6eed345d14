// SPDX-License-Identifier: Apache-2.0
//
// The first two stages, which find most pairs apart: an axis on which the features are in the same strict order at both
// ends of the step, and the direction normal to both features at mid-time.
//
// Notation
//   u = 2^-53         half an ulp of 1; arithmetic rounds to nearest and is not contracted
//   n                 the direction, any vector of doubles. If n . (b - a) > 0 at both ends, for all points a of one
//                     feature and b of the other, n separates them during the whole step: it is linear in between
//   m                 the largest magnitude of a computed difference of coordinates
// Error bound: a computed difference has a relative error of u, so n . d is off by at most 11u |n| m (components'
// maxima) to first order, and a sum of three of these by 48u |n| m. The code uses 16u and 60u, which covers the higher
// orders and the rounding of the bound. Nothing overflows, and underflow does not matter, when |n| > 2^-600 and m is
// between 2^-300 and 2^300.
//
// A pair that it does not separate may still be apart.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include <noli/query.h>
#include "kernel/both_ends.h"
#include "kernel/formula.h"

namespace noli::filter {

using formula::Vec;

constexpr double u = 0x1p-53;

// proofs/gappa has theorems about all of these except greatest_size, which prevents overflow. A test compares them with
// Constants.v.
constexpr double least_normal = 0x1p-600;  // of |n|
constexpr double least_size = 0x1p-300;    // of m
constexpr double greatest_size = 0x1p300;
constexpr double vertex_face_units = 16;
constexpr double edge_edge_units = 60;

// --- Stage: comparison ---------------------------------------------------------------------------------------------

/// Whether on some axis the two features are in the same strict order at both ends. Exact: nothing is computed.
template <FeaturePair Pair, int Dim>
bool ordered_on_an_axis(const Query<Pair, Dim>& q) {
  constexpr std::size_t first = first_size(Pair), size = point_count(Pair);
  for (std::size_t axis = 0; axis < Dim; ++axis) {
    const auto x = [&q, axis](std::size_t i) { return BothEnds(q.x_t0[i][axis], q.x_t1[i][axis]); };
    BothEnds a_low = x(0), a_high = a_low, b_low = x(first), b_high = b_low;
    for (std::size_t i = 1; i < first; ++i) {
      a_low = min(a_low, x(i));
      a_high = max(a_high, x(i));
    }
    for (std::size_t i = first + 1; i < size; ++i) {
      b_low = min(b_low, x(i));
      b_high = max(b_high, x(i));
    }
    if (static_cast<int>(below(a_high, b_low)) | static_cast<int>(below(b_high, a_low))) return true;
  }
  return false;
}

// --- Stage: direction ------------------------------------------------------------------------------------------------

/// A vector at both ends.
using EndVectors = std::array<BothEnds, 3>;

template <FeaturePair Pair>
EndVectors end_difference(const Query<Pair, 3>& q, std::size_t to, std::size_t from) {
  const auto x = [&q, to, from](std::size_t axis) {
    return BothEnds(q.x_t0[to][axis], q.x_t1[to][axis]) - BothEnds(q.x_t0[from][axis], q.x_t1[from][axis]);
  };
  return {x(0), x(1), x(2)};
}

/// Twice the vector at mid-time.
inline Vec<double, 3> twice_at_middle(const EndVectors& d) {
  return {d[0].at_t0() + d[0].at_t1(), d[1].at_t0() + d[1].at_t1(), d[2].at_t0() + d[2].at_t1()};
}

inline BothEnds dot(const EndVectors& n, const EndVectors& d) { return n[0] * d[0] + n[1] * d[1] + n[2] * d[2]; }

inline EndVectors constant(const Vec<double, 3>& n) { return {BothEnds(n[0]), BothEnds(n[1]), BothEnds(n[2])}; }

inline BothEnds magnitude(const EndVectors& d) { return max(max(abs(d[0]), abs(d[1])), abs(d[2])); }

template <std::size_t Dim>
double magnitude(const Vec<double, Dim>& x) {
  double m = 0;
  for (const double c : x) m = std::max(m, std::abs(c));
  return m;
}

/// The three differences that decide a query (d0, d1, d2 or u, v, w of formula.h), a direction normal to both features
/// at mid-time, and whether that direction separates them.
struct Separation {
  std::array<EndVectors, 3> differences;
  Vec<double, 3> normal;
  bool separated;
};

/// Whether all values between low and high, at both ends, are on one side of zero by more than their error.
inline bool on_one_side(BothEnds low, BothEnds high, BothEnds sizes, const Vec<double, 3>& normal, double units) {
  const double n = magnitude(normal), m = std::max(sizes.at_t0(), sizes.at_t1());
  if (!(n > least_normal && m > least_size && m < greatest_size)) return false;
  const double bound = units * u * n * m;
  return std::min(low.at_t0(), low.at_t1()) > bound || std::max(high.at_t0(), high.at_t1()) < -bound;
}

/// The face's normal at mid-time.
inline Separation separate(const VertexFace3& q) {
  const EndVectors d0 = end_difference(q, 1, 0), d1 = end_difference(q, 2, 0), d2 = end_difference(q, 3, 0);
  const Vec<double, 3> middle = twice_at_middle(d0);
  const Vec<double, 3> normal =
      formula::cross(formula::operator-(twice_at_middle(d1), middle), formula::operator-(twice_at_middle(d2), middle));
  const EndVectors n = constant(normal);
  const BothEnds s0 = dot(n, d0), s1 = dot(n, d1), s2 = dot(n, d2);
  const BothEnds sizes = max(max(magnitude(d0), magnitude(d1)), magnitude(d2));
  return {
      {d0, d1, d2}, normal, on_one_side(min(min(s0, s1), s2), max(max(s0, s1), s2), sizes, normal, vertex_face_units)};
}

/// The common normal of the edges at mid-time. With w from the one edge to the other, the differences between them are
/// w, w - u, w + v and w + v - u.
inline Separation separate(const EdgeEdge3& q) {
  const EndVectors du = end_difference(q, 1, 0), dv = end_difference(q, 3, 2), dw = end_difference(q, 2, 0);
  const Vec<double, 3> normal = formula::cross(twice_at_middle(du), twice_at_middle(dv));
  const EndVectors n = constant(normal);
  const BothEnds nu = dot(n, du), nv = dot(n, dv), nw = dot(n, dw), zero(0.0);
  const BothEnds low = (nw - max(nu, zero)) + min(nv, zero), high = (nw - min(nu, zero)) + max(nv, zero);
  const BothEnds sizes = max(max(magnitude(du), magnitude(dv)), magnitude(dw));
  return {{du, dv, dw}, normal, on_one_side(low, high, sizes, normal, edge_edge_units)};
}

}  // namespace noli::filter
