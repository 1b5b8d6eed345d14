// SPDX-License-Identifier: Apache-2.0
//
// Orientation, in three stages: double with an error bound (Shewchuk 1997, first stage), integers of fixed width, GMP.
//
// The error bounds are twice Shewchuk's, so that they hold in every rounding mode. Underflow has a bound of its own.
#include <cmath>

#include "kernel/arithmetic/rounding.h"
#include "kernel/arithmetic/scaled_integers.h"
#include "kernel/static_predicates.h"

namespace noli {
namespace {

int sign_of(double x) { return (x > 0) - (x < 0); }

// Proved in proofs/gappa for rounding to nearest; a test compares these numbers with its Constants.v.
constexpr double error_2d = 2 * (3 + 16 * 0x1p-53) * 0x1p-53;
constexpr double error_3d = 2 * (7 + 56 * 0x1p-53) * 0x1p-53;
constexpr double underflow_2d = 0x1p-1000;
constexpr double underflow_3d = 0x1p-1060;

/// The sign, or 0 if it is not certain.
int filtered(const Point2& a, const Point2& b, const Point2& c) {
  const double left = (b[0] - a[0]) * (c[1] - a[1]), right = (b[1] - a[1]) * (c[0] - a[0]);
  const double det = left - right;
  const double error = error_2d * (std::abs(left) + std::abs(right)) + underflow_2d;
  return std::abs(det) > error ? sign_of(det) : 0;
}

int filtered(const Point3& a, const Point3& b, const Point3& c, const Point3& d) {
  const double ux = b[0] - a[0], uy = b[1] - a[1], uz = b[2] - a[2];
  const double vx = c[0] - a[0], vy = c[1] - a[1], vz = c[2] - a[2];
  const double wx = d[0] - a[0], wy = d[1] - a[1], wz = d[2] - a[2];
  const double uv = ux * vy, vu = uy * vx, vw = vx * wy, wv = vy * wx, wu = wx * uy, uw = wy * ux;
  const double det = uz * (vw - wv) + vz * (wu - uw) + wz * (uv - vu);
  const double size = std::abs(uz) * (std::abs(vw) + std::abs(wv)) + std::abs(vz) * (std::abs(wu) + std::abs(uw)) +
                      std::abs(wz) * (std::abs(uv) + std::abs(vu));
  // An inner product that underflows is off by 2^-1074 at most, and then multiplied by a height.
  const double underflow = (std::abs(uz) + std::abs(vz) + std::abs(wz)) * underflow_3d + underflow_3d;
  return std::abs(det) > error_3d * size + underflow ? sign_of(det) : 0;
}

template <class T, std::size_t Dim>
formula::Vec<T, Dim> difference(const std::array<double, Dim>& b, const std::array<double, Dim>& a,
                                const exact::ExponentRange& range) {
  formula::Vec<T, Dim> result;
  for (std::size_t i = 0; i < Dim; ++i)
    result[i] = exact::coordinate<T>(b[i], range) - exact::coordinate<T>(a[i], range);
  return result;
}

template <class T>
int exact_sign(const std::array<Point2, 3>& x, const exact::ExponentRange& range) {
  return formula::cross(difference<T>(x[1], x[0], range), difference<T>(x[2], x[0], range)).sign();
}

template <class T>
int exact_sign(const std::array<Point3, 4>& x, const exact::ExponentRange& range) {
  const auto u = difference<T>(x[1], x[0], range), v = difference<T>(x[2], x[0], range);
  const auto w = difference<T>(x[3], x[0], range);
  return formula::dot(w, formula::cross(u, v)).sign();
}

template <class Points>
int exact_orientation(const Points& x) {
  exact::ExponentRange range;
  for (const auto& p : x) range.add(p);
  // A sign bit, a bit for each of three differences, two for sums.
  if (range.bits() <= 58) return exact_sign<Wide<1>>(x, range);
  if (range.bits() <= 122) return exact_sign<Wide<2>>(x, range);
  return exact_sign<Integer>(x, range);
}

}  // namespace

int orientation(const Point2& a, const Point2& b, const Point2& c) {
  if (rounding_self_test().nearest_ok) {
    if (const int sign = filtered(a, b, c)) return sign;
  }
  return exact_orientation(std::array{a, b, c});
}

int orientation(const Point3& a, const Point3& b, const Point3& c, const Point3& d) {
  if (rounding_self_test().nearest_ok) {
    if (const int sign = filtered(a, b, c, d)) return sign;
  }
  return exact_orientation(std::array{a, b, c, d});
}

}  // namespace noli
