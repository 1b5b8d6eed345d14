// SPDX-License-Identifier: Apache-2.0
//
// Motions made backwards from a contact: two bodies, one above a floor and one below it, that come to it at a known
// time.
//
// Notation
//   floor     the plane (in 2D the line) in which both bodies have a feature at the time t* = k / n of a step, and
//             nothing else: all other vertices are strictly above or below. The height is the last coordinate
//   upper     the body of which every vertex is strictly above the floor before t*; the lower one is never above it
//
// So the two can meet at t* at the earliest, and do so if and only if their features in the floor do, which
// audit/fuzz/queries/meeting.h arranges. All numbers are whole but t*, whose n is a power of two, so t* is a double.
#pragma once

#include "audit/fuzz/queries/meeting.h"
#include "audit/fuzz/trajectories/whole_motion.h"

namespace noli::audit {

struct FloorPlan {
  QueryType type{};              ///< of the features in the floor
  Place place = Place::inside;   ///< how they lie to each other at t*
  StepTime when;                 ///< k > n: they do not come as far
  bool rigid = false;            ///< each body a tetrahedron (in 2D a triangle) that only translates
  bool joined = false;           ///< rigid, and a face beside them is joined to both: one body
  bool away = false;             ///< the upper body rises instead: k = 0, contact at the first time only
  std::int64_t size = 16;        ///< of directions
  std::int64_t speed = 1 << 10;  ///< in the floor, in an n-th of the step
  std::int64_t fall = 1 << 10;   ///< the same across it
  std::size_t before = 0;        ///< steps before, all above the floor
  std::size_t after = 0;         ///< steps behind
  bool at_rest = false;          ///< only how they are at t*
};

struct FloorMotion {
  WholeMotion motion;
  PlantedTruth planted;
};

/// Preconditions: when.n is a power of two up to 64; joined only in 3D; what follows a step without a contact rises,
/// what follows a contact is random.
FloorMotion floor_motion(const FloorPlan& plan, Random& random);

}  // namespace noli::audit
