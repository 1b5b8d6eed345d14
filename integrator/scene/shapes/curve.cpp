// SPDX-License-Identifier: Apache-2.0
#include "integrator/scene/shapes/curve.h"
#include "integrator/scene/shapes/generators.h"
#include "integrator/scene/shapes/turn.h"

#include <cmath>
#include <stdexcept>

namespace noli::integrator {
namespace {

/// A uniform Catmull-Rom spline from b to c; t in [0, 1].
Vec3 catmull_rom(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, double t) {
  const Vec3 linear = c - a, quadratic = 2 * a - 5 * b + 4 * c - d, cubic = 3 * (b - c) + d - a;
  return b + (0.5 * t) * (linear + t * (quadratic + t * cubic));
}

/// The smooth curve as a polyline. A closed one has its first point also at its end.
std::vector<Vec3> smoothed(const std::vector<Vec3>& points, bool closed) {
  constexpr int chords = 32;
  const std::size_t n = points.size();
  // The ends of an open curve are mirrored: it leaves straight towards the second point.
  std::vector<Vec3> padded{closed ? points[n - 2] : Vec3(2 * points[0] - points[1])};
  padded.insert(padded.end(), points.begin(), points.end());
  padded.emplace_back(closed ? points[1] : Vec3(2 * points[n - 1] - points[n - 2]));
  std::vector<Vec3> fine{points[0]};
  for (std::size_t span = 0; span + 1 < points.size(); ++span) {
    for (int k = 1; k <= chords; ++k) {
      const double t = static_cast<double>(k) / chords;
      fine.push_back(k == chords ? points[span + 1]
                                 : catmull_rom(padded[span], padded[span + 1], padded[span + 2], padded[span + 3], t));
    }
  }
  return fine;
}

}  // namespace

std::vector<Vec3> along_curve(const std::vector<Position>& points, std::uint32_t n, CurveKind kind) {
  std::vector<Vec3> line;
  line.reserve(points.size());
  for (const Position& p : points) line.push_back(to_vec(p));
  if (kind.closed) line.push_back(line.front());
  if (kind.smooth) line = smoothed(line, kind.closed);
  std::vector<double> reached{0};  // length up to each point
  for (std::size_t i = 1; i < line.size(); ++i) reached.push_back(reached.back() + length(line[i] - line[i - 1]));
  if (!(reached.back() > 0) || !std::isfinite(reached.back()))
    throw std::invalid_argument("expected a curve with a positive, finite length");
  std::vector<Vec3> result{line.front()};
  std::size_t piece = 1;
  for (std::uint32_t k = 1; k < n; ++k) {
    const double goal = reached.back() * k / n;
    while (reached[piece] < goal) ++piece;
    const double part = (goal - reached[piece - 1]) / (reached[piece] - reached[piece - 1]);
    result.emplace_back(line[piece - 1] + part * (line[piece] - line[piece - 1]));
  }
  if (!kind.closed) result.push_back(line.back());
  return result;
}

Shape make_shape(const LoosePoints& points) {
  Shape shape;
  for (const Position& x : points.at) shape.mesh.points.push_back(shape.add(x));
  return shape;
}

Shape make_shape(const Chain& chain) {
  Shape shape;
  const CurveKind kind{chain.smooth, chain.closed};
  for (const Vec3& x : along_curve(chain.points, chain.segments, kind)) shape.add(to_position(x));
  const auto n = static_cast<VertexId>(shape.mesh.vertex_count);
  for (VertexId i = 0; i < chain.segments; ++i) shape.mesh.edges.push_back({i, (i + 1) % n});
  if (!chain.closed) shape.sets = {{"first", {0}}, {"last", {chain.segments}}};
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
