// SPDX-License-Identifier: Apache-2.0
//
// The impulses of one penalty layer on one pair when it fires.
//
// Notation (Harmon et al. 2009, section 3)
//   x_i, v_i, m_i   vertices of the pair; w_i, r, d, b_k: as in certificates/closest.h
//   g         d - eta; the layer acts if g < 0
//   J_n       s h r(l) |g|: the impulse between the closest points, pushing them apart; s = 1 while they approach, e
//             while they part, so e is the share of the energy that comes back
//   slide     a change of the parameters of the closest points, or its rate. Rigid motions do not change them, so
//             forces along their gradients change neither momentum nor angular momentum (see Sliding)
//   friction  impulse z along slides, of magnitude mu J_n at most: it stops the slip of a pair without an anchor, and
//             pulls others back to their anchor (integrator/anchors.h) with h r(l) times the slide from there,
//             critically damped
//
// S is double; in audits also multiprecision numbers.
#pragma once

#include <array>
#include <cmath>
#include <span>

#include "certificates/closest.h"
#include "integrator/force.h"

namespace noli::integrator {

template <int Dim, class S = double>
using Impulses = std::array<Vec<S, Dim>, 4>;

/// J_n at one vertex. `n`: r / d; `push`: J_n.
template <int Dim, class S>
Vec<S, Dim> normal_impulse(const certificates::Closest<Dim, S>& c, const Vec<S, Dim>& n, const S& push, std::size_t i) {
  return (push * c.weights[i]) * n;
}

/// J_n along the gradient of the distance.
template <int Dim, class S>
Impulses<Dim, S> normal_impulses(const certificates::Closest<Dim, S>& c, const S& d, const S& push) {
  Impulses<Dim, S> impulses;
  const Vec<S, Dim> n = c.r / d;
  for (std::size_t i = 0; i < 4; ++i) impulses[i] = normal_impulse<Dim, S>(c, n, push, i);
  return impulses;
}

/// d d(d)/dt of a pair of `size` vertices: negative while the closest points approach. `velocity(i)`: of vertex i of
/// the pair.
template <int Dim, class S, class Velocity>
S opening(const certificates::Closest<Dim, S>& c, std::size_t size, const Velocity& velocity) {
  S sum(0);
  for (std::size_t i = 0; i < size; ++i) sum += c.weights[i] * c.r.dot(velocity(i));
  return sum;
}

/// The slides of the closest points of a pair along its features, in at most two directions.
template <int Dim, class S>
class Sliding {
 public:
  using Slide = std::array<S, 2>;  ///< by parameter

  /// c must outlive this. Precondition: x are the positions of the pair's vertices.
  Sliding(const certificates::Closest<Dim, S>& c, std::span<const Vec<S, Dim>> x) : c_(c), size_(x.size()) {
    for (std::size_t k = 0; k < c.slide_count; ++k) b_[k] = x[c.slides[k].to] - x[c.slides[k].from];
    if (c.slide_count == 0) return;
    aa_ = b_[0].squaredNorm();
    if (c.slide_count == 1) return;
    ab_ = b_[0].dot(b_[1]);
    bb_ = b_[1].squaredNorm();
    det_ = aa_ * bb_ - ab_ * ab_;
  }

  /// Whether the closest points can slide, and solve() works.
  bool possible() const { return c_.slide_count == 1 || (c_.slide_count == 2 && det_ > S(0)); }

  /// The slide that moves the closest points by, or at a rate of, `tangent` along the b_k. Precondition: possible().
  Slide solve(const Slide& tangent) const {
    if (c_.slide_count == 1) return {tangent[0] / aa_, S(0)};
    return {(bb_ * tangent[0] - ab_ * tangent[1]) / det_, (aa_ * tangent[1] - ab_ * tangent[0]) / det_};
  }

  /// b_k . u + (db_k/dt) . r, u = sum w_i v_i: the argument from which solve() computes the parameters' rates.
  Slide rates(std::span<const Vec<S, Dim>> v) const {
    Vec<S, Dim> u = c_.weights[0] * v[0];
    for (std::size_t i = 1; i < size_; ++i) u += c_.weights[i] * v[i];
    Slide result{S(0), S(0)};
    for (std::size_t k = 0; k < c_.slide_count; ++k) {
      const auto [to, from] = c_.slides[k];
      result[k] = b_[k].dot(u) + (v[to] - v[from]).dot(c_.r);
    }
    return result;
  }

  /// b_k . (sum (weights_i - w_i) x_i): the argument for the slide from points of other weights to the closest points.
  Slide way_from(const std::array<S, 4>& weights, std::span<const Vec<S, Dim>> x) const {
    Vec<S, Dim> way = (weights[0] - c_.weights[0]) * x[0];
    for (std::size_t i = 1; i < size_; ++i) way += (weights[i] - c_.weights[i]) * x[i];
    Slide result{S(0), S(0)};
    for (std::size_t k = 0; k < c_.slide_count; ++k) result[k] = b_[k].dot(way);
    return result;
  }

  /// The square of a slide's length, or of its speed.
  S squared(const Slide& slide) const {
    S sum = slide[0] * slide[0] * aa_;
    if (c_.slide_count == 2) sum += slide[1] * (S(2) * slide[0] * ab_ + slide[1] * bb_);
    return sum;
  }

  /// The impulses on the vertices whose work on every motion is -z . rate: along gradients of functions that rigid
  /// motions do not change.
  Impulses<Dim, S> against(const Slide& z) const {
    Impulses<Dim, S> impulses;
    for (auto& impulse : impulses) impulse.setZero();
    for (std::size_t k = 0; k < c_.slide_count; ++k) {
      for (std::size_t i = 0; i < size_; ++i) impulses[i] -= (z[k] * c_.weights[i]) * b_[k];
      impulses[c_.slides[k].to] -= z[k] * c_.r;
      impulses[c_.slides[k].from] += z[k] * c_.r;
    }
    return impulses;
  }

 private:
  const certificates::Closest<Dim, S>& c_;
  std::size_t size_;
  std::array<Vec<S, Dim>, 2> b_;
  S aa_ = S(0), ab_ = S(0), bb_ = S(0), det_ = S(0);
};

/// The slip of a pair.
template <int Dim, class S = double>
struct Slip {
  S speed = S(0);              ///< [m/s]; 0: there is no slip, or none is possible
  std::array<S, 2> rate{};     ///< of the parameters
  Impulses<Dim, S> against{};  ///< the impulse on each vertex for a friction impulse of 1
};

template <int Dim, class S>
Slip<Dim, S> slip(const Sliding<Dim, S>& sliding, std::span<const Vec<S, Dim>> v) {
  using std::sqrt;
  Slip<Dim, S> result;
  for (auto& impulse : result.against) impulse.setZero();
  if (!sliding.possible()) return result;
  result.rate = sliding.solve(sliding.rates(v));
  const S squared = sliding.squared(result.rate);
  if (!(squared > S(0))) return result;
  result.speed = sqrt(squared);
  result.against = sliding.against({result.rate[0] / result.speed, result.rate[1] / result.speed});
  return result;
}

/// How much of the slip's speed a friction impulse of magnitude 1 takes: speed / this stops the slip.
template <int Dim, class S>
S yielding(const Slip<Dim, S>& slip, std::span<const S> inverse_mass) {
  S sum(0);
  for (std::size_t i = 0; i < inverse_mass.size(); ++i) sum += inverse_mass[i] * slip.against[i].squaredNorm();
  return sum;
}

}  // namespace noli::integrator
