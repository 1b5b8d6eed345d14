// SPDX-License-Identifier: Apache-2.0
//
// Where the points of two features are at the time they meet, or nearly meet: all of them around the origin, in the
// hull of given directions.
#pragma once

#include <array>
#include <cstdint>

#include "audit/fuzz/queries/whole_query.h"

namespace noli::audit {

/// Where in the two features the origin lies.
enum class Place {
  inside,   ///< relatively interior to both (for directions that are not parallel)
  border,   ///< on an edge of the face; an end of one edge
  corner,   ///< on a corner of the face; on an end of both edges
  missed,   ///< as border, but moved off by the least step: the features do not meet
  outside,  ///< far off: the features do not meet
};

constexpr std::array<Place, 3> meeting_places = {Place::inside, Place::border, Place::corner};

struct Directions {
  Whole p, q;
};

/// In which proportion the origin divides the features; each at least 1.
using Ratios = std::array<std::int64_t, 4>;

Ratios random_ratios(Random& random);

struct Meeting {
  WholePoints x{};
  /// Signed weights, those of the first feature positive: sum weights[i] x[i] = 0, and the weights of either feature
  /// have the same sum. All zero where the features do not meet.
  std::array<std::int64_t, 4> weights{};
};

/// The points of a query of that type. vertex_edge uses p only; so does vertex_vertex, and only where they do not meet.
/// Preconditions: p is not zero; in `missed` the directions of vertex_face and edge_edge lie in the floor.
Meeting meeting(const QueryType& type, Place place, const Ratios& ratios, const Directions& directions);

}  // namespace noli::audit
