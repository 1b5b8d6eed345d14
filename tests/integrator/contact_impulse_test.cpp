// SPDX-License-Identifier: Apache-2.0
//
// Tests the effect of single layer kicks on energy and momenta (docs/contact.md, 4 and 5).
#include "integrator/contact_impulse.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "contact_stencils.h"

namespace noli::integrator {
namespace {

using test::near_features;
using test::NearFeatures;

constexpr std::uint64_t draws = 4000;  ///< per kind
constexpr double rounding = 1e-13;

/// Calls each(features, closest points, distance) for pairs of all kinds, in the plane and in space.
template <int Dim, class Each>
void for_pairs_of(std::initializer_list<FeaturePair> kinds, const Each& each) {
  for (const FeaturePair kind : kinds) {
    for (std::uint64_t seed = 0; seed < draws; ++seed) {
      SCOPED_TRACE(testing::Message() << Dim << "D " << name(kind) << " seed " << seed);
      const NearFeatures<Dim> f = near_features<Dim>(kind, seed);
      const auto c = f.closest();
      if (c.distance() > 0) each(f, c, c.distance());
      if (testing::Test::HasFailure()) return;
    }
  }
}

template <class Each>
void for_all_pairs(const Each& each) {
  for_pairs_of<2>({FeaturePair::vertex_edge, FeaturePair::vertex_vertex}, each);
  for_pairs_of<3>(
      {FeaturePair::vertex_face, FeaturePair::edge_edge, FeaturePair::vertex_edge, FeaturePair::vertex_vertex}, each);
}

/// How often each case of a test occurred.
using Tally = std::array<int, 3>;

template <int Dim>
Impulses<Dim> scaled(Impulses<Dim> impulses, double factor) {
  for (auto& impulse : impulses) impulse *= factor;
  return impulses;
}

template <int Dim>
double opening_of(const certificates::Closest<Dim>& c, const NearFeatures<Dim>& f) {
  return opening<Dim, double>(c, f.size(), [&f](std::size_t i) { return f.v[i]; });
}

/// Friction as in integrator/contact.h. `most`: mu J_n.
template <int Dim>
Impulses<Dim> slip_rate_friction(const NearFeatures<Dim>& f, const certificates::Closest<Dim>& c, double most) {
  const Slip<Dim> s = slip<Dim>(Sliding<Dim, double>(c, f.xs()), f.vs());
  const double yield = yielding<Dim>(s, f.inverse_masses());
  if (!(s.speed > 0) || !(yield > 0)) return scaled<Dim>(s.against, 0);
  return scaled<Dim>(s.against, std::min(most, s.speed / yield));
}

/// Friction by the closed form of docs/contact.md, 5, between points at distance d.
template <int Dim>
Impulses<Dim> plain_friction(const NearFeatures<Dim>& f, const certificates::Closest<Dim>& c, double most) {
  const Vec<double, Dim> n = c.r / c.distance();
  Vec<double, Dim> u = Vec<double, Dim>::Zero();
  double inverse_mass = 0;
  for (std::size_t i = 0; i < f.size(); ++i) {
    u += c.weights[i] * f.v[i];
    inverse_mass += c.weights[i] * c.weights[i] * f.inverse_mass[i];
  }
  const Vec<double, Dim> slip = u - u.dot(n) * n;
  Impulses<Dim> impulses;
  const double speed = slip.norm(), j = inverse_mass > 0 ? std::min(most, speed / inverse_mass) : 0;
  for (std::size_t i = 0; i < 4; ++i) impulses[i] = (-j * c.weights[i] / speed) * slip;
  return impulses;
}

/// A value of h r(l) |g|, from gentle to far more than is needed to stop everything.
double some_push(std::uint64_t seed) { return test::Stream(seed + 77).decades(1e-8, 1e4); }

TEST(ContactImpulse, AnOpeningKickReturnsNoMoreWithRestitutionThanWithout) {
  Tally tally{};
  for_all_pairs([&](const auto& f, const auto& c, double d) {
    constexpr int Dim = std::remove_cvref_t<decltype(f.x[0])>::RowsAtCompileTime;
    const double push = some_push(static_cast<std::uint64_t>(tally[0]));
    const Impulses<Dim> whole = normal_impulses(c, d, push);
    const bool parts = opening_of<Dim>(c, f) > 0;
    ++tally[parts ? 0 : 1];
    for (const double e : {0.0, 0.01, 0.5, 0.99}) {
      const Impulses<Dim> part = normal_impulses(c, d, e * push);
      if (!parts) continue;
      EXPECT_LE(f.work(part), f.work(whole) + rounding * f.work_scale(whole));
      EXPECT_GE(f.work(part), -rounding * f.work_scale(part)) << "what parts is not held back";
    }
  });
  EXPECT_GT(tally[0], 5000);
  EXPECT_GT(tally[1], 5000);
}

/// The impulse between the features has the size `push` and acts along the line between the points.
TEST(ContactImpulse, ANormalKickPushesApart) {
  for_all_pairs([&](const auto& f, const auto& c, double d) {
    constexpr int Dim = std::remove_cvref_t<decltype(f.x[0])>::RowsAtCompileTime;
    auto after = f;
    after.give(normal_impulses(c, d, 3.0));
    double yield = 0;
    for (std::size_t i = 0; i < f.size(); ++i) yield += f.inverse_mass[i] * c.weights[i] * c.weights[i];
    const double before = opening_of<Dim>(c, f), now = opening_of<Dim>(c, after);
    double scale = std::abs(3 * yield);
    for (const auto& v : after.vs()) scale += v.norm();
    EXPECT_NEAR((now - before) / d, 3 * yield, 1e-11 * scale);
  });
}

TEST(ContactImpulse, FrictionLowersTheKineticEnergy) {
  Tally tally{};
  for_all_pairs([&](const auto& f, const auto& c, double d) {
    constexpr int Dim = std::remove_cvref_t<decltype(f.x[0])>::RowsAtCompileTime;
    const double push = some_push(static_cast<std::uint64_t>(tally[0]) + static_cast<std::uint64_t>(tally[1]));
    auto pushed = f;
    pushed.give(normal_impulses(c, d, push));
    const Slip<Dim> s = slip<Dim>(Sliding<Dim, double>(c, pushed.xs()), pushed.vs());
    if (c.slide_count == 0) {
      EXPECT_EQ(s.speed, 0);
      ++tally[2];
      return;
    }
    for (const double mu : {0.1, 1.0}) {
      const Impulses<Dim> friction = slip_rate_friction<Dim>(pushed, c, mu * push);
      EXPECT_LE(pushed.work(friction), rounding * pushed.work_scale(friction));
      if (pushed.impulse_scale(friction) > 0) ++tally[pushed.work(friction) < 0 ? 0 : 1];
    }
  });
  EXPECT_GT(tally[0], 20000);
  EXPECT_LT(tally[1], tally[0] / 100) << "of these, rounding is all there is";
  EXPECT_GT(tally[2], 5000) << "corners do not slip";
}

/// Tests Coulomb's law, and that sticking stops the slip.
TEST(ContactImpulse, FrictionIsAtMostItsCoefficientTimesTheNormalImpulseAndAtMostStopsTheSlip) {
  Tally tally{};
  for_all_pairs([&](const auto& f, const auto& c, double) {
    constexpr int Dim = std::remove_cvref_t<decltype(f.x[0])>::RowsAtCompileTime;
    if (c.slide_count == 0) return;
    const double push = some_push(static_cast<std::uint64_t>(tally[0]) + static_cast<std::uint64_t>(tally[1]));
    const Impulses<Dim> friction = slip_rate_friction<Dim>(f, c, 0.5 * push);
    Vec<double, Dim> on_a = Vec<double, Dim>::Zero();
    for (std::size_t i = 0; i < first_size(f.kind); ++i) on_a += friction[i];
    EXPECT_LE(on_a.norm(), 0.5 * push * (1 + 1e-6));
    const Slip<Dim> s = slip<Dim>(Sliding<Dim, double>(c, f.xs()), f.vs());
    double scale = 0;
    for (const auto& v : f.vs()) scale = std::max(scale, v.norm());
    if (s.speed < 1e-6 * scale || !(yielding<Dim>(s, f.inverse_masses()) > 0)) return;
    const bool sticks = s.speed / yielding<Dim>(s, f.inverse_masses()) < 0.5 * push;
    ++tally[sticks ? 1 : 0];
    if (!sticks) {
      EXPECT_NEAR(on_a.norm(), 0.5 * push, 1e-6 * push);
      return;
    }
    auto after = f;
    after.give(friction);
    double rest = 0;
    for (std::size_t i = 0; i < f.size(); ++i) rest += s.against[i].dot(after.v[i]);
    EXPECT_LE(std::abs(rest), 1e-9 * after.work_scale(s.against)) << "nothing slips that way any more";
  });
  EXPECT_GT(tally[0], 3000);
  EXPECT_GT(tally[1], 3000);
}

TEST(ContactImpulse, KeepsMomentumAndAngularMomentum) {
  int slipped = 0;
  for_all_pairs([&](const auto& f, const auto& c, double d) {
    constexpr int Dim = std::remove_cvref_t<decltype(f.x[0])>::RowsAtCompileTime;
    for (const Impulses<Dim>& impulses : {normal_impulses(c, d, 1.0), slip_rate_friction<Dim>(f, c, 1.0)}) {
      EXPECT_LE(f.momentum_of(impulses).norm(), rounding * f.impulse_scale(impulses));
      EXPECT_LE(f.angular_momentum_of(impulses).norm(), rounding * f.moment_scale(impulses));
    }
    if (f.impulse_scale(slip_rate_friction<Dim>(f, c, 1.0)) > 0) ++slipped;
  });
  EXPECT_GT(slipped, 10000);
}

/// The plain form does not conserve angular momentum: it changes it by d n x J_t, which shows when moments of impulses
/// are added up, as in the energy accounts.
TEST(ContactImpulse, PlainFrictionTurnsWhatItActsOn) {
  int turned = 0;
  for_all_pairs([&](const auto& f, const auto& c, double) {
    constexpr int Dim = std::remove_cvref_t<decltype(f.x[0])>::RowsAtCompileTime;
    const Impulses<Dim> friction = plain_friction<Dim>(f, c, 1.0);
    if (!(f.impulse_scale(friction) > 0)) return;
    Vec<double, Dim> on_a = Vec<double, Dim>::Zero();
    for (std::size_t i = 0; i < first_size(f.kind); ++i) on_a += friction[i];
    EXPECT_LE(f.work(friction), rounding * f.work_scale(friction)) << "energy does not tell";
    EXPECT_LE(f.momentum_of(friction).norm(), rounding * f.impulse_scale(friction)) << "nor does momentum";
    const Moment<double, Dim> torque = moment<double, Dim>(c.r, on_a);
    EXPECT_LE((f.angular_momentum_of(friction) - torque).norm(), rounding * f.moment_scale(friction));
    if (torque.norm() > 1e6 * rounding * f.moment_scale(friction)) ++turned;
  });
  EXPECT_GT(turned, 15000);
}

/// A pair that rotates rigidly does not slip, but the plain form treats it as slipping.
TEST(ContactImpulse, WhatTurnsAsOneDoesNotSlip) {
  int mistaken = 0;
  for_pairs_of<3>({FeaturePair::vertex_face, FeaturePair::edge_edge}, [&](auto f, const auto& c, double d) {
    const Vec<double, 3> spin(0.3, -0.8, 0.5);
    for (std::size_t i = 0; i < f.size(); ++i) f.v[i] = spin.cross(f.x[i]);
    EXPECT_LE(slip<3>(Sliding<3, double>(c, f.xs()), f.vs()).speed, 1e-7 * (1 + d));
    Vec<double, 3> u = Vec<double, 3>::Zero();
    for (std::size_t i = 0; i < f.size(); ++i) u += c.weights[i] * f.v[i];
    if ((u - u.dot(c.r) / (d * d) * c.r).norm() > 0.1 * d) ++mistaken;
  });
  EXPECT_GT(mistaken, 5000);
}

}  // namespace
}  // namespace noli::integrator
