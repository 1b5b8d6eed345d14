// SPDX-License-Identifier: Apache-2.0
//
// Signed integers of a fixed number of 64-bit limbs, without allocation. Products widen, so they are exact. Sums keep
// the width of the wider operand, and the caller must leave enough bits free (kernel/contact.cpp counts them).
//
// Overflow is not checked at run time.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace noli {

__extension__ using DoubleLimb = unsigned __int128;
__extension__ using SignedDoubleLimb = __int128;

template <std::size_t N>
class Wide {
 public:
  constexpr Wide() = default;
  constexpr explicit Wide(std::int64_t value) {
    limbs_.fill(value < 0 ? ~std::uint64_t{0} : 0);
    limbs_[0] = static_cast<std::uint64_t>(value);
  }
  /// Sign extension.
  template <std::size_t M>
  requires(M < N) constexpr explicit Wide(const Wide<M>& narrow) {
    limbs_.fill(narrow.is_negative() ? ~std::uint64_t{0} : 0);
    for (std::size_t i = 0; i < M; ++i) limbs_[i] = narrow.limb(i);
  }

  /// mantissa * 2^shift. Precondition: it fits, with the sign bit.
  static constexpr Wide shifted(std::int64_t mantissa, unsigned shift) {
    const std::uint64_t magnitude =
        mantissa < 0 ? 0 - static_cast<std::uint64_t>(mantissa) : static_cast<std::uint64_t>(mantissa);
    Wide result;
    const std::size_t limb = shift / 64, bit = shift % 64;
    result.limbs_[limb] = magnitude << bit;
    if (bit != 0 && limb + 1 < N) result.limbs_[limb + 1] = magnitude >> (64 - bit);
    return mantissa < 0 ? -result : result;
  }

  constexpr std::uint64_t limb(std::size_t i) const { return limbs_[i]; }
  constexpr std::uint64_t& limb(std::size_t i) { return limbs_[i]; }
  constexpr bool is_negative() const { return (limbs_[N - 1] >> 63) != 0; }

  constexpr bool is_zero() const {
    std::uint64_t any = 0;
    for (std::size_t i = 0; i < N; ++i) any |= limbs_[i];
    return any == 0;
  }

  constexpr int sign() const { return is_negative() ? -1 : (is_zero() ? 0 : 1); }

  /// The value with a relative error below 2^-51; 0 only for 0. Infinite beyond the range of double.
  double approximate() const {
    const Wide magnitude = is_negative() ? -*this : *this;
    double value = 0;
    for (std::size_t i = N; i-- > 0;) value = value * 0x1p64 + static_cast<double>(magnitude.limbs_[i]);
    return is_negative() ? -value : value;
  }

  constexpr Wide operator-() const { return Wide() - *this; }

  friend constexpr Wide operator+(const Wide& a, const Wide& b) {
    Wide result;
    unsigned long long carry = 0;
    for (std::size_t i = 0; i < N; ++i) {
      const DoubleLimb sum = static_cast<DoubleLimb>(a.limbs_[i]) + b.limbs_[i] + carry;
      result.limbs_[i] = static_cast<std::uint64_t>(sum);
      carry = static_cast<unsigned long long>(sum >> 64);
    }
    return result;
  }

  friend constexpr Wide operator-(const Wide& a, const Wide& b) {
    Wide result;
    unsigned long long borrow = 0;
    for (std::size_t i = 0; i < N; ++i) {
      const DoubleLimb difference = static_cast<DoubleLimb>(a.limbs_[i]) - b.limbs_[i] - borrow;
      result.limbs_[i] = static_cast<std::uint64_t>(difference);
      borrow = static_cast<unsigned long long>(difference >> 64) & 1;
    }
    return result;
  }

  friend constexpr bool operator==(const Wide&, const Wide&) = default;

 private:
  std::array<std::uint64_t, N> limbs_{};
};

/// The whole product: N + M limbs.
template <std::size_t N, std::size_t M>
constexpr Wide<N + M> operator*(const Wide<N>& a, const Wide<M>& b) {
  Wide<N + M> result;
  for (std::size_t i = 0; i < N; ++i) {
    std::uint64_t carry = 0;
    for (std::size_t j = 0; j < M; ++j) {
      const DoubleLimb t = static_cast<DoubleLimb>(a.limb(i)) * b.limb(j) + result.limb(i + j) + carry;
      result.limb(i + j) = static_cast<std::uint64_t>(t);
      carry = static_cast<std::uint64_t>(t >> 64);
    }
    result.limb(i + M) = carry;
  }
  // The product so far is unsigned: it read a negative a as a + 2^(64 N).
  const auto subtract_high = [&result](const auto& x, std::size_t from, std::size_t count) {
    std::uint64_t borrow = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const DoubleLimb d = static_cast<DoubleLimb>(result.limb(from + i)) - x.limb(i) - borrow;
      result.limb(from + i) = static_cast<std::uint64_t>(d);
      borrow = static_cast<std::uint64_t>(d >> 64) & 1;
    }
  };
  if (a.is_negative()) subtract_high(b, N, M);
  if (b.is_negative()) subtract_high(a, M, N);
  return result;
}

/// The machine has an instruction for this product.
constexpr Wide<2> operator*(const Wide<1>& a, const Wide<1>& b) {
  const SignedDoubleLimb product =
      static_cast<SignedDoubleLimb>(static_cast<std::int64_t>(a.limb(0))) * static_cast<std::int64_t>(b.limb(0));
  Wide<2> result;
  result.limb(0) = static_cast<std::uint64_t>(product);
  result.limb(1) = static_cast<std::uint64_t>(static_cast<DoubleLimb>(product) >> 64);
  return result;
}

}  // namespace noli
