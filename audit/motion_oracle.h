// SPDX-License-Identifier: Apache-2.0
//
// What is true of a motion of a mesh: all pairs of cells, all pairs of their features, one by one, by the slow oracle
// (tests/oracle). No hierarchy, no floating-point number that is computed with, nothing of the code under test.
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
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "noli/audit/frame_motion.h"
#include "noli/kernel/first_contact.h"
#include "noli/tests/oracle/oracle.h"

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
};

MotionTruth truth_of(const FrameMotion& motion);

/// What the oracle says of two features in a step. Precondition: one and three vertices or two and two (3D), or fewer.
oracle::Answer answer_of(const FrameMotion& motion, std::size_t step, const FeatureTwo& features);

/// Whether these are features of two different cells, without a common vertex.
bool are_compared(const Mesh& mesh, const FeatureTwo& features);

/// The vertices of each cell, in the order of the mesh.
std::vector<Feature> cells_of(const Mesh& mesh);

}  // namespace noli::audit
