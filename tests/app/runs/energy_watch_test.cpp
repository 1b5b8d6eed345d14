// SPDX-License-Identifier: Apache-2.0
#include "certify/simulate/energy_watch.h"

#include <gtest/gtest.h>

#include <limits>

namespace noli {
namespace {

/// A window that ends with this kinetic energy, and with `integration` as the energy made by finite steps.
SeriesRow row(double time, double kinetic, double integration) {
  SeriesRow result;
  result.time = time;
  result.kinetic = result.kinetic_mean = kinetic;
  result.integration = integration;
  return result;
}

SeriesRow damped(SeriesRow row, double work) {
  row.damping_work[static_cast<std::size_t>(ForceKind::edge_spring)] = work;
  return row;
}

SeriesRow struck(SeriesRow row) {
  row.events[static_cast<std::size_t>(ForceKind::contact)] = 1;
  return row;
}

SeriesRow with_restitution(SeriesRow row, double work) {
  row.restitution_work = work;
  return struck(row);
}

SeriesRow pushed(SeriesRow row, double work) {
  row.held_work[static_cast<std::size_t>(ForceKind::contact)] = work;
  return row;
}

EnergyWatch watch(std::initializer_list<SeriesRow> rows) {
  EnergyWatch result;
  for (const SeriesRow& one : rows) result.add(one);
  return result;
}

TEST(EnergyWatch, LetsEnergyGoToAndFro) {
  EXPECT_FALSE(watch({}).astray());
  EXPECT_FALSE(watch({row(1, 1, 0), row(2, 0.97, -0.03), row(3, 1, 0.03)}).astray());
  SeriesRow low = row(1, 1e6, 0);  // it falls and comes back
  low.potential[static_cast<std::size_t>(ForceKind::gravity)] = -1e6;
  EXPECT_FALSE(watch({low, row(2, 0, 0)}).astray());
}

TEST(EnergyWatch, SaysWhereItIsFarthestOff) {
  const EnergyWatch watched = watch({row(1, 1.2, 0.2), row(2, 3, 1.8), row(3, 1, -2)});
  const auto found = watched.astray();
  ASSERT_TRUE(found);
  EXPECT_EQ(found->begin, 1);
  EXPECT_EQ(found->there, 3);
  EXPECT_EQ(found->time, 2);
  EXPECT_EQ(found->scale, 3);
  EXPECT_EQ(watched.integration(), 0);
  EXPECT_TRUE(watch({row(1, 0.9, -0.1)}).astray()) << "what is lost without a book";
}

TEST(EnergyWatch, TheGravityOfAFallIsNoScale) {
  SeriesRow fallen = row(1, 1, 0.06);
  fallen.potential[static_cast<std::size_t>(ForceKind::gravity)] = 1e6;
  EXPECT_TRUE(watch({fallen}).astray());
}

TEST(EnergyWatch, WhatWasGivenIsPartOfTheScale) {
  EXPECT_TRUE(watch({row(1, 1, 0.06)}).astray());
  EXPECT_FALSE(watch({damped(row(1, 1, 0.06), -0.5)}).astray());
  EXPECT_FALSE(watch({pushed(row(1, 1, 0.06), 0.5)}).astray());
  EXPECT_TRUE(watch({pushed(row(1, 1, 0.08), 0.5)}).astray());
}

TEST(EnergyWatch, DampingMayTakeEnergyAndGiveNone) {
  EXPECT_FALSE(watch({damped(row(1, 0.5, 0), -0.5)}).astray());
  const auto found = watch({damped(row(1, 1, 0), -0.5), damped(row(2, 1.4, 0), 0.4)}).astray();
  ASSERT_TRUE(found);
  EXPECT_EQ(found->time, 2);
  EXPECT_TRUE(watch({damped(row(1, 1, -0.2), 0.2)}).astray()) << "they do not make up for each other";
  SeriesRow belt = row(1, 1.4, 0);  // moves what lies on it
  belt.damping_work[static_cast<std::size_t>(ForceKind::contact)] = 0.4;
  EXPECT_FALSE(watch({belt}).astray());
}

TEST(EnergyWatch, TheBeginningIsPartOfTheScale) {
  EnergyWatch fast(1), slow(0.5);
  fast.add(row(1, 0.1, 0.04));
  slow.add(row(1, 0.1, 0.04));
  EXPECT_FALSE(fast.astray());
  EXPECT_TRUE(slow.astray());
}

TEST(EnergyWatch, RoundingMayMakeALittle) {
  EnergyWatch watched(0, 1e-9);
  watched.add(row(1, 1e-20, 1e-20));
  EXPECT_FALSE(watched.astray());
  watched.add(row(2, 1e-9, 1e-9));
  EXPECT_TRUE(watched.astray());
}

/// A body that rests on layers: its forces' steps give energy with each kick, which damping and friction take before
/// the next one.
TEST(EnergyWatch, WhereLayersActAndDampingTakesEnergyItMayFallAndNotRise) {
  EXPECT_FALSE(watch({struck(damped(row(1, 1, 2), -2))}).astray());
  EXPECT_TRUE(watch({damped(row(1, 1, 2), -2)}).astray()) << "without contact";
  EXPECT_TRUE(watch({struck(row(1, 1, -0.5))}).astray()) << "without damping";
  EnergyWatch unstable(0, 0, false);
  unstable.add(struck(damped(row(1, 1, 2), -2)));
  EXPECT_TRUE(unstable.astray()) << "where steps may be too long";
  const auto found = watch({struck(damped(row(1, 4, 3), -1))}).astray();
  ASSERT_TRUE(found);
  EXPECT_TRUE(found->may_fall);
  EXPECT_EQ(found->there - found->begin, 2);
}

TEST(EnergyWatch, WhereRestitutionTakesEnergyItMayFallAndNotRise) {
  EXPECT_FALSE(watch({with_restitution(row(1, 1, 2), -2)}).astray()) << "what it is booked for and did not take";
  EXPECT_FALSE(watch({with_restitution(damped(row(1, 1, 3), -1), -2)}).astray());
  EXPECT_FALSE(watch({with_restitution(row(1, 1, -0.5), -0.1)}).astray());
  const auto found = watch({with_restitution(row(1, 4, 3), -1)}).astray();
  ASSERT_TRUE(found);
  EXPECT_TRUE(found->may_fall);
  EXPECT_EQ(found->there - found->begin, 2);
}

TEST(EnergyWatch, WhatIsNoNumberHasGoneAstray) {
  constexpr double inf = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(watch({row(1, inf, inf)}).astray());
  EXPECT_TRUE(watch({row(1, inf, nan), row(2, 1, 0)}).astray());
  EXPECT_TRUE(watch({with_restitution(row(1, 1, -inf), -1)}).astray());
  const auto first = watch({row(1, 1, 0), row(2, inf, inf), row(3, 1, nan)}).astray();
  ASSERT_TRUE(first);
  EXPECT_EQ(first->time, 2);
}

}  // namespace
}  // namespace noli
