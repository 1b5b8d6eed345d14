// SPDX-License-Identifier: Apache-2.0
//
// Tests directions with as many bits as a proof can hold.
#include "proofs/prover/cells/exact_direction.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "kernel/formula.h"

namespace noli {
namespace {

/// (a, b) with a = 2^bits and b a power of 3 of that size, and its opposite up to one unit. A direction that separates
/// both is orthogonal to (a, b), to that many bits.
std::vector<IntegerVector> almost_opposite(std::size_t bits) {
  const Integer a = Integer(1) << bits;
  Integer b;
  mpz_ui_pow_ui(b.get(), 3, static_cast<unsigned long>(static_cast<double>(bits) / 1.585));
  return {{a, b, Integer(0)}, {-a, Integer(1) - b, Integer(0)}};
}

TEST(ExactDirection, HasAsManyBitsAsItTakes) {
  for (const std::size_t bits : {100U, 2000U, 8300U}) {
    const auto differences = almost_opposite(bits);
    const auto n = exact_direction(differences, Integer(0));
    ASSERT_TRUE(n) << bits;
    for (const IntegerVector& w : differences) {
      EXPECT_GT(((*n)[0] * w[0] + (*n)[1] * w[1] + (*n)[2] * w[2]).sign(), 0) << bits;
    }
    for (const Integer& part : *n) EXPECT_LE(part.bit_length(), std::min<std::size_t>(3 * bits, 8399)) << bits;
  }
}

bool separates_all(const IntegerVector& n, const std::vector<IntegerVector>& differences) {
  return std::ranges::all_of(differences, [&n](const auto& w) { return formula::dot(n, w).sign() > 0; });
}

/// Whether any direction of one, two or three points separates, tried one by one without any filter.
bool is_separable(const std::vector<IntegerVector>& d) {
  using formula::operator-;
  for (const IntegerVector& w : d) {
    if (separates_all(w, d)) return true;
  }
  for (std::size_t i = 0; i < d.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const IntegerVector u = d[j] - d[i];
      const Integer uu = formula::dot(u, u), wu = formula::dot(d[i], u);
      const IntegerVector across = {d[i][0] * uu - u[0] * wu, d[i][1] * uu - u[1] * wu, d[i][2] * uu - u[2] * wu};
      if (separates_all(across, d)) return true;
      for (std::size_t k = 0; k < j; ++k) {
        const IntegerVector n = formula::cross(u, d[k] - d[i]);
        if (separates_all(n, d) || separates_all({-n[0], -n[1], -n[2]}, d)) return true;
      }
    }
  }
  return false;
}

/// Doubles rule out directions before exact arithmetic looks at them: never one that separates.
TEST(ExactDirection, IsFoundIfAndOnlyIfThereIsOne) {
  std::mt19937_64 random(7);
  const auto number = [&](int most) {
    return static_cast<long>(random() % (2 * static_cast<unsigned>(most) + 1)) - most;
  };
  int found = 0, none = 0;
  for (int round = 0; round < 1500; ++round) {
    std::vector<IntegerVector> d;
    const std::size_t count = 2 + random() % 6;
    const int lift = round % 3;  // how much all lean to one side
    const auto far = static_cast<unsigned>(random() % 3 == 0 ? random() % 3000 : 0);
    for (std::size_t i = 0; i < count; ++i) {
      // Some nearly parallel, some tiny beside others, some with zeros.
      IntegerVector w = {Integer(number(9)), Integer(number(9)), Integer(lift * 4 + number(9))};
      if (random() % 3 == 0) {
        for (Integer& part : w) part = (part << far) + Integer(number(1));
      }
      d.push_back(w);
    }
    const auto n = exact_direction(d, Integer(0));
    EXPECT_EQ(n.has_value(), is_separable(d)) << round;
    EXPECT_TRUE(!n || separates_all(*n, d)) << round;
    ++(n ? found : none);
  }
  EXPECT_GT(found, 300);
  EXPECT_GT(none, 150);
}

/// Without the limit, a writer would write proofs that checkers refuse.
TEST(ExactDirection, IsNotGivenWhereAProofHasNoRoomForIt) {
  EXPECT_FALSE(exact_direction(almost_opposite(8600), Integer(0)));
}

}  // namespace
}  // namespace noli
