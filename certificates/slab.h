// SPDX-License-Identifier: Apache-2.0
//
// Two features are kept apart by a slab between them; to each of their vertices one side of it is a wall.
//
// Notation (Harmon et al. 2009, section 5; design, "Certificates")
//   slab        n . x = s(t) +- half, s(t) = offset + rate (t - since), |n| = 1: A stays above, B below, so they are at
//               least 2 half apart. The slab moves with what it separates
//   clearance   of a vertex: how far it is on its side of its wall; linear in time between changes of velocity
//   slack       the least clearance when the slab was put up
//
// What this does not do: it knows no times of failure; vertices compare their motion with all their walls at once
// (certificates/cells.h).
#pragma once

#include <span>

#include "certificates/closest.h"

namespace noli::certificates {

template <int Dim>
struct Slab {
  Vector<Dim> normal = Vector<Dim>::Zero();  ///< from B to A
  double offset = 0, rate = 0, since = 0;
  double half = 0;
  double slack = 0;

  /// Of a vertex of A or of B that is at x at time t.
  double clearance(bool of_a, const Vector<Dim>& x, double t) const {
    const double height = normal.dot(x) - (offset + rate * (t - since));
    return (of_a ? height : -height) - half;
  }
  /// How fast the clearance of a vertex with velocity v falls.
  double closing(bool of_a, const Vector<Dim>& v) const {
    const double rise = normal.dot(v) - rate;
    return of_a ? -rise : rise;
  }
};

/// Half way between the closest points, and moving as they do on average. Precondition: the distance is positive. The
/// slack may come out negative: when the distance is less than 2 half, or not known well enough because the features
/// are thin. Then the slab certifies nothing.
template <int Dim>
Slab<Dim> slab_between(const Stencil& pair, const Closest<Dim>& closest, std::span<const Vector<Dim>> x,
                       std::span<const Vector<Dim>> v, double t, double half) {
  Slab<Dim> slab;
  slab.normal = closest.r / closest.distance();
  slab.since = t;
  slab.half = half;
  for (std::size_t i = 0; i < pair.size(); ++i) {
    const double part = 0.5 * std::abs(closest.weights[i]);
    slab.offset += part * slab.normal.dot(x[i]);
    slab.rate += part * slab.normal.dot(v[i]);
  }
  slab.slack = slab.clearance(true, x[0], t);
  for (std::size_t i = 1; i < pair.size(); ++i) {
    slab.slack = std::min(slab.slack, slab.clearance(i < pair.first(), x[i], t));
  }
  return slab;
}

}  // namespace noli::certificates
