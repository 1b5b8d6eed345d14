// SPDX-License-Identifier: Apache-2.0
//
// Tests directions with as many bits as a proof can hold.
#include "proofs/prover/cells/exact_direction.h"

#include <gtest/gtest.h>

#include <algorithm>

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

/// Without the limit, a writer would write proofs that checkers refuse.
TEST(ExactDirection, IsNotGivenWhereAProofHasNoRoomForIt) {
  EXPECT_FALSE(exact_direction(almost_opposite(8600), Integer(0)));
}

}  // namespace
}  // namespace noli
