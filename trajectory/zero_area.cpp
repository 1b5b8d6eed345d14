// SPDX-License-Identifier: Apache-2.0
#include "trajectory/zero_area.h"

#include <gmpxx.h>

#include <cmath>

namespace noli {
namespace {

/// Whether floating-point arithmetic is enough to see that u v - w x is not zero, for u, v, w, x that are differences
/// of doubles, rounded once: each product is then within 4 units of 2^-53 of the exact one, so a result larger than
/// 2^-40 of the products' sizes has the right sign, provided that nothing underflowed.
bool surely_not_zero(double u, double v, double w, double x) {
  const double size = std::fabs(u * v) + std::fabs(w * x);
  return size > 0x1p-900 && size < 0x1p1000 && std::fabs(u * v - w * x) > 0x1p-40 * size;
}

/// One component of (b - a) x (c - a), the one without coordinate 3 - i - j.
bool component_is_zero(const Position& a, const Position& b, const Position& c, std::size_t i, std::size_t j) {
  if (surely_not_zero(b[i] - a[i], c[j] - a[j], b[j] - a[j], c[i] - a[i])) return false;
  const mpq_class ai(a[i]), aj(a[j]);
  const mpq_class left = (mpq_class(b[i]) - ai) * (mpq_class(c[j]) - aj);
  const mpq_class right = (mpq_class(b[j]) - aj) * (mpq_class(c[i]) - ai);
  return left == right;
}

}  // namespace

bool has_zero_area(const Position& a, const Position& b, const Position& c) {
  return component_is_zero(a, b, c, 0, 1) && component_is_zero(a, b, c, 1, 2) && component_is_zero(a, b, c, 2, 0);
}

}  // namespace noli
