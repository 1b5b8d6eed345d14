// SPDX-License-Identifier: Apache-2.0
//
// Numbers of as many bits as a run wants: MPFR's, rounded to nearest, ties to even, each operation once.
//
// Notation
//   p             precision in bits, of the significand with its leading 1
//   binary64      p = 53 with the exponents of IEEE 754: a significand 0.1... times 2^e with e from emin = -1073 to
//                 emax = 1024 (MPFR's convention), and subnormal numbers by mpfr_subnormalize after each operation, which
//                 undoes double rounding. Then + - * / sqrt are those of the processor, bit for bit (MPFR manual,
//                 "Exception Related Functions")
//   scope         an MpfrScope: on its thread, until it ends, results of operations have its precision. A copy has the
//                 precision of what was copied, and is exact
//
// The digits are in the number itself, so nothing is allocated.
//
// What this does not do: no NaN payloads, no flags, no other rounding modes, and no functions but the square root and the
// absolute value. Comparing numbers of different precision is exact. It promises nothing of operations outside of scopes.
#pragma once

// First, so that it declares what has to do with intmax_t or FILE only if others have asked for it.
#include <mpfr.h>

#include <Eigen/Core>
#include <algorithm>
#include <compare>
#include <limits>
#include <stdexcept>

namespace noli::audit {

/// What operations yield.
struct Arithmetic {
  int bits = 53;
  bool binary64 = false;  ///< exponents as in IEEE 754 binary64; else as wide as MPFR has them

  friend bool operator==(const Arithmetic&, const Arithmetic&) = default;
};

/// That of the processor.
constexpr Arithmetic hardware_double{53, true};

class MpfrNumber {
 public:
  static constexpr int least_bits = 2, most_bits = 1024;

  MpfrNumber() { set_zero(); }
  explicit MpfrNumber(double x) {
    prepare();
    finish(mpfr_set_d(value_, x, MPFR_RNDN));
  }
  explicit MpfrNumber(int x) : MpfrNumber(static_cast<double>(x)) {}
  MpfrNumber(const MpfrNumber& other) { copy(other); }
  MpfrNumber& operator=(const MpfrNumber& other) {
    if (this != &other) copy(other);
    return *this;
  }

  int bits() const { return static_cast<int>(mpfr_get_prec(value_)); }
  /// The nearest double.
  explicit operator double() const { return mpfr_get_d(value_, MPFR_RNDN); }
  bool finite() const { return mpfr_number_p(value_) != 0; }
  bool negative() const { return mpfr_signbit(value_) != 0; }  ///< -0 and NaN have a sign too
  mpfr_srcptr get() const { return value_; }

  friend MpfrNumber operator+(const MpfrNumber& a, const MpfrNumber& b) { return of(mpfr_add, a, b); }
  friend MpfrNumber operator-(const MpfrNumber& a, const MpfrNumber& b) { return of(mpfr_sub, a, b); }
  friend MpfrNumber operator*(const MpfrNumber& a, const MpfrNumber& b) { return of(mpfr_mul, a, b); }
  friend MpfrNumber operator/(const MpfrNumber& a, const MpfrNumber& b) { return of(mpfr_div, a, b); }
  friend MpfrNumber operator-(const MpfrNumber& a) { return of(mpfr_neg, a); }
  friend MpfrNumber sqrt(const MpfrNumber& a) { return of(mpfr_sqrt, a); }
  friend MpfrNumber abs(const MpfrNumber& a) { return of(mpfr_abs, a); }
  MpfrNumber& operator+=(const MpfrNumber& b) { return *this = *this + b; }
  MpfrNumber& operator-=(const MpfrNumber& b) { return *this = *this - b; }
  MpfrNumber& operator*=(const MpfrNumber& b) { return *this = *this * b; }
  MpfrNumber& operator/=(const MpfrNumber& b) { return *this = *this / b; }

  // With NaN all of these are false, but for !=.
  friend bool operator==(const MpfrNumber& a, const MpfrNumber& b) { return mpfr_equal_p(a.value_, b.value_) != 0; }
  friend std::partial_ordering operator<=>(const MpfrNumber& a, const MpfrNumber& b) {
    if (mpfr_unordered_p(a.value_, b.value_) != 0) return std::partial_ordering::unordered;
    return mpfr_cmp(a.value_, b.value_) <=> 0;
  }

