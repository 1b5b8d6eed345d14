// SPDX-License-Identifier: Apache-2.0
//
// Looks for layouts of the parts of a mesh that make them sheets (proofs/prover/windows/sheet.h).
//
// Notation
//   part     faces joined by vertices
//
// Where a layout comes from does not matter, as it is checked exactly. Here: two coordinates of the positions that are
// given, scaled to the square [-1, 1]; what is on the border is moved to the convex hull, and everything a little
// outwards the more the nearer it is to the middle of a side, so that straight borders become convex in spite of
// rounding.
//
// What this does not do: closed surfaces, sheets with holes and parts that lie in several layers above the plane have
// no layout here; for them nothing is gained and nothing lost.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <noli/mesh.h>
#include <noli/query.h>

namespace noli {

struct Sheets {
  std::vector<std::vector<std::uint32_t>> faces;   ///< of each sheet, ascending
  std::vector<std::vector<std::uint32_t>> others;  ///< of each other part with so many faces
  std::vector<Point2> layout;                      ///< by vertex; of a vertex that is in no sheet meaningless
};

/// Finds the sheets and other parts with at least `least_faces` faces, ordered by their first face. `x`: a position for
/// each vertex, of which the third coordinate is not looked at in two dimensions. Linear in the mesh, but for sorting
/// what is on the border.
Sheets find_sheets(const Mesh& mesh, std::span<const Position> x, int dimension, std::size_t least_faces);

}  // namespace noli
