// SPDX-License-Identifier: Apache-2.0
//
// What is true of a motion of a mesh: all pairs of cells, all pairs of their features, one by one, by the slow oracle
// (oracle). No hierarchy, no floating-point number that is computed with, nothing of the code under test.
//
// Notation
//   P, Q      features of two different cells that have no vertex in common: hulls of some of their vertices
//   largest   neither P nor Q can have another vertex of its cell without the two becoming more than four points (in 2D
//             three) or sharing one. Where smaller ones meet, so do they, and no later
//
// Cells that meet at the first time of all, an edge through the inside of a face say, are found by motion too: a vertex
// that runs along the edge meets the face.
//
// What this does not do: it knows no distance, no merged vertices, no excluded pairs; it takes a millisecond where the
// verifier takes a microsecond.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <noli/time_of_impact.h>
#include "audit/fuzz/trajectories/frame_motion.h"
#include "oracle/oracle.h"

namespace noli::audit {

/// Vertices, ascending, none twice.
using Feature = std::vector<VertexId>;
using FeatureTwo = std::array<Feature, 2>;

/// "0 | 2 3 4"
std::string words(const FeatureTwo& features);

/// The first step in which something meets, as `noli verify` has it: a contact at a border belongs to the step before.
struct MotionTruth {
  bool contact = false;
  std::size_t step = 0;              ///< from 0
  bool initial = false;              ///< cells meet at the first time of all (at rest: at its time)
  std::optional<oracle::Time> time;  ///< when features first meet in that step, in [0, 1]; nothing if none do
  std::vector<FeatureTwo> first;     ///< all largest pairs that meet then
  bool stopped = false;              ///< nothing of this counts
};

/// `stop`: polled; the oracle takes long for more than a few hundred cells.
MotionTruth truth_of(const FrameMotion& motion, const std::atomic<bool>* stop = nullptr);

/// What the oracle says of two features in a step. Precondition: one and three vertices or two and two (3D), or fewer.
oracle::Answer answer_of(const FrameMotion& motion, std::size_t step, const FeatureTwo& features);

/// Whether these are features of two different cells, without a common vertex.
bool are_compared(const Mesh& mesh, const FeatureTwo& features);

/// The vertices of each cell, in the order of the mesh.
std::vector<Feature> cells_of(const Mesh& mesh);

/// All pairs of parts of two cells (or of one with itself) without a common vertex, of at most so many together.
std::vector<FeatureTwo> disjoint_pairs(const Feature& a, const Feature& b, std::size_t most);
/// Those that are part of no other.
std::vector<FeatureTwo> largest(const std::vector<FeatureTwo>& pairs);

/// Whether the boxes of two sets of vertices keep their order along an axis and are more than a distance apart, as far
/// as is seen at once: then no two features of them are ever within it.
bool boxes_apart(int dimension, const std::vector<Position>& begin, const std::vector<Position>& end, const Feature& a,
                 const Feature& b, double distance);

/// The first time at which two features of a step are within a distance of each other; that they meet, for 0. As
/// answer_of, but in a dimension that is given.
std::optional<oracle::Time> first_within(int dimension, const std::vector<Position>& begin,
                                         const std::vector<Position>& end, const FeatureTwo& features, double distance);
/// Whether two features at rest meet, of at most five points together; `flat`: third coordinates count as 0.
bool meet_at_rest(const std::vector<Position>& x, const FeatureTwo& features, bool flat);

}  // namespace noli::audit
