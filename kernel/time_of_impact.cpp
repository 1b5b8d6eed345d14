// SPDX-License-Identifier: Apache-2.0
#include <noli/time_of_impact.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "kernel/arithmetic/algebraic.h"

namespace noli {

TimeOfImpact::TimeOfImpact() : TimeOfImpact(AlgebraicNumber()) {}

TimeOfImpact::TimeOfImpact(AlgebraicNumber value) : value_(std::make_shared<const AlgebraicNumber>(std::move(value))) {}

TimeOfImpact TimeOfImpact::from_double(double t) {
  if (!(t >= 0 && t <= 1)) throw std::domain_error("a time of impact is in [0, 1]");
  return TimeOfImpact(AlgebraicNumber(Dyadic::from_double(t)));
}

TimeOfImpact TimeOfImpact::from_rational(std::int64_t num, std::int64_t den) {
  Integer n(num), d(den);
  if (d.sign() < 0) {
    n.negate();
    d.negate();
  }
  if (d.is_zero() || n.sign() < 0 || n > d) throw std::domain_error("a time of impact is in [0, 1]");
  return TimeOfImpact(AlgebraicNumber::rational(n, d));
}

double TimeOfImpact::lower() const { return value_->floor(); }

double TimeOfImpact::upper() const {
  const double below = lower();
  if (value_->compare(Dyadic::from_double(below)) == 0) return below;
  return std::nextafter(below, std::numeric_limits<double>::infinity());
}

std::strong_ordering TimeOfImpact::compare(const TimeOfImpact& other) const { return *value_ <=> *other.value_; }

}  // namespace noli
