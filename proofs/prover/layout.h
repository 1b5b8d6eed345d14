// SPDX-License-Identifier: Apache-2.0
//
// Sheets: connected parts of a mesh that can be laid out flat, so that a few inequalities a face show that a whole part
// does not touch itself (proofs/prover/monotone.h).
//
// Notation
//   part     faces joined by vertices; K is its surface as the mesh has it, two points being the same only where they are
//            the same point of the same face, edge or vertex (by ids)
//   layout   a place r(v) in the plane for each vertex of a part, extended linearly over its faces: a map r from K
//   sheet    a part whose layout is injective and covers a convex polygon
//
// Claim: r is injective and r(K) is a convex polygon D if (1) every face, in one of its two orientations, is laid out
// strictly counterclockwise; (2) of each edge, so oriented, K has at most one copy in each direction; (3) the edges
// without an opposite form one cycle through different vertices; (4) in the layout it turns left or goes straight on
// everywhere and around once. Proof. The faces are a chain whose boundary is the cycle (3), so a point of the plane off
// all edges is covered as often, counted with the orientation, which is positive everywhere, as the cycle winds around
// it: by (4) once inside the convex polygon D, never outside. So the insides of the faces do not overlap, and they fill D.
// Around a point of K off the cycle the faces fill a whole disc, so no other point of K is laid out there; and the cycle
// does not meet itself. All four are decided exactly, on the doubles r(v).
//
// Where the layout comes from does not matter. Here: two coordinates of the positions that are given, scaled to the
// square [-1, 1]; what is on the border is moved to the convex hull, and everything a little outwards the more the nearer
// it is to the middle of a side, so that straight borders become convex in spite of rounding.
//
// What this does not do: closed surfaces, sheets with holes and parts that lie in several layers above the plane have no
// layout here; for them nothing is gained and nothing lost.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "noli/kernel/query.h"
#include "noli/trajectory/mesh.h"

namespace noli {

struct Sheets {
  std::vector<std::vector<std::uint32_t>> faces;   ///< of each sheet, ascending
  std::vector<std::vector<std::uint32_t>> others;  ///< of each other part with so many faces
  std::vector<Point2> layout;                      ///< by vertex; of a vertex that is in no sheet meaningless
};

/// Finds the sheets and other parts with at least `least_faces` faces, ordered by their first face. `x`: a position for each vertex, of
/// which the third coordinate is not looked at in two dimensions. Linear in the mesh, but for sorting what is on the
/// border.
Sheets find_sheets(const Mesh& mesh, std::span<const Position> x, int dimension, std::size_t least_faces);

}  // namespace noli
