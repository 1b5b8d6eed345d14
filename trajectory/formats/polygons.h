// SPDX-License-Identifier: Apache-2.0
//
// Faces of more than three corners: how they become triangles, and how far they are from being flat.
//
// Notation
//   fan             the triangles (p0, p1, p2), (p0, p2, p3), ... of a polygon p0 p1 ... pn (cells.h)
//   non-planarity   the largest distance of a corner from the plane of the fan's first triangle that has an area; 0
//                   where no triangle has one. It is 0 exactly where all corners are in that plane. Another first
//                   corner gives other triangles, and may give another distance
//
// What this does not do: it does not look whether a polygon is convex. A flat one that is not folds over itself.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include <noli/frames.h>
#include <noli/mesh.h>

namespace noli {

/// The triangles of a polygon of more than three corners: faces [first, first + count) of its mesh.
struct Fan {
  std::size_t first = 0, count = 0;
};

/// What a reader is told about polygons, and what it tells.
struct Polygons {
  PolygonRule rule = PolygonRule::fan;
  std::vector<Fan> fans = {};  ///< filled by the reader
};

/// What a reader says of a polygon that it refuses.
std::string refused_polygon(std::size_t corners);

/// The largest non-planarity of these polygons, rounded up to double (infinity where it is no double), or
/// `at_least` where that is larger. Exact: it is 0 only if all are flat, and at_least is.
double largest_non_planarity(const Mesh& mesh, std::span<const Fan> fans, std::span<const Position> positions,
                             double at_least = 0);

/// Whether three points are on one line, exactly. Precondition: finite.
bool has_zero_area(const Position& a, const Position& b, const Position& c);

}  // namespace noli
