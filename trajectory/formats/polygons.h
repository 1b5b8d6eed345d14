// SPDX-License-Identifier: Apache-2.0
//
// Faces with more than three corners: how they become triangles, and how far they are from flat.
//
// Notation
//   fan             the triangles (p0, p1, p2), (p0, p2, p3), ... of a polygon p0 p1 ... pn (trajectory/cells.h)
//   non-planarity   the largest distance of a corner from the plane of the fan's first triangle with a nonzero area; 0
//                   if no triangle has one. It is 0 exactly if all corners are in that plane. A different first corner
//                   gives different triangles, and may give a different distance
//
// Convexity is not checked: the fan of a flat polygon that is not convex folds over itself.
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

/// The rule for polygons, passed to a reader, and the fans that it made.
struct Polygons {
  PolygonRule rule = PolygonRule::fan;
  std::vector<Fan> fans = {};  ///< filled by the reader
};

/// The message for a polygon that a reader refuses.
std::string refused_polygon(std::size_t corners);

/// The largest non-planarity of these polygons, rounded up to double (infinity beyond its range), or `at_least` if that
/// is larger. It is 0 only if all polygons are exactly flat and at_least is 0.
double largest_non_planarity(const Mesh& mesh, std::span<const Fan> fans, std::span<const Position> positions,
                             double at_least = 0);

/// What is to be known of polygons that were cut: how many, and how far from flat they are in `where`, "all frames".
std::string polygons_note(std::size_t count, const std::string& where, double non_planarity);

/// Whether three points are on one line, exactly. Precondition: finite.
bool has_zero_area(const Position& a, const Position& b, const Position& c);

}  // namespace noli
