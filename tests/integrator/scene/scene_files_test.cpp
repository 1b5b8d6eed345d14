// SPDX-License-Identifier: Apache-2.0
//
// Tests the shipped scenes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

#include "integrator/scene/explain.h"
#include "integrator/scene/read_scene.h"
#include "integrator/simulation.h"
#include "tests/support/temporary_folder.h"

namespace noli::integrator {
namespace {

const std::filesystem::path folder = std::filesystem::path(NOLI_SOURCE_DIR) / "scenes";

std::vector<std::filesystem::path> shipped() {
  std::vector<std::filesystem::path> paths;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() == ".json") paths.push_back(entry.path());
  }
  std::sort(paths.begin(), paths.end());
  return paths;
}

TEST(ShippedScenes, AreThoseOfTheList) {
  std::set<std::string> names;
  for (const auto& path : shipped()) names.insert(path.stem().string());
  const std::set<std::string> expected{"billiard",
                                       "bounce",
                                       "bowline",
                                       "cantilever",
                                       "compactor",
                                       "curtains",
                                       "drape_mesh",
                                       "drape_sphere",
                                       "hanging_chain",
                                       "incline",
                                       "nails",
                                       "plane_compactor",
                                       "plane_compactor_elastic",
                                       "plane_curtain",
                                       "plane_nails",
                                       "reef_knot",
                                       "resonance",
                                       "restitution",
                                       "ring_in_box",
                                       "ring_in_flight",
                                       "sheet_through_sheet",
                                       "sphere_plate",
                                       "stack",
                                       "stiff_inset",
                                       "stretched_sheet",
                                       "swinging_cloth",
                                       "through_ring",
                                       "trefoil",
                                       "twisted_rod"};
  EXPECT_TRUE(std::includes(names.begin(), names.end(), expected.begin(), expected.end()));
}

TEST(ShippedScenes, BuildInBothFormsAndSayWhatTheyShow) {
  const std::string readme = test::read_text(folder / "README.md");
  for (const auto& path : shipped()) {
    for (const Form form : {Form::full, Form::brief}) {
      const Scene scene = read_scene(path, form);
      EXPECT_FALSE(scene.title.empty()) << path;
      EXPECT_FALSE(scene.about.empty()) << path;
      const Explanation e = explain(scene);
      EXPECT_GT(e.events, 0) << path;
      EXPECT_LT(e.breakpoints_a_window, 2e6) << path;
      EXPECT_EQ(e.resonances.empty(), path.stem() != "resonance") << path << "\n" << to_text(e);
      if (form == Form::brief) {
        EXPECT_LT(e.events * scene.duration, 1e8) << path << ": more than 20 s";
      }
    }
    EXPECT_NE(readme.find("## " + path.stem().string() + "\n"), std::string::npos) << path;
  }
}

TEST(ShippedScenes, TheSchemaInTheProgramIsTheFile) {
  EXPECT_EQ(scene_schema_text(), test::read_text(folder / "../schemas/scene.json"));
}

TEST(ShippedScenes, TheInsetIsSmallAndItsStepsAreAHundredTimesShorter) {
  const Scene scene = read_scene(folder / "stiff_inset.json");
  const auto built = build_model<3>(scene);
  const auto& membranes = built.model.forces.membranes;
  const auto [shortest, longest] = std::minmax_element(membranes.steps.begin(), membranes.steps.end());
  EXPECT_GE(*longest / *shortest, 100);
  double softest = membranes.forces[0].shear, stiff = 0;
  for (const auto& membrane : membranes.forces) softest = std::min(softest, membrane.shear);
  for (const auto& membrane : membranes.forces) stiff += membrane.shear > 2 * softest;
  EXPECT_GT(stiff, 0);
  EXPECT_LE(stiff / static_cast<double>(membranes.forces.size()), 0.05);
}

}  // namespace
}  // namespace noli::integrator
