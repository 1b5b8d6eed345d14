// SPDX-License-Identifier: Apache-2.0
#include "integrator/scene/shapes/select.h"

#include <fmt/format.h>

#include <algorithm>

#include "integrator/scene/shapes/nearest.h"

namespace noli::integrator {
namespace {

/// Vertices of one part of a selection.
struct Part {
  const Shape& shape;
  const std::vector<Position>& start;
  const Field& at;

  std::vector<VertexId> operator()(VertexId vertex) const {
    if (vertex >= shape.mesh.vertex_count) {
      at.fail(fmt::format("the body has no vertex {}; expected a number below {}", vertex, shape.mesh.vertex_count));
    }
    return {vertex};
  }

  std::vector<VertexId> operator()(const std::string& name) const {
    if (name == "all") return all();
    if (const auto set = shape.sets.find(name); set != shape.sets.end()) return set->second;
    std::vector<std::string> names{"all"};
    for (const auto& set : shape.sets) names.push_back(set.first);
    at.fail(fmt::format("the body has no set of vertices {}; the nearest is {}", Json(name).dump(),
                        Json(nearest(name, names)).dump()));
  }

  std::vector<VertexId> operator()(const Box& box) const {
    std::vector<VertexId> inside = all();
    std::erase_if(inside, [&](VertexId i) { return !contains(box, start[i]); });
    if (inside.empty()) at["box"].fail("expected at least one vertex of the body in this box at the start, found none");
    return inside;
  }

  std::vector<VertexId> all() const {
    std::vector<VertexId> ids(shape.mesh.vertex_count);
    for (VertexId i = 0; i < ids.size(); ++i) ids[i] = i;
    return ids;
  }
};

}  // namespace

bool contains(const Box& box, const Position& x) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!(box.low[axis] <= x[axis] && x[axis] <= box.high[axis])) return false;
  }
  return true;
}

std::vector<VertexId> select(const Selection& selection, const Shape& shape, const std::vector<Position>& start,
                             const Field& at) {
  std::vector<VertexId> ids;
  for (std::size_t i = 0; i < selection.size(); ++i) {
    const std::vector<VertexId> more = std::visit(Part{shape, start, at[i]}, selection[i]);
    ids.insert(ids.end(), more.begin(), more.end());
  }
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  return ids;
}

}  // namespace noli::integrator
