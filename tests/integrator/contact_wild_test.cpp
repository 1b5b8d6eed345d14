// SPDX-License-Identifier: Apache-2.0
//
// Tests random small scenes with extreme parameters. A window may only touch because the steps of contact are too long,
// never because certificates missed a layer. At the ends of windows, the work of friction never rises above its least
// so far by more than a thousandth of the energy at time 0. (While one anchor served all layers of a pair, friction
// gave up to a tenth of that energy more than it had taken.)
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <span>

#include "contact_wild_run.h"
#include "contact_wild_scenes.h"
#include "contact_wild_seeds.h"

namespace noli::integrator {
namespace {

using test::Ending;
using test::Wild;

struct Tally {
  int scenes = 0, done = 0, limited = 0, touched = 0, calm = 0, calm_done = 0;
  int with_friction = 0;
  std::uint64_t windows = 0, impulses = 0;
  std::uint32_t deepest = 0;
};

template <int Dim>
Wild<Dim> wild_scene(std::uint64_t seed) {
  if constexpr (Dim == 3) {
    return test::wild_scene_3d(seed);
  } else {
    return test::wild_scene_2d(seed);
  }
}

/// The report of a run that needed too many layers is consistent.
template <int Dim>
void expect_sane(const ContactLimit& limit, const Model<double, Dim>& model, int windows) {
  for (std::size_t k = 0; k < limit.pair.size(); ++k) EXPECT_LT(limit.pair.vertices[k], model.x.size());
  EXPECT_GE(limit.time, windows * model.window_length);
  EXPECT_LE(limit.time, (windows + 1) * model.window_length);
}

/// A window that touches does not lack a layer: with more layers from the start, it touches too.
template <int Dim>
void expect_no_fault_of_certificates(Model<double, Dim> model, const Ending& ending) {
  model.contact->least_layers = 40;
  const Ending again = test::run_verified(model, test::wild_windows, test::wild_turns);
  EXPECT_TRUE(again.touched) << "certificates missed a layer";
  EXPECT_EQ(again.windows, ending.windows);
}

template <int Dim>
void try_scene(std::uint64_t seed, bool inclusion_exclusion, Tally& tally) {
  SCOPED_TRACE(testing::Message() << Dim << "D, seed " << seed);
  Wild<Dim> wild = wild_scene<Dim>(seed);
  wild.model.contact->most_layers = 10'000;  // ten times the default, as wild scenes reach deep layers
  wild.model.contact->inclusion_exclusion = inclusion_exclusion;
  const Ending ending = test::run_verified(wild.model, test::wild_windows, test::wild_turns);
  const bool done = !ending.stopped();
  ++tally.scenes;
  tally.done += done;
  tally.limited += ending.limit.has_value();
  tally.touched += ending.touched;
  tally.windows += static_cast<std::uint64_t>(ending.windows);
  tally.impulses += ending.impulses;
  tally.deepest = std::max(tally.deepest, ending.deepest);
  if (wild.c <= 0.1) {
    ++tally.calm;
    tally.calm_done += done;
  }
  EXPECT_GE(ending.impulses, 100U);
  EXPECT_FALSE(ending.long_winded);
  EXPECT_FALSE(ending.not_finite);
  EXPECT_LE(ending.friction_gave, 1e-3 * ending.energy);
  tally.with_friction += wild.model.contact->materials[0].friction > 0;
  if (ending.limit) expect_sane(*ending.limit, wild.model, ending.windows);
  if (ending.touched) expect_no_fault_of_certificates(wild.model, ending);
  if (!done) {
    std::printf("%dD seed %d, c %.3g: %s in window %d\n", Dim, static_cast<int>(seed), wild.c,
                ending.touched ? "touches" : "too many layers", ending.windows);
  }
}

template <int Dim>
void try_scenes(std::span<const std::uint16_t> seeds, bool inclusion_exclusion = false) {
  Tally tally;
  for (const std::uint16_t seed : seeds) try_scene<Dim>(seed, inclusion_exclusion, tally);
  std::printf(
      "%d scenes in %dD, %.0f windows settled exactly, %.0f impulses, layers to %u; %d to the end, %d out of layers, "
      "%d "
      "touched; of those with c <= 0.1, %d of %d to the end\n",
      tally.scenes, Dim, static_cast<double>(tally.windows), static_cast<double>(tally.impulses), tally.deepest,
      tally.done, tally.limited, tally.touched, tally.calm_done, tally.calm);
  EXPECT_EQ(tally.scenes, static_cast<int>(seeds.size()));
  EXPECT_GE(tally.calm_done * 100, tally.calm * 95);
  EXPECT_GT(tally.with_friction * 4, tally.scenes) << "half of all have friction";
  EXPECT_GT(tally.calm * 2, tally.scenes) << "most have c <= 0.1, as c is log-uniform from 0.01 to 0.5";
}

TEST(WildContact, NothingTouches) {
  try_scenes<3>(std::span(test::wild_seeds_3d).first(12));
  try_scenes<2>(std::span(test::wild_seeds_2d).first(12));
}
TEST(WildContact, NothingTouchesWithInclusionAndExclusion) {
  try_scenes<3>(std::span(test::wild_seeds_3d).first(12), true);
  try_scenes<2>(std::span(test::wild_seeds_2d).first(12), true);
}
TEST(WildContact, SlowNothingTouchesInTwoHundredScenesWithInclusionAndExclusion) {
  try_scenes<3>(test::wild_seeds_3d, true);
  try_scenes<2>(test::wild_seeds_2d, true);
}
TEST(WildContact, SlowNothingTouchesInTwoHundredScenesInSpace) { try_scenes<3>(test::wild_seeds_3d); }
TEST(WildContact, SlowNothingTouchesInTwoHundredScenesInThePlane) { try_scenes<2>(test::wild_seeds_2d); }

}  // namespace
}  // namespace noli::integrator
