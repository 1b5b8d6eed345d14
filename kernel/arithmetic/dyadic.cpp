// SPDX-License-Identifier: Apache-2.0
#include "kernel/arithmetic/dyadic.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace noli {
namespace {

constexpr long smallest_exponent = -1074;  // of the unit in the last place of a subnormal double

/// |x| cut to a double, and whether something was cut off. Infinity if |x| is above all doubles.
struct Cut {
  double value;
  bool exact;
};

Cut cut(const Dyadic& x) {
  const long bits = static_cast<long>(x.m.bit_length()), e = static_cast<long>(x.e);
  if (bits - e > 1024) return {std::numeric_limits<double>::infinity(), false};
  const long drop = std::max({bits - 53, smallest_exponent + e, 0L});
  Integer kept = absolute(x.m);
  const bool exact = x.m.is_zero() || static_cast<long>(trailing_zeros(x.m)) >= drop;
  kept >>= static_cast<std::size_t>(drop);
  return {std::ldexp(mpz_get_d(kept.get()), static_cast<int>(drop - e)), exact};
}

double away(const Cut& c) {
  return c.exact ? c.value : std::nextafter(c.value, std::numeric_limits<double>::infinity());
}

double towards_zero(const Cut& c) { return std::min(c.value, std::numeric_limits<double>::max()); }

}  // namespace

Dyadic Dyadic::from_double(double x) {
  int exponent = 0;
  const double mantissa = std::frexp(x, &exponent);
  Dyadic result{Integer(static_cast<long>(std::ldexp(mantissa, 53))), 0};
  if (exponent >= 53) {
    result.m <<= static_cast<std::size_t>(exponent - 53);
    return result;
  }
  result.e = static_cast<std::size_t>(53 - exponent);
  return result.reduced();
}

Dyadic Dyadic::reduced() const {
  if (m.is_zero()) return {};
  const std::size_t drop = std::min(e, trailing_zeros(m));
  Dyadic result = *this;
  result.m >>= drop;
  result.e -= drop;
  return result;
}

std::strong_ordering operator<=>(const Dyadic& a, const Dyadic& b) {
  if (a.e == b.e) return a.m <=> b.m;
  return a.e < b.e ? a.scaled(b.e) <=> b.m : a.m <=> b.scaled(a.e);
}

Dyadic operator+(const Dyadic& a, const Dyadic& b) {
  const std::size_t e = std::max(a.e, b.e);
  return {a.scaled(e) + b.scaled(e), e};
}

Dyadic operator-(const Dyadic& a, const Dyadic& b) {
  const std::size_t e = std::max(a.e, b.e);
  return {a.scaled(e) - b.scaled(e), e};
}

Dyadic operator*(const Dyadic& a, const Dyadic& b) { return {a.m * b.m, a.e + b.e}; }

Dyadic ldexp(Dyadic x, int k) {
  if (k < 0) {
    x.e += static_cast<std::size_t>(-k);
  } else {
    x.m <<= static_cast<std::size_t>(k);
  }
  return x.reduced();
}

Dyadic middle(const Dyadic& a, const Dyadic& b) {
  Dyadic sum = a + b;
  ++sum.e;
  return sum;
}

double floor_to_double(const Dyadic& x) { return x.sign() >= 0 ? towards_zero(cut(x)) : -away(cut(x)); }

double ceil_to_double(const Dyadic& x) { return x.sign() <= 0 ? -towards_zero(cut(x)) : away(cut(x)); }

}  // namespace noli
