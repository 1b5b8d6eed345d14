// SPDX-License-Identifier: Apache-2.0
#include "kernel/arithmetic/algebraic.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>

namespace noli {
namespace {

constexpr double double_error = 0x1p-53;

std::shared_ptr<const Polynomial> linear(const Integer& num, const Integer& den) {
  return std::make_shared<const Polynomial>(Polynomial({-num, den}));
}

Dyadic add(const Dyadic& a, const Integer& numerator, std::size_t e) { return {a.scaled(e) + numerator, e}; }

double quotient_about(const Integer& num, const Integer& den) {
  long e = 0, f = 0;
  const double a = mpz_get_d_2exp(&e, num.get()), b = mpz_get_d_2exp(&f, den.get());
  return std::ldexp(a / b, static_cast<int>(std::max(e - f, -2000L)));
}

/// Whether p and q have a root in common between low and high. Preconditions: p has at most one root there; the
/// greatest common divisor is not zero at low and high.
bool share_root(const Polynomial& p, const Polynomial& q, const Dyadic& low, const Dyadic& high) {
  const bool same = &p == &q;
  if (!same && surely_coprime(p, q)) return false;
  const Polynomial common = same ? p : gcd(p, q);
  return common.degree() > 0 && common.sign_at(low) != common.sign_at(high);
}

/// Doubles in [0, 1] in ascending order are integers in ascending order.
std::uint64_t rank_of(double x) { return std::bit_cast<std::uint64_t>(x); }
double of_rank(std::uint64_t rank) { return std::bit_cast<double>(rank); }

}  // namespace

AlgebraicNumber::AlgebraicNumber(const Dyadic& x) { become(x); }

AlgebraicNumber AlgebraicNumber::rational(const Integer& num, const Integer& den) {
  AlgebraicNumber result;
  result.p_ = std::make_shared<const Polynomial>(linear(num, den)->primitive());
  const Integer& d = result.p_->leading();
  if (trailing_zeros(d) + 1 == d.bit_length()) {  // a power of two
    result.become({-(*result.p_)[0], trailing_zeros(d)});
  } else {
    result.sign_high_ = 1;
    result.set_interval({}, Dyadic::from_integer(1));
    result.polish(quotient_about(num, den));
  }
  return result;
}

AlgebraicNumber::AlgebraicNumber(std::shared_ptr<const Polynomial> p, Dyadic low, Dyadic high) : p_(std::move(p)) {
  if (low == high) {
    become(std::move(low));
  } else {
    sign_high_ = p_->sign_at(high);
    set_interval(std::move(low), std::move(high));
  }
}

void AlgebraicNumber::become(Dyadic x) {
  x = x.reduced();
  p_ = linear(x.m, Integer(1) << x.e);
  sign_high_ = 0;
  set_interval(x, x);
}

void AlgebraicNumber::set_interval(Dyadic low, Dyadic high) {
  low_ = std::move(low);
  high_ = std::move(high);
  const double a = floor_to_double(low_), b = ceil_to_double(high_);
  about_ = a + (b - a) / 2;
  reach_ = b - a;  // not half of it, as the middle is rounded
}

void AlgebraicNumber::cut_at(const Dyadic& x) { keep_side(x, compare(x)); }

void AlgebraicNumber::keep_side(const Dyadic& x, int side) {
  if (side == 0) {
    become(x);
  } else if (side > 0) {
    if (x > low_) set_interval(x, high_);
  } else if (x < high_) {
    set_interval(low_, x);
  }
}

int AlgebraicNumber::compare(const Dyadic& x) const {
  if (sign_high_ == 0) return low_ < x ? -1 : low_ > x;
  if (x <= low_) return 1;
  if (x >= high_) return -1;
  return -sign_high_ * p_->sign_at(x);
}

void AlgebraicNumber::polish(double proposal) {
  if (sign_high_ == 0 || !(proposal >= 0 && proposal <= 1)) return;
  const double reach = std::ldexp(proposal, -45);
  const double simple = std::nearbyint(proposal * 0x1p20) * 0x1p-20;
  if (std::abs(simple - proposal) <= reach) cut_at(Dyadic::from_double(simple));
  if (sign_high_ == 0) return;
  cut_at(Dyadic::from_double(std::max(0.0, proposal - reach)));
  if (sign_high_ != 0) cut_at(Dyadic::from_double(std::min(1.0, proposal + reach)));
}

void AlgebraicNumber::refine_quadratically(std::size_t& log_pieces) {
  const std::size_t common = std::max(low_.e, high_.e), e = common + log_pieces;
  const Integer width = high_.scaled(common) - low_.scaled(common);  // a piece, in units of 2^-e
  const Integer at_low = absolute(p_->scaled_value(low_.scaled(common), common));
  const Integer at_high = absolute(p_->scaled_value(high_.scaled(common), common));
  // The border between pieces that is nearest to the zero of the chord, then the next one on the root's side.
  Integer piece = (at_low << (log_pieces + 1)) + at_low + at_high;
  const Integer both = (at_low + at_high) << 1;
  mpz_fdiv_q(piece.get(), piece.get(), both.get());
  const Dyadic guess = add(low_, piece * width, e);
  const int side = compare(guess);
  if (side == 0) return become(guess);
  const Dyadic other = side > 0 ? add(guess, width, e) : add(guess, -width, e);
  const int other_side = compare(other);
  keep_side(guess, side);
  keep_side(other, other_side);
  if (other_side == 0) return;
  const bool hit = side != other_side;
  log_pieces = hit ? 2 * log_pieces : std::max<std::size_t>(1, log_pieces / 2);
  if (!hit) cut_at(middle(low_, high_));
}

std::size_t AlgebraicNumber::width_bits() const {
  const std::size_t e = std::max(low_.e, high_.e), bits = (high_.scaled(e) - low_.scaled(e)).bit_length();
  return e > bits ? e - bits : 0;
}

void AlgebraicNumber::refine(std::size_t bits) {
  if (sign_high_ == 0) return;
  // On an interval of width w, the zero of the chord is off by about w^2 unless the root is ill-conditioned.
  std::size_t have = width_bits(), log_pieces = std::max<std::size_t>(2, have - std::min<std::size_t>(have, 8));
  while (sign_high_ != 0 && (have = width_bits()) < bits) {
    log_pieces = std::min(log_pieces, bits - have + 2);
    refine_quadratically(log_pieces);
  }
}

double AlgebraicNumber::floor() const {
  std::uint64_t below = rank_of(floor_to_double(low_)), above = rank_of(ceil_to_double(high_)) + 1;
  if (sign_high_ == 0) return of_rank(below);
  // Invariant: of_rank(below) <= number < of_rank(above).
  for (std::uint64_t probe = rank_of(about_); above - below > 1; probe = below + (above - below) / 2) {
    if (probe <= below || probe >= above) probe = below + (above - below) / 2;
    (compare(Dyadic::from_double(of_rank(probe))) >= 0 ? below : above) = probe;
  }
  return of_rank(below);
}

bool AlgebraicNumber::approximate_sign(const Polynomial& q, int& sign) const {
  constexpr std::size_t most = 12;
  const std::size_t n = static_cast<std::size_t>(q.degree());
  if (n > most) return false;
  std::array<double, most + 1> c;
  long top = 0;
  for (std::size_t i = 0; i <= n; ++i) top = std::max(top, static_cast<long>(q[i].bit_length()));
  double sum = 0, value = 0;
  for (std::size_t i = 0; i <= n; ++i) {
    long exponent = 0;
    const double mantissa = mpz_get_d_2exp(&exponent, q[i].get());
    c[i] = exponent - top < -200 ? 0 : std::ldexp(mantissa, static_cast<int>(exponent - top));
    sum += std::abs(c[i]);
  }
  for (std::size_t i = n + 1; i-- > 0;) value = value * about_ + c[i];
  // On [0, 1], |q'| <= n sum; coefficients are cut (1 ulp each, or below 2^-200), Horner's rule adds 2 n roundings.
  const double error =
      sum * (static_cast<double>(n) * reach_ + 4 * static_cast<double>(n + 1) * double_error) + 0x1p-190;
  sign = value > 0 ? 1 : -1;
  return std::abs(value) > 1.01 * error;
}

int AlgebraicNumber::sign_by_refinement(const Polynomial& q) {
  // |q(x) - q(low)| <= (high - low) n sum |c[i]| on the interval.
  const Integer steepness = q.coefficient_sum() * Integer(q.degree());
  for (std::size_t bits = width_bits();; bits = 2 * bits + 8) {
    refine(bits);
    const std::size_t e = std::max(low_.e, high_.e);
    const Integer at_low = q.scaled_value(low_.scaled(e), e);
    const Integer width = high_.scaled(e) - low_.scaled(e);
    if (absolute(at_low) > ((steepness * width) << (e * static_cast<std::size_t>(q.degree() - 1))))
      return at_low.sign();
  }
}

int AlgebraicNumber::sign_of(const Polynomial& q) {
  int sign = 0;
  if (q.degree() <= 0) return q.is_zero() ? 0 : q[0].sign();
  if (approximate_sign(q, sign)) return sign;
  if (sign_high_ == 0) return q.sign_at(low_);
  if (is_rational()) return q.sign_at_rational(-(*p_)[0], p_->leading());
  return share_root(*p_, q, low_, high_) ? 0 : sign_by_refinement(q);
}

namespace {

/// The order, if one number is dyadic or the intervals do not overlap; otherwise nothing.
std::optional<std::strong_ordering> compare_intervals(const AlgebraicNumber& a, const AlgebraicNumber& b) {
  if (b.is_dyadic()) return a.compare(b.low()) <=> 0;
  if (a.is_dyadic()) return 0 <=> b.compare(a.low());
  if (a.high() < b.low()) return std::strong_ordering::less;
  if (a.low() > b.high()) return std::strong_ordering::greater;
  return std::nullopt;
}

std::strong_ordering compare_by_refinement(AlgebraicNumber a, AlgebraicNumber b) {
  for (std::size_t bits = std::max(a.width_bits(), b.width_bits()) + 32;; bits *= 2) {
    a.refine(bits);
    b.refine(bits);
    if (const auto order = compare_intervals(a, b)) return *order;
  }
}

}  // namespace

std::strong_ordering operator<=>(const AlgebraicNumber& a, const AlgebraicNumber& b) {
  const double gap = a.about_ - b.about_;
  if (std::abs(gap) > (a.reach_ + b.reach_) * 1.01 + 0x1p-52) {
    return gap < 0 ? std::strong_ordering::less : std::strong_ordering::greater;
  }
  if (const auto order = compare_intervals(a, b)) return *order;
  // The intervals overlap and neither is a point, so a common root in both is the number itself.
  const bool equal = share_root(a.polynomial(), b.polynomial(), std::max(a.low_, b.low_), std::min(a.high_, b.high_));
  return equal ? std::strong_ordering::equal : compare_by_refinement(a, b);
}

}  // namespace noli
