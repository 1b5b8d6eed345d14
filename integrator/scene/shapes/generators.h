// SPDX-License-Identifier: Apache-2.0
//
// Generates the meshes of schemas/scene.json, with the sets of vertices that it names. Positions use only + - * / sqrt
// (circles: turn.h), so their bits are the same on every machine. Shapes that are symmetric about an axis or a diagonal
// are so bit for bit, unless stated otherwise.
//
//   points   as given
//   chain    n + 1 vertices at equal parts of the curve's length. Smooth: uniform Catmull-Rom splines (Catmull, Rom
//            1974) through the points, whose ends are mirrored; lengths are those of 32 chords a span. Closed: n
//            vertices, as many as edges
//   ring     n vertices, the first on the x axis, counterclockwise
//   grid     rows from bottom to top. Each cell has the diagonal from bottom left to top right; if alternating, every
//            second cell has the other one. Finer in one place by halving (generators_sheet.cpp). Faces look to +z
//   ribbon   rows across the band, from first to last; a row's direction is that of the previous one, made
//            perpendicular to the curve. Faces as in a grid with the curve as its x
//   disc     the centre, then rings of 6, 12, 18, ... vertices. Faces look to +z
//   rod      segments + 1 rings of vertices from -length/2 to length/2, then the middles of the caps. Faces look
//            outward
//   sphere   the icosahedron's 12 vertices, then the middles of edges, level by level. Faces look outward
//   box      faces look outward
//   torus    rings of vertices about the tube, the first on the x axis. Faces look outward
//   pyramid  the base's corners, the first on the x axis, then the tip. Faces look outward
#pragma once

#include "integrator/scene/scene.h"
#include "integrator/scene/shapes/shape.h"

namespace noli::integrator {

Shape make_shape(const LoosePoints& points);
Shape make_shape(const Chain& chain);
Shape make_shape(const Ring& ring);
Shape make_shape(const Grid& grid);
Shape make_shape(const Ribbon& ribbon);
Shape make_shape(const Disc& disc);
Shape make_shape(const Rod& rod);
Shape make_shape(const Sphere& sphere);
Shape make_shape(const SurfaceOfBox& box);
Shape make_shape(const Torus& torus);
Shape make_shape(const Pyramid& pyramid);

/// Two triangles for a cell with the corners a b c d, counterclockwise: cut from a to c, or from b to d.
inline void add_cell(Mesh& mesh, const std::array<VertexId, 4>& corners, bool other_diagonal) {
  const auto [a, b, c, d] = corners;
  mesh.faces.push_back(other_diagonal ? std::array{a, b, d} : std::array{a, b, c});
  mesh.faces.push_back(other_diagonal ? std::array{b, c, d} : std::array{a, c, d});
}

/// Coordinate i of n + 1 equally spaced ones from -size/2 to size/2: symmetric bit for bit.
inline double centred(std::uint32_t i, std::uint32_t n, double size) {
  return (static_cast<double>(2 * std::int64_t{i} - n) / n) * (size / 2);
}

}  // namespace noli::integrator