 private:
  friend class MpfrScope;

  static constexpr std::size_t most_limbs = (most_bits + GMP_NUMB_BITS - 1) / GMP_NUMB_BITS;
  static inline thread_local Arithmetic arithmetic_;

  /// A value of the scope's precision, to be set.
  void prepare() { set_zero(); }
  void set_zero() {
    mpfr_custom_init(limbs_, arithmetic_.bits);
    mpfr_custom_init_set(value_, MPFR_ZERO_KIND, 0, arithmetic_.bits, limbs_);
  }
  void copy(const MpfrNumber& other) {
    value_[0] = other.value_[0];
    const std::size_t used = (static_cast<std::size_t>(bits()) + GMP_NUMB_BITS - 1) / GMP_NUMB_BITS;
    std::copy_n(other.limbs_, used, limbs_);
    mpfr_custom_move(value_, limbs_);
  }
  void finish(int ternary) {
    if (arithmetic_.binary64) mpfr_subnormalize(value_, ternary, MPFR_RNDN);
  }
  template <class Function, class... Arguments>
  static MpfrNumber of(Function* function, const Arguments&... arguments) {
    MpfrNumber result;
    result.finish(function(result.value_, arguments.value_..., MPFR_RNDN));
    return result;
  }

  mpfr_t value_;
  mp_limb_t limbs_[most_limbs];
};

/// Makes this thread's arithmetic another one for as long as it is there. Throws std::invalid_argument for precisions
/// that MpfrNumber does not have.
class MpfrScope {
 public:
  explicit MpfrScope(const Arithmetic& arithmetic)
      : before_(MpfrNumber::arithmetic_), emin_(mpfr_get_emin()), emax_(mpfr_get_emax()) {
    if (arithmetic.bits < MpfrNumber::least_bits || arithmetic.bits > MpfrNumber::most_bits) {
      throw std::invalid_argument("no such precision");
    }
    MpfrNumber::arithmetic_ = arithmetic;
    mpfr_set_emin(arithmetic.binary64 ? -1073 : mpfr_get_emin_min());
    mpfr_set_emax(arithmetic.binary64 ? 1024 : mpfr_get_emax_max());
  }
  ~MpfrScope() {
    MpfrNumber::arithmetic_ = before_;
    mpfr_set_emin(emin_);
    mpfr_set_emax(emax_);
  }
  MpfrScope(const MpfrScope&) = delete;
  MpfrScope& operator=(const MpfrScope&) = delete;

 private:
  Arithmetic before_;
  mpfr_exp_t emin_, emax_;
};

inline bool isfinite(const MpfrNumber& x) { return x.finite(); }

}  // namespace noli::audit

/// The formulas ask for these as thresholds, of which there is to be one in all precisions: they are those of double.
template <>
class std::numeric_limits<noli::audit::MpfrNumber> {
 public:
  static constexpr bool is_specialized = true, is_signed = true, is_integer = false, is_exact = false;
  static noli::audit::MpfrNumber min() { return noli::audit::MpfrNumber(std::numeric_limits<double>::min()); }
  static noli::audit::MpfrNumber max() { return noli::audit::MpfrNumber(std::numeric_limits<double>::max()); }
  static noli::audit::MpfrNumber epsilon() { return noli::audit::MpfrNumber(std::numeric_limits<double>::epsilon()); }
};

namespace Eigen {
/// Costs decide in which order Eigen adds up the terms of a sum: they have to be those of double.
template <>
struct NumTraits<noli::audit::MpfrNumber> : GenericNumTraits<noli::audit::MpfrNumber> {
  using Real = noli::audit::MpfrNumber;
  using NonInteger = noli::audit::MpfrNumber;
  using Nested = noli::audit::MpfrNumber;
  using Literal = noli::audit::MpfrNumber;
  enum {
    IsComplex = 0,
    IsInteger = 0,
    IsSigned = 1,
    RequireInitialization = 1,
    ReadCost = NumTraits<double>::ReadCost,
    AddCost = NumTraits<double>::AddCost,
    MulCost = NumTraits<double>::MulCost
  };
};
}  // namespace Eigen
