// SPDX-License-Identifier: Apache-2.0
//
// Wraps MPFR numbers of any precision for the integrator: each operation rounds once, to nearest, ties to even.
//
// Notation
//   p             precision in bits, of the significand with its leading 1
//   binary64      p = 53 with the exponents of IEEE 754: a significand 0.1... times 2^e with e from emin = -1073 to
//                 emax = 1024 (MPFR's convention), and subnormal numbers by mpfr_subnormalize after each operation,
//                 which undoes double rounding. Then + - * / sqrt are those of the processor, bit for bit (MPFR manual,
//                 "Exception Related Functions")
//   scope         an MpfrScope: while it exists, results of operations on its thread have its precision. A copy is
//                 exact and keeps the precision of its original
//
// The digits are stored in the number itself, so nothing is allocated. Operations are not inline: a call is cheap
// compared with the operation, and the integrator's loops, which inline all they can, still compile in reasonable time.
//
// Comparing numbers of different precision is exact. Operations outside of scopes have 53 bits and MPFR's exponent
// range. There are no NaN payloads, no flags, no other rounding modes, and no functions except the square root and the
// absolute value.
#pragma once

// First, so that it declares functions on intmax_t or FILE only if earlier includes asked for them.
#include <mpfr.h>

#include <Eigen/Core>
#include <compare>
#include <limits>

namespace noli::audit {

/// The precision and exponent range of results.
struct Arithmetic {
  int bits = 53;
  bool binary64 = false;  ///< exponents as in IEEE 754 binary64; else MPFR's widest range

  friend bool operator==(const Arithmetic&, const Arithmetic&) = default;
};

/// The processor's arithmetic.
constexpr Arithmetic hardware_double{53, true};

class MpfrNumber {
 public:
  static constexpr int least_bits = 2, most_bits = 1024;

  MpfrNumber();  ///< 0
  explicit MpfrNumber(double x);
  explicit MpfrNumber(int x) : MpfrNumber(static_cast<double>(x)) {}
  MpfrNumber(const MpfrNumber& other) { *this = other; }
  MpfrNumber& operator=(const MpfrNumber& other);

  int bits() const { return static_cast<int>(mpfr_get_prec(value_)); }
  /// Rounds to the nearest double.
  explicit operator double() const { return mpfr_get_d(value_, MPFR_RNDN); }
  bool finite() const { return mpfr_number_p(value_) != 0; }
  bool is_nan() const { return mpfr_nan_p(value_) != 0; }
  bool negative() const { return mpfr_signbit(value_) != 0; }  ///< -0 and NaN have a sign too

  friend MpfrNumber operator+(const MpfrNumber& a, const MpfrNumber& b);
  friend MpfrNumber operator-(const MpfrNumber& a, const MpfrNumber& b);
  friend MpfrNumber operator*(const MpfrNumber& a, const MpfrNumber& b);
  friend MpfrNumber operator/(const MpfrNumber& a, const MpfrNumber& b);
  friend MpfrNumber operator-(const MpfrNumber& a);
  friend MpfrNumber sqrt(const MpfrNumber& a);
  friend MpfrNumber abs(const MpfrNumber& a);
  MpfrNumber& operator+=(const MpfrNumber& b) { return *this = *this + b; }
  MpfrNumber& operator-=(const MpfrNumber& b) { return *this = *this - b; }
  MpfrNumber& operator*=(const MpfrNumber& b) { return *this = *this * b; }
  MpfrNumber& operator/=(const MpfrNumber& b) { return *this = *this / b; }

  // With NaN, all of these are false except !=.
  friend bool operator==(const MpfrNumber& a, const MpfrNumber& b) { return mpfr_equal_p(a.value_, b.value_) != 0; }
  friend std::partial_ordering operator<=>(const MpfrNumber& a, const MpfrNumber& b) {
    if (mpfr_unordered_p(a.value_, b.value_) != 0) return std::partial_ordering::unordered;
    return mpfr_cmp(a.value_, b.value_) <=> 0;
  }

 private:
  friend class MpfrScope;

  static constexpr std::size_t most_limbs = (most_bits + GMP_NUMB_BITS - 1) / GMP_NUMB_BITS;

  template <class Function, class... Arguments>
  static MpfrNumber of(Function* function, const Arguments&... arguments);

  mpfr_t value_;
  mp_limb_t limbs_[most_limbs];
};

/// Sets this thread's arithmetic while the object exists. Throws std::invalid_argument for precisions that MpfrNumber
/// does not support.
class MpfrScope {
 public:
  explicit MpfrScope(const Arithmetic& arithmetic);
  ~MpfrScope();
  MpfrScope(const MpfrScope&) = delete;
  MpfrScope& operator=(const MpfrScope&) = delete;

 private:
  Arithmetic before_;
  mpfr_exp_t emin_, emax_;
};

}  // namespace noli::audit

/// The formulas use these as thresholds, which must be the same in all precisions: they are those of double.
template <>
class std::numeric_limits<noli::audit::MpfrNumber> {
 public:
  static constexpr bool is_specialized = true, is_signed = true, is_integer = false, is_exact = false;
  static noli::audit::MpfrNumber min() { return noli::audit::MpfrNumber(std::numeric_limits<double>::min()); }
  static noli::audit::MpfrNumber max() { return noli::audit::MpfrNumber(std::numeric_limits<double>::max()); }
  static noli::audit::MpfrNumber epsilon() { return noli::audit::MpfrNumber(std::numeric_limits<double>::epsilon()); }
};

namespace Eigen {
/// Costs decide the order in which Eigen adds the terms of a sum, so they must be those of double.
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
