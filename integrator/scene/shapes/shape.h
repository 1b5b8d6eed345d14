// SPDX-License-Identifier: Apache-2.0
//
// A mesh before it is placed in a scene.
#pragma once

#include <map>
#include <string>
#include <vector>

#include <noli/mesh.h>
#include "trajectory/stop.h"

namespace noli::integrator {

struct Shape {
  Mesh mesh;
  std::vector<Position> positions;
  std::map<std::string, std::vector<VertexId>> sets;  ///< the vertices of each named set, ascending

  /// Throws Stopped, as generators add many vertices.
  VertexId add(const Position& x) {
    end_if_stopped();
    positions.push_back(x);
    return static_cast<VertexId>(mesh.vertex_count++);
  }
};

}  // namespace noli::integrator
