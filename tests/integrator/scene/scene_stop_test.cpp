// SPDX-License-Identifier: Apache-2.0
//
// Tests that every function that builds a model from a scene reacts to a stop.
#include <gtest/gtest.h>

#include <functional>

#include "certificates/hierarchy.h"
#include "integrator/scene/build_model.h"
#include "integrator/scene/explain.h"
#include "integrator/scene/shapes/connectivity.h"
#include "integrator/scene/shapes/generators.h"
#include "tests/integrator/scenes.h"
#include "trajectory/stop.h"

namespace noli::integrator {
namespace {

using testing::sheet;

TEST(SceneStop, IsHeardByGeneratorsAndModels) {
  const Scene scene = parse_scene(sheet().dump(), "s.json");
  const Shape grid = make_shape(Grid{});
  const std::vector<certificates::Vector<3>> centres(5, certificates::Vector<3>::Zero());
  const std::vector<std::function<void()>> work = {
      [] { make_shape(Grid{}); },
      [] { make_shape(Sphere{}); },
      [] { make_shape(Disc{}); },
      [&] { face_edges(grid.mesh); },
      [&] { build_model<3>(scene); },
      [&] { explain(scene); },
      [] { parse_scene(sheet().dump(), "s.json"); },
      [&] { certificates::Hierarchy<3>(centres, std::vector<bool>(5, false)); },
  };
  for (std::size_t i = 0; i < work.size(); ++i) {
    EXPECT_NO_THROW(work[i]()) << i;
    ask_to_stop(StopReason::out_of_time);
    EXPECT_THROW(work[i](), Stopped) << i;
    forget_stops();
  }
}

}  // namespace
}  // namespace noli::integrator
