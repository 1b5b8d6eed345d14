// SPDX-License-Identifier: Apache-2.0
//
// Continuous collision detection as the textbooks have it, to measure against: Provot 1997 ("Collision and
// self-collision handling in cloth model dedicated to design garments", section 3) and Bridson, Fedkiw and Anderson
// 2002 ("Robust treatment of collisions, contact and friction for cloth animation", section 6). Plain double precision,
// no tolerance.
//
// Notation
//   p, q, r           three differences of the query's points that are linearly dependent when the four points are
//                     coplanar; p(t) = p + t dp, ...
//   c                 det(p(t), q(t), r(t)) = c[0] + c[1] t + c[2] t^2 + c[3] t^3
// The cubic is cut at its critical points; on each monotone piece that changes sign a safeguarded Newton iteration
// finds the root; at each root the barycentric coordinates, from the normal equations, decide.
//
// What this does not do: give right answers always. Rounding moves roots and barycentric coordinates, and whatever is
// coplanar for the whole step or degenerate at the root is missed.
#pragma once

#include <noli/query.h>

namespace noli::bench {

/// Whether the textbook method thinks that the features meet during the step.
bool textbook_meet(const VertexFace3& query);
bool textbook_meet(const EdgeEdge3& query);

}  // namespace noli::bench
