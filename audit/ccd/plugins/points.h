// SPDX-License-Identifier: Apache-2.0
//
// What the plug-ins share: vectors of three doubles, and the points of a query as noli_ccd_query has them.
#pragma once

#include <noli/ccd_plugin.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace noli::plugins {

struct Vec {
  double x = 0, y = 0, z = 0;
};

inline Vec operator+(const Vec& a, const Vec& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vec operator-(const Vec& a, const Vec& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vec operator*(double s, const Vec& a) { return {s * a.x, s * a.y, s * a.z}; }
inline double dot(const Vec& a, const Vec& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline double norm(const Vec& a) { return std::sqrt(dot(a, a)); }
inline Vec cross(const Vec& a, const Vec& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
/// The sign of the volume of the tetrahedron 0, a, b, c, and six times the volume.
inline double determinant(const Vec& a, const Vec& b, const Vec& c) { return dot(a, cross(b, c)); }

/// Four points.
using Points = std::array<Vec, 4>;

/// As points of another library, which are made of three numbers.
template <class Point>
std::array<Point, 4> points_as(const double x[12]) {
  return {{{x[0], x[1], x[2]}, {x[3], x[4], x[5]}, {x[6], x[7], x[8]}, {x[9], x[10], x[11]}}};
}

inline Points points(const double x[12]) { return points_as<Vec>(x); }

/// Where they are at time t, x_t0 being where they start and `change` how far they go.
inline Points moved(const Points& x_t0, const Points& change, double t) {
  Points result;
  for (std::size_t i = 0; i < 4; ++i) result[i] = x_t0[i] + t * change[i];
  return result;
}

inline Points change_of(const Points& x_t0, const Points& x_t1) {
  Points result;
  for (std::size_t i = 0; i < 4; ++i) result[i] = x_t1[i] - x_t0[i];
  return result;
}

}  // namespace noli::plugins
