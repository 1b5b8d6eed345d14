// SPDX-License-Identifier: Apache-2.0
#include "trajectory/formats/exact_rational.h"

#include <fmt/format.h>
#include <gmpxx.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdlib>

#include "trajectory/text.h"

namespace noli {
namespace {

constexpr int significand_bits = 53;
constexpr std::int64_t lowest_exponent = -1074;  ///< of the last bit of a subnormal
constexpr std::int64_t highest_exponent = 1024;  ///< every finite double is less than two to this power

/// Whether the word is a decimal integer: an optional sign and digits.
bool is_decimal_integer(std::string_view word) {
  if (!word.empty() && (word[0] == '-' || word[0] == '+')) word.remove_prefix(1);
  return !word.empty() && std::all_of(word.begin(), word.end(), [](char c) { return c >= '0' && c <= '9'; });
}

/// The usual case: both fit a machine word, the denominator is a power of two, and the numerator has at most 53 bits.
bool parse_small(std::string_view numerator, std::string_view denominator, double& value) {
  std::int64_t n = 0, d = 0;
  if (parse_number(numerator, n) != std::errc{} || parse_number(denominator, d) != std::errc{}) return false;
  const bool exact = n != 0 && std::llabs(n / 2) < (std::int64_t{1} << (significand_bits - 1)) && d > 0 &&
                     std::has_single_bit(static_cast<std::uint64_t>(d));
  if (exact) value = static_cast<double>(n) / static_cast<double>(d);
  return exact;
}

mpz_class to_integer(std::string_view word) {
  if (word[0] == '+') word.remove_prefix(1);
  return mpz_class(std::string(word), 10);
}

/// Number of zero bits below the lowest one. Precondition: not zero.
std::int64_t trailing_zeros(const mpz_class& z) { return static_cast<std::int64_t>(mpz_scan1(z.get_mpz_t(), 0)); }

/// Takes the factors of two out of z, which must not be zero, and returns how many there were.
std::int64_t make_odd(mpz_class& z) {
  const std::int64_t zeros = trailing_zeros(z);
  z >>= static_cast<mp_bitcnt_t>(zeros);
  return zeros;
}

std::int64_t bit_length(const mpz_class& z) { return static_cast<std::int64_t>(mpz_sizeinbase(z.get_mpz_t(), 2)); }

/// Sets `value` to n 2^exponent, n odd, if that is a double.
bool scale_exactly(const mpz_class& n, std::int64_t exponent, double& value) {
  const std::int64_t bits = bit_length(n);
  if (bits > significand_bits || exponent < lowest_exponent || bits + exponent > highest_exponent) return false;
  value = std::ldexp(n.get_d(), static_cast<int>(exponent));
  return true;
}

}  // namespace

std::string parse_exact_quotient(std::string_view numerator, std::string_view denominator, double& value) {
  if (parse_small(numerator, denominator, value)) return {};
  for (const std::string_view word : {numerator, denominator}) {
    if (!is_decimal_integer(word)) return fmt::format("expected a whole number, found {}", in_quotes(word));
  }
  mpz_class n = to_integer(numerator), d = to_integer(denominator);
  if (d == 0) return "the denominator is zero";
  if (n == 0) {
    value = numerator[0] == '-' ? -0.0 : 0.0;
    return {};
  }
  const std::int64_t exponent = make_odd(n) - make_odd(d);
  const bool is_dyadic = mpz_divisible_p(n.get_mpz_t(), d.get_mpz_t()) != 0;
  if (is_dyadic) mpz_divexact(n.get_mpz_t(), n.get_mpz_t(), d.get_mpz_t());
  if (is_dyadic && scale_exactly(n, exponent, value)) return {};
  return fmt::format("the quotient of {} and {} is not exactly a double", in_quotes(numerator), in_quotes(denominator));
}

std::string format_exact_quotient(double value) {
  if (value == 0) return std::signbit(value) ? "-0,1" : "0,1";
  int exponent = 0;
  mpz_class n(std::ldexp(std::frexp(value, &exponent), significand_bits)), d(1);
  const std::int64_t shift = exponent - significand_bits + make_odd(n);
  mpz_class& scaled = shift >= 0 ? n : d;
  scaled <<= static_cast<mp_bitcnt_t>(std::llabs(shift));
  return n.get_str() + ',' + d.get_str();
}

}  // namespace noli
