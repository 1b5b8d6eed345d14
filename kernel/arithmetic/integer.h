// SPDX-License-Identifier: Apache-2.0
//
// Integers of any size, as values: GMP's mpz_t with a destructor and plain operators, so that the templates of
// kernel/formula.h take them like any other number. Temporaries are reused, as most of the time goes into allocation.
//
// When memory runs out, GMP ends the program unless mp_set_memory_functions says otherwise.
#pragma once

#include <gmp.h>

#include <compare>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace noli {

class Integer {
 public:
  Integer() noexcept { mpz_init(z_); }
  explicit Integer(long value) { mpz_init_set_si(z_, value); }
  Integer(const Integer& other) { mpz_init_set(z_, other.z_); }
  Integer(Integer&& other) noexcept : Integer() { mpz_swap(z_, other.z_); }
  ~Integer() { mpz_clear(z_); }

  Integer& operator=(const Integer& other) {
    mpz_set(z_, other.z_);
    return *this;
  }
  Integer& operator=(Integer&& other) noexcept {
    mpz_swap(z_, other.z_);
    return *this;
  }

  mpz_srcptr get() const { return z_; }
  mpz_ptr get() { return z_; }

  int sign() const { return mpz_sgn(z_); }
  bool is_zero() const { return sign() == 0; }
  /// Bits of |*this|; 0 for 0.
  std::size_t bit_length() const { return is_zero() ? 0 : mpz_sizeinbase(z_, 2); }

  Integer& operator+=(const Integer& b) {
    mpz_add(z_, z_, b.z_);
    return *this;
  }
  Integer& operator-=(const Integer& b) {
    mpz_sub(z_, z_, b.z_);
    return *this;
  }
  Integer& operator*=(const Integer& b) {
    mpz_mul(z_, z_, b.z_);
    return *this;
  }
  Integer& operator<<=(std::size_t bits) {
    mpz_mul_2exp(z_, z_, bits);
    return *this;
  }
  /// Rounds towards minus infinity.
  Integer& operator>>=(std::size_t bits) {
    mpz_fdiv_q_2exp(z_, z_, bits);
    return *this;
  }
  Integer& negate() {
    mpz_neg(z_, z_);
    return *this;
  }

  friend Integer operator-(Integer a) { return std::move(a.negate()); }

  friend Integer operator+(const Integer& a, const Integer& b) {
    Integer c;
    mpz_add(c.z_, a.z_, b.z_);
    return c;
  }
  friend Integer operator+(Integer&& a, const Integer& b) { return std::move(a += b); }
  friend Integer operator+(const Integer& a, Integer&& b) { return std::move(b += a); }
  friend Integer operator+(Integer&& a, Integer&& b) { return std::move(a += b); }

  friend Integer operator-(const Integer& a, const Integer& b) {
    Integer c;
    mpz_sub(c.z_, a.z_, b.z_);
    return c;
  }
  friend Integer operator-(Integer&& a, const Integer& b) { return std::move(a -= b); }

  friend Integer operator*(const Integer& a, const Integer& b) {
    Integer c;
    mpz_mul(c.z_, a.z_, b.z_);
    return c;
  }
  friend Integer operator<<(Integer a, std::size_t bits) { return std::move(a <<= bits); }

  friend bool operator==(const Integer& a, const Integer& b) { return mpz_cmp(a.z_, b.z_) == 0; }
  friend std::strong_ordering operator<=>(const Integer& a, const Integer& b) { return mpz_cmp(a.z_, b.z_) <=> 0; }

 private:
  mpz_t z_;
};

inline Integer absolute(Integer a) {
  mpz_abs(a.get(), a.get());
  return a;
}

/// Precondition: b divides a.
inline Integer divide_exactly(const Integer& a, const Integer& b) {
  Integer c;
  mpz_divexact(c.get(), a.get(), b.get());
  return c;
}

/// The exponent of the lowest set bit. Precondition: a is not 0.
inline std::size_t trailing_zeros(const Integer& a) { return mpz_scan1(a.get(), 0); }

}  // namespace noli
