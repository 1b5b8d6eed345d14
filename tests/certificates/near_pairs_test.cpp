// SPDX-License-Identifier: Apache-2.0
#include "certificates/near_pairs.h"

#include <gtest/gtest.h>

#include <map>

#include "tests/kernel/random_numbers.h"

namespace noli::certificates {
namespace {

Stencil pair_of(std::uint32_t a, std::uint32_t b) {
  return {FeaturePair::vertex_vertex, {a, b, 0, 0}, pair_key(FeaturePair::vertex_vertex, a, b)};
}

TEST(PairNumbers, AreThoseOfAMapWhateverComesAndGoes) {
  noli::test::Random random(1);
  constexpr int firsts = 4, seconds = 7;
  PairNumbers numbers(firsts);
  std::map<PairKey, std::uint32_t> expected;
  for (std::uint32_t round = 0; round < 5000; ++round) {
    const Stencil pair =
        pair_of(static_cast<std::uint32_t>(random.below(firsts)), static_cast<std::uint32_t>(random.below(seconds)));
    if (expected.erase(pair.key) > 0) {
      numbers.remove(pair);
    } else {
      numbers.add(pair, round);
      expected.emplace(pair.key, round);
    }
    for (std::uint32_t a = 0; a < firsts; ++a) {
      for (std::uint32_t b = 0; b < seconds; ++b) {
        const auto found = expected.find(pair_of(a, b).key);
        ASSERT_EQ(numbers.find(pair_of(a, b)), found == expected.end() ? PairNumbers::none : found->second) << round;
      }
    }
  }
}

TEST(PairNumbers, OfAPairThatIsNotThereIsAnError) {
  PairNumbers numbers(2);
  numbers.add(pair_of(0, 1), 5);
  EXPECT_EQ(numbers.at(pair_of(0, 1)), 5U);
  EXPECT_THROW(numbers.at(pair_of(1, 0)), std::out_of_range);
}

TEST(PairNumbers, AreGivenAnewInTheOrderOfFirstVertices) {
  PairNumbers numbers(3);
  numbers.add(pair_of(2, 0), 7);
  numbers.add(pair_of(0, 1), 8);
  std::vector<std::uint32_t> before;
  numbers.renumber([&](std::uint32_t number) {
    before.push_back(number);
    return number + 10;
  });
  EXPECT_EQ(before, (std::vector<std::uint32_t>{8, 7}));
  EXPECT_EQ(numbers.at(pair_of(2, 0)), 17U);
  PairNumbers other(3);
  other.swap(numbers);
  EXPECT_EQ(numbers.find(pair_of(0, 1)), PairNumbers::none);
  EXPECT_EQ(other.find(pair_of(0, 1)), 18U);
  other.clear();
  EXPECT_EQ(other.find(pair_of(0, 1)), PairNumbers::none);
}

}  // namespace
}  // namespace noli::certificates
