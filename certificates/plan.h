// SPDX-License-Identifier: Apache-2.0
//
// A vertex's plan: a straight motion and a ball around it that it promises not to leave for a while. As long as it
// keeps the promise, nothing that was concluded from the plan has to be looked at again.
//
// Notation
//   deviation   x(t) - line(t), itself linear between changes of velocity: if it is within the ball at two times, it is
//               so between them
#pragma once

#include <cmath>
#include <limits>

#include "certificates/vector.h"

namespace noli::certificates {

template <int Dim>
struct Plan {
  Line<Dim> line;
  double radius = 0;
  double until = 0;

  bool holds(const Line<Dim>& motion, double time) const {
    return time <= until && (motion.at(time) - line.at(time)).squaredNorm() <= radius * radius;
  }
};

/// The least tau >= 0 at which |e + tau w| = radius; infinity if there is none. Precondition: |e| <= radius.
template <int Dim>
double time_to_leave(const Vector<Dim>& e, const Vector<Dim>& w, double radius) {
  const double a = w.squaredNorm(), b = e.dot(w), c = e.squaredNorm() - radius * radius;
  if (!(a > 0)) return std::numeric_limits<double>::infinity();
  const double root = std::sqrt(std::max(b * b - a * c, 0.0));
  return b > 0 ? std::max(-c, 0.0) / (b + root) : (root - b) / a;
}

}  // namespace noli::certificates
