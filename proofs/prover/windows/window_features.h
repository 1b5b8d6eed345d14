// SPDX-License-Identifier: Apache-2.0
//
// The exact question about a pair of features over a window.
//
// Notation
//   piece   a time in which none of the vertices in question has a breakpoint: all move linearly
//
// What this does not do: it looks for no directions (proofs/prover/windows/pieces.h).
#pragma once

#include <array>

#include <noli/query.h>
#include <noli/time_of_impact.h>
#include "kernel/moment.h"
#include "proofs/prover/verifier.h"
#include "trajectory/world_lines.h"

namespace noli {

/// A pair of features by its vertices, as in FeatureContact.
struct FeatureNames {
  FeaturePair pair;
  std::array<VertexId, 4> vertices;
};

/// The time t = begin + s (end - begin) for s in an enclosure, enclosed.
TimeEnclosure enclosure_in_window(TimeEnclosure s, double begin, double end);

/// Whether, and when, the features first meet in the piece [begin, end], in the unit of the lines.
std::optional<TimeEnclosure> meet_in_piece(const FeatureNames& features, const WorldLines& lines, int dimension,
                                           double begin, double end);

/// The first time at which two features meet, and how.
struct ExactContact {
  Moment time;
  ContactKind kind;
};

/// Precondition: the features first meet within `first`.
ExactContact exact_contact(const FeatureNames& features, const WorldLines& lines, int dimension, TimeEnclosure first);

}  // namespace noli
