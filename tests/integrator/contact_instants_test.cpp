// SPDX-License-Identifier: Apache-2.0
//
// Tests at a thousand instants of each scene's short form that no pair of features is nearer than its next layer. The
// instants are ends of windows slightly shorter than a thousandth of the duration, so that they do not match any step.
#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <set>
#include <string>

#include "contact_instants.h"
#include "integrator/engine.h"
#include "integrator/scene/build_model.h"
#include "integrator/scene/read_scene.h"

namespace noli::integrator {
namespace {

using test::InstantCounts;
using test::Instants;

const std::filesystem::path folder = std::filesystem::path(NOLI_SOURCE_DIR) / "scenes";

const std::vector<std::string> scenes_with_contact = {
    "billiard",      "bounce",       "bowline",   "compactor",   "curtains",        "drape_mesh",
    "drape_sphere",  "graded_sheet", "incline",   "nails",       "plane_compactor", "plane_compactor_elastic",
    "plane_curtain", "plane_nails",  "reef_knot", "restitution", "ring_in_box",     "sphere_plate",
    "stack",         "through_ring", "trefoil"};

TEST(Instants, AreLookedAtOfEachSceneWithContact) {
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() != ".json") continue;
    if (read_scene(entry.path(), Form::brief).contact) names.insert(entry.path().stem().string());
  }
  EXPECT_EQ(names, std::set<std::string>(scenes_with_contact.begin(), scenes_with_contact.end()));
}

/// Examines the first `most` instants; `blind`: ignores which layers are active.
template <int Dim>
InstantCounts look(Scene scene, int most, bool blind) {
  constexpr int instants = 1000;
  scene.window = scene.duration / instants * 0.9271;
  const auto built = build_model<Dim>(scene);
  Instants<Dim> eye(built.model);
  Engine<double, Dim> engine(built.model);
  NoRecording nothing;
  for (int k = 0; k < most && engine.time() < scene.duration; ++k) {
    Books<double, Dim> books;
    engine.run_window(nothing, books, never_stop);
    typename Instants<Dim>::Layers layers;
    const auto add = [&](std::span<const certificates::Stencil> pairs, std::uint16_t, std::uint32_t) {
      for (const certificates::Stencil& pair : pairs) ++layers[pair.key];
    };
    if (!blind && engine.contact() != nullptr) engine.contact()->for_each_active(add);
    eye.look(engine.snapshot().x, layers);
  }
  return eye.counts();
}

InstantCounts look(const std::string& name, int most = 1'000'000, bool blind = false) {
  const Scene scene = read_scene(folder / (name + ".json"), Form::brief);
  return scene.dimension == 3 ? look<3>(scene, most, blind) : look<2>(scene, most, blind);
}

void report(const std::string& name, const InstantCounts& c) {
  std::printf(
      "%s: %.0f instants, %.0f pairs in near boxes, %.0f of them with a layer, %.0f decided by the kernel; nearest "
      "%.4f of the next layer\n",
      name.c_str(), static_cast<double>(c.instants), static_cast<double>(c.pairs), static_cast<double>(c.active),
      static_cast<double>(c.exact), c.least);
}

class InstantsOf : public testing::TestWithParam<std::string> {};

INSTANTIATE_TEST_SUITE_P(Scenes, InstantsOf, testing::ValuesIn(scenes_with_contact),
                         [](const auto& scene) { return scene.param; });

TEST_P(InstantsOf, SlowNoPairIsNearerThanItsNextLayer) {
  const InstantCounts c = look(GetParam());
  report(GetParam(), c);
  EXPECT_GE(c.instants, 1000U);
  EXPECT_EQ(c.nearer, 0U);
  EXPECT_GT(c.active, 0U) << "nothing came near";
}

TEST(Instants, NoPairIsNearerThanItsNextLayer) {
  const InstantCounts c = look("plane_nails", 300);
  report("plane_nails", c);
  EXPECT_EQ(c.nearer, 0U);
  EXPECT_GT(c.active, 0U);
}

/// If active layers are ignored, some pairs are too near, which the test must find.
TEST(Instants, PairsThatNeededALayerAreFound) {
  const InstantCounts with = look("plane_nails", 300), without = look("plane_nails", 300, true);
  EXPECT_EQ(with.pairs, without.pairs);
  EXPECT_GT(without.nearer, 0U);
  EXPECT_GT(without.exact, 0U);
  EXPECT_LE(without.nearer, with.active);
}

}  // namespace
}  // namespace noli::integrator
