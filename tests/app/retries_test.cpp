// SPDX-License-Identifier: Apache-2.0
#include "certify/simulate/retries.h"

#include <gtest/gtest.h>

namespace noli {
namespace {

TEST(Retries, FirstTakeMoreLayersThenHalveStepsForGood) {
  Retries retries(2);
  const auto first = retries.next(5);
  ASSERT_TRUE(first);
  EXPECT_GT(first->least_layers, 5U);
  EXPECT_EQ(first->halvings, 2U);
  for (std::uint64_t halvings = 3; halvings < 2 + Retries::most; ++halvings) {
    const auto next = retries.next(5);
    ASSERT_TRUE(next);
    EXPECT_EQ(next->least_layers, 0U);
    EXPECT_EQ(next->halvings, halvings);
  }
  EXPECT_FALSE(retries.next(5));
  EXPECT_FALSE(retries.committed());
  const auto of_the_next_window = retries.next(5);
  ASSERT_TRUE(of_the_next_window);
  EXPECT_EQ(of_the_next_window->halvings, 1U + Retries::most);
}

TEST(Retries, WindowsThatMoreLayersMendAreDefectsOfCertificates) {
  Retries retries;
  EXPECT_FALSE(retries.committed());
  retries.next(1);
  EXPECT_TRUE(retries.committed());
  EXPECT_FALSE(retries.committed());
  retries.next(1);
  retries.next(1);
  EXPECT_FALSE(retries.committed());
}

}  // namespace
}  // namespace noli
