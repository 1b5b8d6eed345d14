// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cfenv>
#include <cstdlib>

#include "kernel/arithmetic/rounding.h"

namespace noli {
namespace {

/// Whether switching to upward rounding affects a sum; under Valgrind it does not.
bool upward_rounding_works() {
  const int before = std::fegetround();
  std::fesetround(FE_UPWARD);
  volatile double one = 1, tiny = 0x1p-100;
  volatile double sum = one + tiny;
  std::fesetround(before);
  return sum > 1;
}

TEST(Rounding, NearestIsAsTheStandardSays) { EXPECT_TRUE(rounding_self_test().nearest_ok); }

TEST(Rounding, DirectedIsReportedAsItIs) { EXPECT_EQ(rounding_self_test().directed_ok, upward_rounding_works()); }

TEST(Rounding, ModeIsAsItWasBefore) {
  rounding_self_test();
  EXPECT_EQ(std::fegetround(), FE_TONEAREST);
}

TEST(Rounding, TextsDiffer) {
  const RoundingReport good{true, true}, no_direction{true, false}, bad{false, true};
  EXPECT_TRUE(good.ok());
  EXPECT_FALSE(no_direction.ok());
  EXPECT_FALSE(bad.ok());
  EXPECT_NE(good.text(), no_direction.text());
  EXPECT_NE(no_direction.text(), bad.text());
  EXPECT_NE(good.text(), bad.text());
}

}  // namespace
}  // namespace noli
