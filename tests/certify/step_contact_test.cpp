// SPDX-License-Identifier: Apache-2.0
//
// Tests the layers that a repair chooses: by the gaps, so that nothing begins within one.
#include "certify/repair/step_contact.h"

#include <gtest/gtest.h>

#include <cmath>

#include "certify/repair/excluded_pairs.h"
#include "certify/repair/near_gaps.h"

namespace noli {
namespace {

using Vector = certificates::Vector<3>;

/// Two triangles one above the other, and a third far away.
Mesh three_triangles() {
  Mesh mesh;
  mesh.vertex_count = 9;
  mesh.faces = {{0, 1, 2}, {3, 4, 5}, {6, 7, 8}};
  return mesh;
}

std::vector<Position> at_gap(double gap) {
  return {{0, 0, 0},     {4, 0, 0},       {0, 4, 0},       {1, 1, gap},    {1.5, 1, gap},
          {1, 1.5, gap}, {100, 100, 100}, {104, 100, 100}, {100, 104, 100}};
}

std::vector<Vector> vectors(const std::vector<Position>& x) {
  std::vector<Vector> all;
  for (const Position& p : x) all.emplace_back(p[0], p[1], p[2]);
  return all;
}

TEST(NearGaps, AreThoseOfTheNearestPairWithinReach) {
  const Mesh mesh = three_triangles();
  const std::vector<Vector> x = vectors(at_gap(0.25));
  const std::vector<std::uint8_t> none(9, 0);
  const std::vector<double> reach(9, 1.0);
  const std::vector<certificates::PairKey> nothing;
  NearGaps<3> gaps(mesh, x, none, nullptr, nothing);
  const std::vector<double> found = gaps(x, reach);
  for (std::size_t v = 0; v < 6; ++v) EXPECT_DOUBLE_EQ(found[v], 0.25) << v;
  for (std::size_t v = 6; v < 9; ++v) EXPECT_EQ(found[v], 1) << v;
  const std::vector<double> short_reach(9, 0.125);
  EXPECT_EQ(gaps(x, short_reach), short_reach);
}

TEST(NearGaps, WhatNothingCanMoveOrIsExcludedDoesNotCount) {
  const Mesh mesh = three_triangles();
  const std::vector<Vector> x = vectors(at_gap(0.25));
  const std::vector<double> reach(9, 1.0);
  const std::vector<std::uint8_t> fixed = {1, 1, 1, 1, 1, 1, 0, 0, 0};
  const std::vector<certificates::PairKey> nothing;
  EXPECT_EQ((NearGaps<3>(mesh, x, fixed, nullptr, nothing)(x, reach)), reach);
  const Exclusions apart{{1, 1, 1, 2, 2, 2, 0, 0, 0}, {{1, 2}}};
  const std::vector<std::uint8_t> none(9, 0);
  EXPECT_EQ((NearGaps<3>(mesh, x, none, &apart, nothing)(x, reach)), reach);
  const Exclusions other{{1, 1, 1, 2, 2, 2, 0, 0, 0}, {{2, 2}}};
  EXPECT_NE((NearGaps<3>(mesh, x, none, &other, nothing)(x, reach)), reach);
  // --only-new: cells 0 and 1 intersect in the first frame, or 1 and 2 do.
  const auto of_baseline = [&](std::uint32_t a, std::uint32_t b) {
    const certificates::Features features(mesh, 3);
    const Baseline baseline(mesh, {{a, b}});
    return ExcludedPairs(features, baseline)([] { return false; });
  };
  const auto first = of_baseline(0, 1), second = of_baseline(1, 2);
  EXPECT_EQ((NearGaps<3>(mesh, x, none, nullptr, first)(x, reach)), reach);
  EXPECT_NE((NearGaps<3>(mesh, x, none, nullptr, second)(x, reach)), reach);
}

class StepContacts : public testing::Test {
 protected:
  StepContact contact(const StepContact::Wanted& wanted = {}) const { return {mesh, x, mass, fixed, &apart, wanted}; }
  integrator::ContactMaterial of(const integrator::ContactSettings& settings, VertexId a, VertexId b) const {
    return settings.materials[settings.material(std::array{a}, std::array{b})];
  }

  Mesh mesh = three_triangles();
  std::vector<Position> x = at_gap(0.25);
  std::vector<double> mass = std::vector<double>(9, 1.0);
  std::vector<std::uint8_t> fixed = std::vector<std::uint8_t>(9, 0);
  Exclusions apart;
};

TEST_F(StepContacts, BoundsAreQuartersOfTheLeastHeightOrWhatIsAimedAt) {
  const StepContact usual = contact();
  EXPECT_DOUBLE_EQ(usual.bounds()[3], 0.5 / std::sqrt(2) / 2 / 2);  // a quarter of 0.3536
  EXPECT_DOUBLE_EQ(usual.bounds()[0], 4 / std::sqrt(2) / 4);
  const StepContact aimed = contact({.thickness = 0.125});
  for (const double bound : aimed.bounds()) EXPECT_EQ(bound, 0.125);
  EXPECT_DOUBLE_EQ(contact({.thickness = 100}).bounds()[0], 4 / std::sqrt(2) / 2);
}

TEST_F(StepContacts, NothingBeginsWithinItsLayers) {
  std::vector<double> sizes = {1, 0.9, 0.1, 1e-3, 1e-6, 1e-6, 1e-9, 1e-12, 1e-15};
  const std::vector<double> speeds(9, 1.0);
  const StepContact chosen = contact();
  const auto settings = chosen.settings(sizes, speeds);
  for (VertexId a = 0; a < 9; ++a) {
    for (VertexId b = 0; b < 9; ++b) {
      const double thickness = of(settings.contact, a, b).thickness;
      EXPECT_LE(thickness, std::min(sizes[a], sizes[b])) << a << ' ' << b;
      EXPECT_GT(thickness, std::min(sizes[a], sizes[b]) / 8) << a << ' ' << b;
      EXPECT_EQ(thickness, of(settings.contact, b, a).thickness);
    }
  }
  EXPECT_EQ(settings.least_step, of(settings.contact, 8, 8).step);
}

TEST_F(StepContacts, GroupsThatMayMeetHaveNoLayers) {
  apart = {{1, 1, 1, 2, 2, 2, 0, 0, 0}, {{1, 2}}};
  const auto settings = contact().settings(std::vector<double>(9, 1.0), std::vector<double>(9, 1.0)).contact;
  const auto material = [&](VertexId a, VertexId b) { return settings.material(std::array{a}, std::array{b}); };
  EXPECT_EQ(material(0, 3), integrator::ContactSettings::excluded);
  EXPECT_EQ(material(3, 0), integrator::ContactSettings::excluded);
  EXPECT_NE(material(0, 1), integrator::ContactSettings::excluded);
  EXPECT_NE(material(0, 6), integrator::ContactSettings::excluded);
}

TEST(MassesBySize, AreRelativeToTheirMean) {
  const std::vector<double> mass = masses_by_size(three_triangles(), at_gap(1));
  EXPECT_NEAR(mass[0] / mass[3], 64, 1);  // 8 and 1/8 of an area
  EXPECT_EQ(mass[0], mass[6]);
  Mesh points;
  points.vertex_count = 2;
  points.points = {0, 1};
  EXPECT_EQ(masses_by_size(points, std::vector<Position>{{0, 0, 0}, {1, 0, 0}}), (std::vector<double>{1, 1}));
}

}  // namespace
}  // namespace noli
