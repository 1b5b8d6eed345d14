// SPDX-License-Identifier: Apache-2.0
#include "proofs/prover/group_pair.h"

#include <gtest/gtest.h>

namespace noli {
namespace {

void expect_groups(const GroupPair& pair, Group first, Group second) {
  for (const auto& [got, expected] : {std::pair(pair.first(), first), std::pair(pair.second(), second)}) {
    EXPECT_EQ(got.node, expected.node);
    EXPECT_EQ(got.begin, expected.begin);
    EXPECT_EQ(got.count, expected.count);
  }
  EXPECT_EQ(pair.first_node(), first.node);
  EXPECT_EQ(pair.second_node(), second.node);
}

void expect_children(Group a, Group b) {
  const GroupPair pair(a, b);
  expect_groups(pair, a, b);
  expect_groups(pair.left_left(), a.left(), b.left());
  expect_groups(pair.left_right(), a.left(), b.right());
  expect_groups(pair.right_left(), a.right(), b.left());
  expect_groups(pair.right_right(), a.right(), b.right());
  expect_groups(pair.left_whole(), a.left(), b);
  expect_groups(pair.right_whole(), a.right(), b);
  expect_groups(pair.whole_left(), a, b.left());
  expect_groups(pair.whole_right(), a, b.right());
}

TEST(GroupPair, SplitsAsItsGroupsDo) {
  expect_children({0, 0, 2}, {3, 2, 3});
  expect_children({10, 4, 7}, {23, 11, 8});
  expect_children({23, 11, 8}, {10, 4, 7});
}

TEST(GroupPair, HalvesDoNotMixInTheLargestTrees) {
  const std::uint32_t half = (1U << 30U) - 1, all = 2 * half + 1;
  const Group root{0, 0, all};
  expect_children(root.left(), root.right());
  expect_children(root.right(), root.left());
}

TEST(GroupPair, KnowsLeavesAndSelves) {
  const Group leaf{5, 3, 1}, other{6, 4, 1}, group{7, 5, 2};
  EXPECT_TRUE(GroupPair(leaf, other).both_leaves());
  EXPECT_FALSE(GroupPair(leaf, group).both_leaves());
  EXPECT_FALSE(GroupPair(group, leaf).both_leaves());
  EXPECT_TRUE(GroupPair(leaf, group).first_is_leaf());
  EXPECT_FALSE(GroupPair(leaf, group).second_is_leaf());
  EXPECT_TRUE(GroupPair(group, leaf).second_is_leaf());
  EXPECT_FALSE(GroupPair(group, leaf).first_is_leaf());
  EXPECT_TRUE(GroupPair(group, group).is_self());
  EXPECT_FALSE(GroupPair(leaf, other).is_self());
}

}  // namespace
}  // namespace noli
