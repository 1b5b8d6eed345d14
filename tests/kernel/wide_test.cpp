// SPDX-License-Identifier: Apache-2.0
//
// Compares integers of fixed width with GMP's.
#include <gmpxx.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <random>

#include "kernel/arithmetic/wide.h"

namespace noli {
namespace {

/// A number whose limbs are often all zeros or all ones, so that carries propagate far.
template <std::size_t N>
Wide<N> any_wide(std::mt19937_64& random) {
  Wide<N> result;
  for (std::size_t i = 0; i < N; ++i) {
    const std::uint64_t choice = random() % 4;
    result.limb(i) = choice == 0 ? 0 : choice == 1 ? ~std::uint64_t{0} : random() >> (random() % 64);
  }
  return result;
}

template <std::size_t N>
mpz_class to_mpz(const Wide<N>& x) {
  mpz_class value = x.is_negative() ? -1 : 0;
  for (std::size_t i = N; i-- > 0;) {
    value <<= 64;
    const std::uint64_t limb = x.limb(i);
    value += mpz_class(static_cast<unsigned long>(limb));
  }
  return value;
}

/// The value wrapped to N limbs, read as two's complement.
template <std::size_t N>
mpz_class wrapped(mpz_class value) {
  const mpz_class modulus = mpz_class(1) << (64 * N);
  mpz_class rest;
  mpz_fdiv_r(rest.get_mpz_t(), value.get_mpz_t(), modulus.get_mpz_t());
  return rest >= modulus / 2 ? mpz_class(rest - modulus) : rest;
}

template <std::size_t N, std::size_t M>
void compare_products(std::mt19937_64& random) {
  for (int i = 0; i < 2000; ++i) {
    const auto a = any_wide<N>(random);
    const auto b = any_wide<M>(random);
    ASSERT_EQ(to_mpz(a * b), to_mpz(a) * to_mpz(b)) << to_mpz(a) << " * " << to_mpz(b);
  }
}

TEST(Wide, ProductsAreExact) {
  std::mt19937_64 random(1);
  compare_products<1, 1>(random);
  compare_products<1, 2>(random);
  compare_products<2, 1>(random);
  compare_products<2, 2>(random);
  compare_products<3, 6>(random);
  compare_products<16, 16>(random);
}

template <std::size_t N>
void compare_sums(std::mt19937_64& random) {
  for (int i = 0; i < 2000; ++i) {
    const auto a = any_wide<N>(random);
    const auto b = any_wide<N>(random);
    ASSERT_EQ(to_mpz(a + b), wrapped<N>(to_mpz(a) + to_mpz(b)));
    ASSERT_EQ(to_mpz(a - b), wrapped<N>(to_mpz(a) - to_mpz(b)));
    ASSERT_EQ(to_mpz(-a), wrapped<N>(-to_mpz(a)));
    ASSERT_EQ(a.sign(), sgn(to_mpz(a)));
    ASSERT_EQ(a.is_zero(), to_mpz(a) == 0);
    ASSERT_EQ(to_mpz(Wide<N + 1>(a)), to_mpz(a));
  }
}

TEST(Wide, SumsWrapAsTwosComplement) {
  std::mt19937_64 random(2);
  compare_sums<1>(random);
  compare_sums<2>(random);
  compare_sums<3>(random);
  compare_sums<12>(random);
}

TEST(Wide, SignOfZeroAndOfTheExtremes) {
  EXPECT_EQ(Wide<2>().sign(), 0);
  EXPECT_EQ(Wide<2>(-1).sign(), -1);
  EXPECT_EQ(Wide<2>(1).sign(), 1);
  EXPECT_EQ(Wide<2>(INT64_MIN).sign(), -1);
}

template <std::size_t N>
void compare_approximations(std::mt19937_64& random) {
  for (int i = 0; i < 2000; ++i) {
    const auto a = any_wide<N>(random);
    const mpq_class exact(to_mpz(a)), approximate(a.approximate());
    ASSERT_LE(abs(approximate - exact) * (mpz_class(1) << 51), abs(exact)) << to_mpz(a);
  }
}

TEST(Wide, ApproximationIsGoodToTwoToTheMinus51) {
  std::mt19937_64 random(3);
  compare_approximations<1>(random);
  compare_approximations<2>(random);
  compare_approximations<6>(random);
  EXPECT_EQ(Wide<3>().approximate(), 0);
  Wide<18> huge;
  huge.limb(17) = 1;
  EXPECT_TRUE(std::isinf(huge.approximate()));
}

TEST(Wide, ShiftedMantissas) {
  std::mt19937_64 random(4);
  for (int i = 0; i < 2000; ++i) {
    const auto mantissa = static_cast<std::int64_t>(random() >> 11) * (random() % 2 == 0 ? 1 : -1);
    const auto shift = static_cast<unsigned>(random() % (4 * 64 - 54));
    ASSERT_EQ(to_mpz(Wide<4>::shifted(mantissa, shift)), mpz_class(static_cast<long>(mantissa)) << shift);
  }
}

}  // namespace
}  // namespace noli
