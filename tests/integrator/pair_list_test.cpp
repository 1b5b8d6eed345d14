// SPDX-License-Identifier: Apache-2.0
#include "integrator/contact.h"

#include <gtest/gtest.h>

#include <map>

#include "tests/kernel/random_numbers.h"

namespace noli::integrator {
namespace {

certificates::Stencil pair_of(std::uint32_t a, std::uint32_t b) {
  return {FeaturePair::vertex_vertex, {a, b, 0, 0}, certificates::pair_key(FeaturePair::vertex_vertex, a, b)};
}

std::vector<certificates::PairKey> keys(const PairList& list) {
  std::vector<certificates::PairKey> result;
  for (const certificates::Stencil& pair : list.in_order()) result.push_back(pair.key);
  return result;
}

TEST(PairList, IsASortedSetWhateverJoinsAndLeaves) {
  noli::test::Random random(1);
  PairList list;
  std::map<certificates::PairKey, certificates::Stencil> expected;
  for (int round = 0; round < 300; ++round) {
    const int changes = random.below(40);
    for (int i = 0; i < changes; ++i) {
      const auto pair =
          pair_of(static_cast<std::uint32_t>(random.below(5)), static_cast<std::uint32_t>(random.below(6)));
      if (expected.contains(pair.key)) {
        list.remove(pair);
        expected.erase(pair.key);
      } else {
        list.add(pair);
        expected.emplace(pair.key, pair);
      }
      ASSERT_EQ(list.empty(), expected.empty());
    }
    std::vector<certificates::PairKey> sorted;
    for (const auto& [key, pair] : expected) sorted.push_back(key);
    ASSERT_EQ(keys(list), sorted) << round;
  }
}

TEST(PairList, WhatWasAskedForStaysWhileItChanges) {
  PairList list;
  list.add(pair_of(1, 2));
  list.add(pair_of(0, 2));
  const auto before = list.in_order();
  ASSERT_EQ(before.size(), 2U);
  for (std::uint32_t i = 3; i < 1000; ++i) list.add(pair_of(0, i));
  list.remove(pair_of(0, 2));
  EXPECT_EQ(before[0].key, pair_of(0, 2).key);
  EXPECT_EQ(before[1].key, pair_of(1, 2).key);
  EXPECT_EQ(list.in_order().size(), 998U);
}

}  // namespace
}  // namespace noli::integrator
