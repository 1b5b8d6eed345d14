// SPDX-License-Identifier: Apache-2.0
#include "certify/simulate/energy_watch.h"

#include <gtest/gtest.h>

#include <limits>

namespace noli {
namespace {

using integrator::ForceKind;

SeriesRow row(double time, double kinetic, double spring, double gravity = 0, double damping = 0) {
  SeriesRow result;
  result.time = time;
  result.kinetic = result.kinetic_mean = kinetic;
  result.potential[static_cast<std::size_t>(ForceKind::edge_spring)] = spring;
  result.potential[static_cast<std::size_t>(ForceKind::gravity)] = gravity;
  result.damping_work[static_cast<std::size_t>(ForceKind::edge_spring)] = damping;
  return result;
}

EnergyWatch watch(bool losses, std::initializer_list<SeriesRow> rows) {
  EnergyWatch result(1, {}, losses);
  for (const SeriesRow& one : rows) result.add(one);
  return result;
}

TEST(EnergyWatch, LetsEnergyGoToAndFro) {
  EXPECT_FALSE(watch(false, {}).astray());
  EXPECT_FALSE(watch(false, {row(1, 0.25, 0.75), row(2, 0.98, 0.0), row(3, 0.5, 0.53)}).astray());
  EXPECT_FALSE(watch(false, {row(1, 1e6, 0, 1 - 1e6), row(2, 0, 0, 1)}).astray());  // it falls and comes back
}

TEST(EnergyWatch, SaysWhereItIsFarthestOff) {
  const auto found = watch(false, {row(1, 1, 0.2), row(2, 3, 0), row(3, 1, 0)}).astray();
  ASSERT_TRUE(found);
  EXPECT_EQ(found->begin, 1);
  EXPECT_EQ(found->there, 3);
  EXPECT_EQ(found->time, 2);
  EXPECT_EQ(found->scale, 3);
  EXPECT_TRUE(watch(false, {row(1, 0.9, 0)}).astray());  // what is lost without a book
}

TEST(EnergyWatch, PutsBackWhatDampingTook) {
  EXPECT_FALSE(watch(false, {row(1, 0.5, 0, 0, -0.5), row(2, 0.25, 0, 0, -0.25)}).astray());
  EXPECT_TRUE(watch(false, {row(1, 0.5, 0, 0, -0.5), row(2, 0.5, 0, 0, -0.25)}).astray());
}

TEST(EnergyWatch, TakesALossForRestitutionAndNoGain) {
  EXPECT_FALSE(watch(true, {row(1, 0.25, 0)}).astray());
  EXPECT_TRUE(watch(true, {row(1, 1.25, 0)}).astray());
}

TEST(EnergyWatch, WhatIsNoNumberHasGoneAstray) {
  constexpr double inf = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(watch(false, {row(1, inf, 0)}).astray());
  EXPECT_TRUE(watch(false, {row(1, inf, -inf), row(2, 1, 0)}).astray());
}

}  // namespace
}  // namespace noli
