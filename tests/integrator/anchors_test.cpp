// SPDX-License-Identifier: Apache-2.0
#include "integrator/anchors.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <vector>

namespace noli::integrator {
namespace {

using Weights = std::array<double, 4>;

constexpr Weights middle{1, -0.5, -0.5, 0};

PairInLayer pair_in(std::uint16_t material, std::uint32_t layer, VertexId vertex = 0) {
  return {material, layer, FeaturePair::vertex_edge, {vertex, 8, 9, 0}};
}

TEST(Anchors, LastAsLongAsTheirLayerActsAgainInTime) {
  Anchors<double> anchors;
  EXPECT_EQ(anchors.renew(pair_in(0, 1), 0, 1), nullptr);
  anchors.begin(pair_in(0, 1), middle, 0, 1);
  for (const double t : {0.5, 1.5, 2.5}) {
    const Weights* const weights = anchors.renew(pair_in(0, 1), t, 1);
    ASSERT_NE(weights, nullptr) << t;
    EXPECT_EQ(*weights, middle);
  }
  EXPECT_EQ(anchors.after(3.5).size(), 1U);
  EXPECT_TRUE(anchors.after(3.75).empty());
  EXPECT_EQ(anchors.renew(pair_in(0, 1), 3.75, 1), nullptr);
}

TEST(Anchors, EachLayerOfEachMaterialHasItsOwn) {
  Anchors<double> anchors;
  anchors.begin(pair_in(0, 1), middle, 0, 1);
  EXPECT_EQ(anchors.renew(pair_in(0, 2), 0, 1), nullptr);
  EXPECT_EQ(anchors.renew(pair_in(1, 1), 0, 1), nullptr);
  EXPECT_EQ(anchors.renew(pair_in(0, 1, 1), 0, 1), nullptr);
  EXPECT_NE(anchors.renew(pair_in(0, 1), 0, 1), nullptr);
}

TEST(Anchors, BeginAnew) {
  Anchors<double> anchors;
  anchors.begin(pair_in(0, 1), middle, 0, 1);
  anchors.begin(pair_in(0, 1), {1, -1, 0, 0}, 2, 1);
  EXPECT_EQ(*anchors.renew(pair_in(0, 1), 2, 1), (Weights{1, -1, 0, 0}));
}

TEST(Anchors, AscendAndAreRestored) {
  const std::vector<PairInLayer> ascending{pair_in(0, 1, 1), pair_in(0, 2, 0), pair_in(0, 2, 1), pair_in(1, 1, 0)};
  Anchors<double> anchors;
  for (const std::size_t i : {2, 0, 3, 1}) anchors.begin(ascending[i], middle, 0, 1);
  const std::vector<Anchor<double>> all = anchors.after(1);
  ASSERT_EQ(all.size(), ascending.size());
  for (std::size_t i = 0; i < all.size(); ++i) EXPECT_EQ(all[i].of, ascending[i]);
  Anchors<double> restored;
  restored.begin(pair_in(7, 7), middle, 0, 1);
  restored.restore(all);
  EXPECT_EQ(restored.after(0), all);
}

/// A run that touches ever new pairs keeps only what lasts.
TEST(Anchors, OldOnesAreDropped) {
  Anchors<double> anchors;
  for (VertexId v = 0; v < 100'000; ++v) anchors.begin(pair_in(0, 1, 10 + v), middle, v, 0.5);
  EXPECT_LT(anchors.after(0).size(), 2'000U);
  EXPECT_EQ(anchors.after(99'999).size(), 1U);
}

}  // namespace
}  // namespace noli::integrator
