// SPDX-License-Identifier: Apache-2.0
#include "audit/numerics/mpfr_number.h"

#include <algorithm>
#include <stdexcept>

namespace noli::audit {
namespace {

constexpr mpfr_exp_t binary64_emin = -1073, binary64_emax = 1024;

/// The arithmetic of this thread. Outside of scopes: 53 bits and MPFR's exponent range.
thread_local Arithmetic current;

}  // namespace

MpfrNumber::MpfrNumber() {
  mpfr_custom_init(limbs_, current.bits);
  mpfr_custom_init_set(value_, MPFR_ZERO_KIND, 0, current.bits, limbs_);
}

/// The result of `function`, rounded to the precision of the scope.
template <class Function, class... Arguments>
MpfrNumber MpfrNumber::of(Function* function, const Arguments&... arguments) {
  MpfrNumber result;
  const int ternary = function(result.value_, arguments.value_..., MPFR_RNDN);
  if (current.binary64) mpfr_subnormalize(result.value_, ternary, MPFR_RNDN);
  return result;
}

MpfrNumber::MpfrNumber(double x) : MpfrNumber() {
  const int ternary = mpfr_set_d(value_, x, MPFR_RNDN);
  if (current.binary64) mpfr_subnormalize(value_, ternary, MPFR_RNDN);
}

MpfrNumber& MpfrNumber::operator=(const MpfrNumber& other) {
  if (this == &other) return *this;
  value_[0] = other.value_[0];
  const std::size_t used = (static_cast<std::size_t>(bits()) + GMP_NUMB_BITS - 1) / GMP_NUMB_BITS;
  std::copy_n(other.limbs_, used, limbs_);
  mpfr_custom_move(value_, limbs_);
  return *this;
}

MpfrNumber operator+(const MpfrNumber& a, const MpfrNumber& b) { return MpfrNumber::of(mpfr_add, a, b); }
MpfrNumber operator-(const MpfrNumber& a, const MpfrNumber& b) { return MpfrNumber::of(mpfr_sub, a, b); }
MpfrNumber operator*(const MpfrNumber& a, const MpfrNumber& b) { return MpfrNumber::of(mpfr_mul, a, b); }
MpfrNumber operator/(const MpfrNumber& a, const MpfrNumber& b) { return MpfrNumber::of(mpfr_div, a, b); }
MpfrNumber operator-(const MpfrNumber& a) { return MpfrNumber::of(mpfr_neg, a); }
MpfrNumber sqrt(const MpfrNumber& a) { return MpfrNumber::of(mpfr_sqrt, a); }
MpfrNumber abs(const MpfrNumber& a) { return MpfrNumber::of(mpfr_abs, a); }

MpfrScope::MpfrScope(const Arithmetic& arithmetic) : before_(current), emin_(mpfr_get_emin()), emax_(mpfr_get_emax()) {
  if (arithmetic.bits < MpfrNumber::least_bits || arithmetic.bits > MpfrNumber::most_bits) {
    throw std::invalid_argument("expected a precision that numbers of MPFR have here");
  }
  current = arithmetic;
  mpfr_set_emin(arithmetic.binary64 ? binary64_emin : mpfr_get_emin_min());
  mpfr_set_emax(arithmetic.binary64 ? binary64_emax : mpfr_get_emax_max());
}

MpfrScope::~MpfrScope() {
  current = before_;
  mpfr_set_emin(emin_);
  mpfr_set_emax(emax_);
}

}  // namespace noli::audit
