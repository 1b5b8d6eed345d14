// SPDX-License-Identifier: Apache-2.0
//
// Computes the closest points of two features, and how they slide along each other.
//
// Notation
//   x_i   vertices of the pair, those of A first
//   w_i   weights with sum w_i x_i = r, positive on A, negative on B, each feature's adding up to 1 or -1
//   r     from the closest point of B to that of A; d = |r| is the distance and w_i r / d its gradient by x_i
//   b_k   directions x_p - x_q in which the closest points can slide; none if they are at corners. With c_k = b_k . u +
//         (db_k/dt) . r, where u = sum w_i v_i, the rates of the closest points' parameters solve (b_j . b_k) rate = c
//         (differentiate b_k . r = 0). They are the same in every moving frame
//
// Any weights give a point of each feature, so the computed |r| is never less than the distance, except for the
// rounding of one short sum. It errs on the side of "farther", by a few units in the last place of the coordinates.
//
// Regions of a triangle: Ericson, "Real-Time Collision Detection" (2005), 5.1.5; segments: 5.1.9. Parallel segments use
// the middle of their overlap. So do segments whose angle is below 1e-6, which makes r longer by at most half of a
// millionth of the edge.
//
// When one segment turns through parallel in a plane with the other, the closest points jump from end to end. The
// distance is continuous but its gradient is not. So a kick comes from another end (no larger than others), and the
// energy of an impact is off by first order in the step of contact. For a bar that lands flat on another one: sd 0.2 c,
// that is 0.4 %, 1.0 %, 2.1 % at c = 0.02, 0.05, 0.1 (c as in docs/contact.md, 1), mean 0 within its error over 1,000
// impacts; crossing at 0.01 rad 0.02 %, 0.4 %, 1.2 %; at 0.1 rad and more 0.03 % at c = 0.1, which is that of any
// impact (tests/integrator/contact_physics_parallel_test.cpp).
//
// S, the type of numbers, is double; in audits also multiprecision numbers, for which the formulas are the same.
//
// These are rounded numbers for the dynamics; the kernel decides whether features meet.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

#include "certificates/stencil.h"
#include "certificates/vector.h"

namespace noli::certificates {

/// b = x[to] - x[from]; indices into the stencil.
struct Slide {
  std::uint8_t to, from;
};

template <int Dim, class S = double>
struct Closest {
  std::array<S, 4> weights{};
  std::array<Slide, 2> slides{};
  std::size_t slide_count = 0;
  Vector<Dim, S> r = Vector<Dim, S>::Zero();

  S distance() const {
    using std::sqrt;
    return sqrt(r.squaredNorm());
  }
};

namespace detail {

template <class S>
S clamp_unit(const S& s) {
  return std::min(std::max(s, S(0)), S(1));
}

template <int Dim, class S>
class ClosestFinder {
 public:
  ClosestFinder(std::span<const Vector<Dim, S>> x, Closest<Dim, S>& result) : x_(x), result_(result) {}

  /// A corner and a segment; sign: 1 if the corner belongs to A, otherwise -1. Indices into the stencil.
  void corner_segment(std::uint8_t p, std::uint8_t q0, std::uint8_t q1, const S& sign) {
    const Vector<Dim, S> e = x_[q1] - x_[q0];
    const S length = e.squaredNorm();
    const S t = length > S(0) ? clamp_unit<S>(e.dot(x_[p] - x_[q0]) / length) : S(0);
    weigh(p, sign);
    weigh(q0, -sign * (S(1) - t));
    weigh(q1, -sign * t);
    if (!(t > S(0) && t < S(1))) return;
    sign > S(0) ? slide(q1, q0) : slide(q0, q1);
  }

  void vertex_face() {
    const Vector<Dim, S> ab = x_[2] - x_[1], ac = x_[3] - x_[1], ap = x_[0] - x_[1];
    const S d1 = ab.dot(ap), d2 = ac.dot(ap);
    if (d1 <= S(0) && d2 <= S(0)) return corners(1);
    const Vector<Dim, S> bp = x_[0] - x_[2];
    const S d3 = ab.dot(bp), d4 = ac.dot(bp);
    if (d3 >= S(0) && d4 <= d3) return corners(2);
    const Vector<Dim, S> cp = x_[0] - x_[3];
    const S d5 = ab.dot(cp), d6 = ac.dot(cp);
    if (d6 >= S(0) && d5 <= d6) return corners(3);
    const S vc = d1 * d4 - d3 * d2, vb = d5 * d2 - d1 * d6, va = d3 * d6 - d5 * d4;
    if (vc <= S(0) && d1 >= S(0) && d3 <= S(0)) return corner_segment(0, 1, 2, S(1));
    if (vb <= S(0) && d2 >= S(0) && d6 <= S(0)) return corner_segment(0, 1, 3, S(1));
    if (va <= S(0) && d4 - d3 >= S(0) && d5 - d6 >= S(0)) return corner_segment(0, 2, 3, S(1));
    const S sum = va + vb + vc;
    if (!(sum > S(1e-8) * ab.squaredNorm() * ac.squaredNorm())) return foot_on_sliver(ab, ac, ap);
    const S v = clamp_unit<S>(vb / sum);
    foot(v, std::min<S>(clamp_unit<S>(vc / sum), S(1) - v));
  }

