// SPDX-License-Identifier: Apache-2.0
#include "integrator/scene/shapes/curve.h"
#include "integrator/scene/shapes/generators.h"
#include "integrator/scene/shapes/turn.h"

namespace noli::integrator {

Shape make_shape(const LoosePoints& points) {
  Shape shape;
  for (const Position& x : points.at) shape.mesh.points.push_back(shape.add(x));
  return shape;
}

Shape make_shape(const Chain& chain) {
  Shape shape;
  const CurveKind kind{chain.smooth, chain.closed};
  for (const Vec3& x : along_curve(chain.points, chain.segments, kind)) shape.add(to_position(x));
  if (chain.closed) {
    for (VertexId i = 0; i < chain.segments; ++i) shape.mesh.edges.push_back({i, (i + 1) % chain.segments});
    return shape;
  }
  for (VertexId i = 0; i < chain.segments; ++i) shape.mesh.edges.push_back({i, i + 1});
  shape.sets = {{"first", {0}}, {"last", {chain.segments}}};
  return shape;
}

Shape make_shape(const Ring& ring) {
  Shape shape;
  for (VertexId i = 0; i < ring.segments; ++i) {
    const CosSin at = part_of_turn(i, ring.segments);
    shape.add({ring.radius * at.cos, ring.radius * at.sin, 0});
    shape.mesh.edges.push_back({i, (i + 1) % ring.segments});
  }
  return shape;
}

}  // namespace noli::integrator
