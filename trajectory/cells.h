// SPDX-License-Identifier: Apache-2.0
//
// Makes the cells of a mesh from what a file lists; the rules are the same for all formats.
//
//   polygon p0 p1 .. pn       the fan (p0, p1, p2), (p0, p2, p3), ..., (p0, pn-1, pn). The rule is simple, not a good
//                             triangulation: a polygon that is not convex folds over itself.
//   polygon of two, of one    a loose edge, a loose point
//   loose edges and points    each once, and only if no larger cell has them: drop_redundant_cells
//
// It ignores coordinates and welds nothing (merge.h does).
#pragma once

#include <span>
#include <vector>

#include <noli/mesh.h>

namespace noli {

/// Appends the cells of one polygon. Precondition: at least one corner.
void add_polygon(Mesh& mesh, std::span<const VertexId> corners);

/// Removes loose edges that are an edge of a face, loose points that are a corner of a face or loose edge, and all but
/// the first of equal ones (in either direction). The others keep their order. No contact is lost: a removed cell is
/// still a feature of a larger or equal one. Faces stay as they are, even equal ones.
void drop_redundant_cells(Mesh& mesh);

/// Puts another mesh behind this one: its vertices get the numbers that follow. Precondition: numbers suffice.
void append_mesh(Mesh& mesh, const Mesh& other);

/// The vertices that no cell refers to, in ascending order.
std::vector<VertexId> unreferenced_vertices(const Mesh& mesh);

/// Makes points of the vertices that no cell refers to (--points).
void add_particles(Mesh& mesh);

/// Removes unreferenced vertices. Returns the old numbers of the others, which keep their order.
std::vector<VertexId> drop_unreferenced_vertices(Mesh& mesh);

/// The first vertex of each cell whose vertices are all held, in the order of cells. `held`: one per vertex, nonzero if
/// the vertex is held.
std::vector<VertexId> held_cells(const Mesh& mesh, std::span<const std::uint8_t> held);

}  // namespace noli
