// SPDX-License-Identifier: Apache-2.0
//
// Sheets: surfaces laid out flat, so that a few inequalities per face show that a whole sheet does not touch itself
// (proofs/prover/windows/monotone.h).
//
// Notation
//   K        a surface of faces; two points of it are equal only if they are the same point of the same face, edge or
//            vertex (by ids)
//   layout   a point r(v) in the plane for each vertex, extended linearly over the faces: a map r from K
//   sheet    a surface and a layout that is injective and covers a convex polygon
//   border   the edges that have no opposite: no other face goes through them the other way
//
// Claim: r is injective and r(K) is a convex polygon D if (1) every face is laid out strictly counterclockwise; (2) no
// edge occurs twice in one direction; (3) the border is one cycle through different vertices; (4) in the layout it
// turns left or goes straight on everywhere, and around once. Proof. The faces are a chain whose boundary is the
// border. So a point of the plane off all edges is covered as often as the border winds around it (orientations count,
// and are positive everywhere): by (4) once inside the convex polygon D, never outside. So the interiors of the faces
// do not overlap, and they fill D. Around a point of K off the border the faces fill a whole disc, so no other point of
// K is laid out there; and the border does not meet itself.
//
// proofs/prover/windows/layout.h finds layouts.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <noli/query.h>

namespace noli {

/// A face by the numbers of its vertices in some surface, counted from 0.
using LocalFace = std::array<std::uint32_t, 3>;

/// The vertices of the border in order, if (2) and (3) hold; otherwise empty.
std::vector<std::uint32_t> border_of(std::span<const LocalFace> faces, std::size_t vertices);

/// Whether (1) to (4) hold; exact. `layout` has a point for each vertex. Time and memory are linear (if no vertex has
/// more than a few faces).
bool is_sheet(std::span<const LocalFace> faces, std::span<const Point2> layout);

}  // namespace noli
