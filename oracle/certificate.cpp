// SPDX-License-Identifier: Apache-2.0
#include "oracle/certificate.h"

#include <gmpxx.h>

#include <cmath>
#include <limits>

namespace noli::oracle {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

mpq_class velocity(const Line& line, std::size_t axis) {
  return line.is_velocity ? mpq_class(line.y[axis]) : mpq_class(line.y[axis]) - mpq_class(line.x[axis]);
}

/// The largest double <= q. Precondition: q >= 0.
double rounded_down(const mpq_class& q) {
  double d = q.get_d();
  if (!std::isfinite(d)) d = std::numeric_limits<double>::max();
  while (mpq_class(d) > q) d = std::nextafter(d, 0.0);
  for (double next = std::nextafter(d, infinity); next < infinity && mpq_class(next) <= q;
       next = std::nextafter(d, infinity)) {
    d = next;
  }
  return d;
}

}  // namespace

double failure_time(const Certificate& certificate, double from) {
  mpq_class at_zero = -mpq_class(certificate.gap), slope = 0;
  for (std::size_t k = 0; k < static_cast<std::size_t>(certificate.dimension); ++k) {
    const mpq_class n(certificate.normal[k]);
    at_zero += n * (mpq_class(certificate.a.x[k]) - mpq_class(certificate.b.x[k]));
    slope += n * (velocity(certificate.a, k) - velocity(certificate.b, k));
  }
  if (at_zero + slope * mpq_class(from) <= 0) return from;
  if (slope >= 0) return infinity;
  return rounded_down(-at_zero / slope);
}

}  // namespace noli::oracle
