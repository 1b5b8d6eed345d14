// SPDX-License-Identifier: Apache-2.0
//
// Integers of any length, as a proof writes them and as a motion has them.
#pragma once

#include <gmpxx.h>

#include "base.h"

namespace noli::checker {

/// Whether x / 2^p is an integer.
inline bool is_multiple(double x, int p) {
  int e = 0;
  const auto m = static_cast<std::int64_t>(std::ldexp(std::frexp(x, &e), 53));  // x = m 2^(e - 53)
  return m == 0 || std::countr_zero(static_cast<std::uint64_t>(m)) + e - 53 >= p;
}

/// That integer.
inline mpz_class integer(double x, int p) {
  int e = 0;
  mpz_class m(static_cast<long>(std::ldexp(std::frexp(x, &e), 53)));
  const int shift = e - 53 - p;
  if (shift >= 0) {
    m <<= static_cast<unsigned long>(shift);
  } else {
    m >>= static_cast<unsigned long>(-shift);
  }
  return m;
}

/// A sint of at most 1,200 bytes.
inline mpz_class read_sint(Cursor& c) {
  const std::string_view g = c.groups(1200);
  mpz_class u = 0;
  for (std::size_t i = g.size(); i-- > 0;) u = (u << 7) + static_cast<unsigned long>(g[i] & 0x7f);
  const bool negative = mpz_odd_p(u.get_mpz_t()) != 0;
  u >>= 1;
  return negative ? mpz_class(-u - 1) : u;
}

/// The number m 2^s, s read before it.
inline mpz_class read_scaled(Cursor& c) {
  const std::uint64_t s = c.uint();
  if (s > 4096) c.fail("a shift is above 4,096");
  return read_sint(c) << static_cast<unsigned long>(s);
}

}  // namespace noli::checker
