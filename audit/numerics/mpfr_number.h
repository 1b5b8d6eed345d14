// SPDX-License-Identifier: Apache-2.0
//
// Numbers of as many bits as a run wants: MPFR's, rounded to nearest, ties to even, each operation once.
//
// Notation
//   p             precision in bits, of the significand with its leading 1
//   binary64      p = 53 with the exponents of IEEE 754: a significand 0.1... times 2^e with e from emin = -1073 to
//                 emax = 1024 (MPFR's convention), and subnormal numbers by mpfr_subnormalize after each operation,
//                 which undoes double rounding. Then + - * / sqrt are those of the processor, bit for bit (MPFR manual,
//                 "Exception Related Functions")
//   scope         an MpfrScope: on its thread, until it ends, results of operations have its precision. A copy has the
//                 precision of what was copied, and is exact
//
// The digits are in the number itself, so nothing is allocated. Operations are not inline: beside what they do a call
// costs nothing, and the integrator's loops, which inline all they can, stay compilable.
//
// What this does not do: no NaN payloads, no flags, no other rounding modes, and no functions but the square root and
// the absolute value. Comparing numbers of different precision is exact. Operations outside of scopes have 53 bits and
// the exponents of MPFR.
#pragma once

// First, so that it declares what has to do with intmax_t or FILE only if others have asked for it.
#include <mpfr.h>

#include <Eigen/Core>
#include <compare>
#include <limits>

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

  MpfrNumber();  ///< 0
  explicit MpfrNumber(double x);
  explicit MpfrNumber(int x) : MpfrNumber(static_cast<double>(x)) {}
  MpfrNumber(const MpfrNumber& other) { *this = other; }
  MpfrNumber& operator=(const MpfrNumber& other);

  int bits() const { return static_cast<int>(mpfr_get_prec(value_)); }
  /// The nearest double.
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

  // With NaN all of these are false, but for !=.
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

/// Makes this thread's arithmetic another one for as long as it is there. Throws std::invalid_argument for precisions
/// that MpfrNumber does not have.
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
