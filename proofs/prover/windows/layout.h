// SPDX-License-Identifier: Apache-2.0
//
// Looks for layouts of the parts of a mesh that make them sheets (proofs/prover/windows/sheet.h).
//
// Notation
//   part     faces joined by vertices
//
// Any layout will do, as it is checked exactly. This one takes two coordinates of the given positions, scaled to the
// square [-1, 1]. It moves the border to the convex hull. Then it moves everything a little outwards, more so near the
// middle of a side, so that straight borders become convex despite rounding.
//
// Closed surfaces, sheets with holes and parts in several layers above the plane get no layout here; they are verified
// without one.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <noli/mesh.h>
#include <noli/query.h>

namespace noli {

struct Sheets {
  std::vector<std::vector<std::uint32_t>> faces;   ///< of each sheet, ascending
  std::vector<std::vector<std::uint32_t>> others;  ///< of each other part with enough faces
  std::vector<Point2> layout;                      ///< by vertex; meaningless for vertices outside sheets
};

/// Finds the sheets and other parts with at least `least_faces` faces, ordered by their first face. `x`: a position for
/// each vertex, whose third coordinate is ignored in two dimensions. Linear in the mesh, except for sorting the border.
Sheets find_sheets(const Mesh& mesh, std::span<const Position> x, int dimension, std::size_t least_faces);

}  // namespace noli
