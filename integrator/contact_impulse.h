// SPDX-License-Identifier: Apache-2.0
//
// What one penalty layer does to one pair when it fires.
//
// Notation (Harmon et al. 2009, section 3)
//   x_i, v_i, m_i   vertices of the pair; w_i, r, d, b_k: as in certificates/closest.h
//   g         d - eta; the layer acts if g < 0
//   J_n       s h r(l) |g|: the impulse between the closest points, pushing apart; s = 1 while they approach, e while
//             they part, so e is the part of the energy that comes back
//   friction  impulse of magnitude j = min(mu J_n, what stops the slip) against the slip of the closest points along
//             the features. The slip is that of the points' parameters, which rigid motions do not change; so neither
//             impulse changes momentum or angular momentum (see slip())
//
// S is double; in audits also multiprecision numbers.
//
// What this does not do: it changes no velocity, and no one's clock.
#pragma once

#include <array>
#include <cmath>
#include <span>

#include "certificates/closest.h"
#include "integrator/vector.h"

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

/// d d(d)/dt of a pair of so many vertices: negative while the closest points approach. `velocity`: of vertex i of the
/// pair.
template <int Dim, class S, class Velocity>
S opening(const certificates::Closest<Dim, S>& c, std::size_t size, const Velocity& velocity) {
  S sum(0);
  for (std::size_t i = 0; i < size; ++i) sum += c.weights[i] * c.r.dot(velocity(i));
  return sum;
}

/// The slip of a pair: its speed, and the generalized force of magnitude 1 against it.
template <int Dim, class S = double>
struct Slip {
  S speed = S(0);              ///< sqrt(rate . (b_j . b_k) rate) [m/s]; 0: nothing slips, or nothing can
  Impulses<Dim, S> against{};  ///< impulse on each vertex, if the friction's is 1
};

/// With rate the parameters' rates and y = -rate / speed, the force of magnitude 1 that does the work -speed per second
/// on every motion is sum y_k dc_k/dv_i: c_k = b_k . u + (db_k/dt) . r, u = sum w_i v_i. It is a force along gradients
/// of functions that rigid motions leave alone.
template <int Dim, class S>
Slip<Dim, S> slip(const certificates::Closest<Dim, S>& c, std::span<const Vec<S, Dim>> x,
                  std::span<const Vec<S, Dim>> v) {
  using std::sqrt;
  Slip<Dim, S> result;
  for (auto& impulse : result.against) impulse.setZero();
  if (c.slide_count == 0) return result;
  Vec<S, Dim> u = c.weights[0] * v[0];
  for (std::size_t i = 1; i < v.size(); ++i) u += c.weights[i] * v[i];
  std::array<Vec<S, Dim>, 2> b;
  std::array<S, 2> rhs{}, rate{};
  for (std::size_t k = 0; k < c.slide_count; ++k) {
    const auto [to, from] = c.slides[k];
    b[k] = x[to] - x[from];
    rhs[k] = b[k].dot(u) + (v[to] - v[from]).dot(c.r);
  }
  const S aa = b[0].squaredNorm();
  if (c.slide_count == 1) {
    rate[0] = rhs[0] / aa;
  } else {
    const S ab = b[0].dot(b[1]), bb = b[1].squaredNorm(), det = aa * bb - ab * ab;
    if (!(det > S(0))) return result;
    rate[0] = (bb * rhs[0] - ab * rhs[1]) / det;
    rate[1] = (aa * rhs[1] - ab * rhs[0]) / det;
  }
  S squared(0);
  for (std::size_t k = 0; k < c.slide_count; ++k) squared += rate[k] * rhs[k];
  if (!(squared > S(0))) return result;
  result.speed = sqrt(squared);
  for (std::size_t k = 0; k < c.slide_count; ++k) {
    const S y = -rate[k] / result.speed;
    for (std::size_t i = 0; i < v.size(); ++i) result.against[i] += (y * c.weights[i]) * b[k];
    result.against[c.slides[k].to] += y * c.r;
    result.against[c.slides[k].from] -= y * c.r;
  }
  return result;
}

/// How much of the slip's speed an impulse of magnitude 1 takes: the friction that stops it is speed / this.
template <int Dim, class S>
S yielding(const Slip<Dim, S>& slip, std::span<const S> inverse_mass) {
  S sum(0);
  for (std::size_t i = 0; i < inverse_mass.size(); ++i) sum += inverse_mass[i] * slip.against[i].squaredNorm();
  return sum;
}

}  // namespace noli::integrator