  void edge_edge() {
    const Vector<Dim, S> d1 = x_[1] - x_[0], d2 = x_[3] - x_[2], r = x_[0] - x_[2];
    const S a = d1.squaredNorm(), e = d2.squaredNorm(), f = d2.dot(r);
    if (!(a > S(0))) return corner_segment(0, 2, 3, S(1));
    if (!(e > S(0))) return corner_segment(2, 0, 1, S(-1));
    const S b = d1.dot(d2), c = d1.dot(r), det = a * e - b * b;
    S s = det > S(1e-12) * a * e ? clamp_unit<S>((b * f - c * e) / det) : middle_of_overlap(a, b, c);
    S t = (b * s + f) / e;
    if (t < S(0) || t > S(1)) {
      t = clamp_unit<S>(t);
      s = clamp_unit<S>((t * b - c) / a);
    }
    weigh(0, S(1) - s);
    weigh(1, s);
    weigh(2, -(S(1) - t));
    weigh(3, -t);
    if (s > S(0) && s < S(1)) slide(0, 1);
    if (t > S(0) && t < S(1)) slide(3, 2);
    // Parallel edges leave only one independent parameter.
    if (result_.slide_count == 2 && !(det > S(1e-12) * a * e)) result_.slide_count = 1;
  }

  void corners(std::uint8_t q) {
    weigh(0, S(1));
    weigh(q, S(-1));
  }

 private:
  void weigh(std::uint8_t i, const S& w) { result_.weights[i] = w; }
  void slide(std::uint8_t to, std::uint8_t from) { result_.slides[result_.slide_count++] = {to, from}; }

  /// Parameter on the first of two parallel edges.
  static S middle_of_overlap(const S& a, const S& b, const S& c) {
    const S s0 = clamp_unit<S>(-c / a), s1 = clamp_unit<S>((b - c) / a);
    return S(0.5) * (s0 + s1);
  }

  /// The nearest point of a face is inside it: corner 1 + v ab + w ac.
  void foot(const S& v, const S& w) {
    weigh(0, S(1));
    weigh(1, -(S(1) - v - w));
    weigh(2, -v);
    weigh(3, -w);
    slide(2, 1);
    slide(3, 1);
  }

  /// The foot of the vertex on a face whose angle at corner 1 is within 1e-4 of 0 or of a straight one. The barycentric
  /// products cancel there: their error, in units of the length, is that of rounding over the angle squared. Distances
  /// across ab lose only rounding over the angle, and a wrong w moves the foot by no more than rounding, as v follows
  /// it. Where ab is 0, the NaNs that follow lead to the border.
  void foot_on_sliver(const Vector<Dim, S>& ab, const Vector<Dim, S>& ac, const Vector<Dim, S>& ap) {
    const S aa = ab.squaredNorm(), along_c = ab.dot(ac) / aa, along_p = ab.dot(ap) / aa;
    const Vector<Dim, S> across_c = ac - along_c * ab, across_p = ap - along_p * ab;
    const S width = across_c.squaredNorm();
    if (!(width > S(0))) return nearest_border();
    const S w = across_c.dot(across_p) / width, v = along_p - w * along_c;
    if (!(v >= S(0) && w >= S(0) && v + w <= S(1))) return nearest_border();
    foot(v, w);
  }

  /// The nearest point of a triangle's border.
  void nearest_border() {
    S least(-1);
    Closest<Dim, S> best;
    for (const Slide side : {Slide{1, 2}, Slide{1, 3}, Slide{2, 3}}) {
      result_ = {};
      corner_segment(0, side.to, side.from, S(1));
      Vector<Dim, S> r = Vector<Dim, S>::Zero();
      for (std::size_t i = 0; i < 4; ++i) r += result_.weights[i] * x_[i];
      if (least < S(0) || r.squaredNorm() < least) {
        least = r.squaredNorm();
        best = result_;
      }
    }
    result_ = best;
  }

  std::span<const Vector<Dim, S>> x_;
  Closest<Dim, S>& result_;
};

}  // namespace detail

/// Precondition: x has the stencil's vertices, finite; in the plane no faces.
template <int Dim, class S = double>
void find_closest(FeaturePair kind, std::span<const Vector<Dim, S>> x, Closest<Dim, S>& result) {
  result.weights = {};
  result.slide_count = 0;
  detail::ClosestFinder<Dim, S> finder(x, result);
  switch (kind) {
    case FeaturePair::vertex_face: finder.vertex_face(); break;
    case FeaturePair::edge_edge: finder.edge_edge(); break;
    case FeaturePair::vertex_edge: finder.corner_segment(0, 1, 2, S(1)); break;
    case FeaturePair::vertex_vertex: finder.corners(1); break;
  }
  result.r = result.weights[0] * x[0];
  for (std::size_t i = 1; i < x.size(); ++i) result.r += result.weights[i] * x[i];
}

/// The same by value.
template <int Dim, class S = double>
Closest<Dim, S> closest(FeaturePair kind, std::span<const Vector<Dim, S>> x) {
  Closest<Dim, S> result;
  find_closest<Dim, S>(kind, x, result);
  return result;
}

}  // namespace noli::certificates
