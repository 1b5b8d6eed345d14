// SPDX-License-Identifier: Apache-2.0
//
// Defines the smallest scene with contact.
#pragma once

#include <nlohmann/json.hpp>

namespace noli::app_tests {

/// In the plane: a point falls onto a floor and bounces.
inline nlohmann::json bouncing_point() {
  return nlohmann::json::parse(R"({
      "noli_scene": 1, "title": "bouncing point", "dimension": 2, "duration": 1, "window": 0.0625,
      "gravity": [0, -9.81],
      "bodies": [
        {"name": "floor", "mesh": {"chain": {"points": [[-1, 0], [1, 0]], "segments": 1}},
         "material": {"edge_stiffness": 0, "mass_per_length": 1}, "pin": ["all"]},
        {"name": "ball", "mesh": {"points": {"at": [[0.1, 0.5]]}},
         "material": {"edge_stiffness": 0, "mass_per_vertex": 1}}],
      "contact": {"thickness": 0.1, "stiffness": 100, "most_layers": 400}})");
}

}  // namespace noli::app_tests
