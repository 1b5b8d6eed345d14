// SPDX-License-Identifier: Apache-2.0
#include <noli/cgal.h>

#include <stdexcept>
#include <utility>

#include "kernel/arithmetic/algebraic.h"
#include "kernel/cgal_numbers.h"

namespace noli {
namespace {

int set(mpfr_ptr result, const Dyadic& x, mpfr_rnd_t rounding) {
  return mpfr_set_z_2exp(result, x.m.get(), -static_cast<mpfr_exp_t>(x.e), rounding);
}

/// An MPFR number that clears itself.
struct Mpfr {
  explicit Mpfr(mpfr_prec_t precision) { mpfr_init2(value, precision); }
  Mpfr(const Mpfr&) = delete;
  Mpfr& operator=(const Mpfr&) = delete;
  ~Mpfr() { mpfr_clear(value); }
  mpfr_t value;
};

/// Precondition: x >= 0.
Dyadic dyadic_of(mpfr_srcptr x) {
  Dyadic result;
  if (mpfr_zero_p(x)) return result;
  const mpfr_exp_t exponent = mpfr_get_z_2exp(result.m.get(), x);
  if (exponent >= 0) {
    result.m <<= static_cast<std::size_t>(exponent);
  } else {
    result.e = static_cast<std::size_t>(-exponent);
  }
  return result;
}

/// The first number above x at which rounding to `precision` bits may change. It has one more bit.
Dyadic next_border(const Dyadic& x, mpfr_prec_t precision) {
  Mpfr border(precision + 1);
  set(border.value, x, MPFR_RNDU);
  return dyadic_of(border.value);
}

}  // namespace

AlgebraicKernel::Algebraic_real_1 to_algebraic_real_1(const TimeOfImpact& time) {
  const auto construct = AlgebraicKernel().construct_algebraic_real_1_object();
  const AlgebraicNumber& t = time.algebraic();
  if (t.is_dyadic()) return construct(cgal_detail::gmpq(t.low()));
  return construct(cgal_detail::polynomial(t.polynomial().primitive()), cgal_detail::gmpq(t.low()),
                   cgal_detail::gmpq(t.high()));
}

TimeOfImpact from_algebraic_real_1(const AlgebraicKernel::Algebraic_real_1& x) {
  const auto p = cgal_detail::polynomial(AlgebraicKernel().compute_polynomial_1_object()(x));
  for (AlgebraicNumber& root : roots_in_unit_interval(p)) {
    TimeOfImpact time(std::move(root));
    if (to_algebraic_real_1(time) == x) return time;
  }
  throw std::domain_error("a time of impact is in [0, 1]");
}

int to_mpfr(const TimeOfImpact& time, mpfr_ptr result, mpfr_rnd_t rounding) {
  const mpfr_prec_t precision = mpfr_get_prec(result);
  Mpfr at_low(precision);
  AlgebraicNumber finer = time.algebraic();
  for (std::size_t bits = static_cast<std::size_t>(precision) + 32;; bits *= 2) {
    finer.refine(bits);
    if (finer.is_dyadic()) return set(result, finer.low(), rounding);
    set(at_low.value, finer.low(), rounding);
    set(result, finer.high(), rounding);
    if (mpfr_equal_p(at_low.value, result)) return -finer.compare(dyadic_of(result));
    // Between the ends there is a number at which the rounding changes, and it may be the time itself.
    finer.cut_at(next_border(finer.low(), precision));
  }
}

}  // namespace noli
