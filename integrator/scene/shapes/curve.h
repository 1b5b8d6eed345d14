// SPDX-License-Identifier: Apache-2.0
//
// Vectors of meshes, and points at equal distances along a curve through given points. Only + - * / sqrt.
#pragma once

#include <cmath>
#include <vector>

#include <noli/mesh.h>
#include "certificates/vector.h"

namespace noli::integrator {

using Vec3 = certificates::Vector<3>;

inline Vec3 to_vec(const Position& x) { return {x[0], x[1], x[2]}; }
inline Position to_position(const Vec3& x) { return {x[0], x[1], x[2]}; }
inline Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

inline double length(const Vec3& x) { return std::sqrt(x.squaredNorm()); }

struct CurveKind {
  bool smooth = false;  ///< the Catmull-Rom curve instead of straight lines
  bool closed = false;  ///< continues from the last point to the first
};

/// n + 1 points at k/n of the curve's length, its first and last points included; for a closed curve n, without the
/// last. Precondition: at least two points, n >= 1. Throws std::invalid_argument if the curve has no length.
std::vector<Vec3> along_curve(const std::vector<Position>& points, std::uint32_t n, CurveKind kind);

}  // namespace noli::integrator
