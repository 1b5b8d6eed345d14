// SPDX-License-Identifier: Apache-2.0
//
// From what a file lists to the cells of a mesh; the rules are the same for all formats.
//
//   polygon p0 p1 .. pn       the fan (p0, p1, p2), (p0, p2, p3), ..., (p0, pn-1, pn). A stated rule, not a good
//                             triangulation: a polygon that is not convex folds over itself.
//   polygon of two, of one    a loose edge, a loose point
//   loose edges and points    each once, and only where nothing larger has them already: drop_redundant_cells
//
// What this does not do: it looks at no coordinates and welds nothing (see merge.h for that).
#pragma once

#include <span>
#include <vector>

#include <noli/mesh.h>

namespace noli {

/// Appends the cells of one polygon. Precondition: at least one corner.
void add_polygon(Mesh& mesh, std::span<const VertexId> corners);

/// Removes loose edges that are an edge of a face, loose points that are a corner of a face or loose edge, and all but
/// the first of equal ones (in either direction). The others keep their order. No contact is lost: what is removed
/// remains as a feature of what has it. Faces are left as they are, even equal ones.
void drop_redundant_cells(Mesh& mesh);

/// The vertices that no cell refers to, in ascending order.
std::vector<VertexId> unreferenced_vertices(const Mesh& mesh);

/// Removes unreferenced vertices. Returns the old numbers of the others, which keep their order.
std::vector<VertexId> drop_unreferenced_vertices(Mesh& mesh);

/// The first vertex of each cell all of whose vertices are held, in the order of cells. `held`: one per vertex, not 0
/// if it is.
std::vector<VertexId> held_cells(const Mesh& mesh, std::span<const std::uint8_t> held);

}  // namespace noli
