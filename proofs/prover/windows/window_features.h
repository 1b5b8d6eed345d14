// SPDX-License-Identifier: Apache-2.0
//
// Decides a pair of features exactly over a window.
//
// Notation
//   piece   a time interval in which none of the vertices in question has a breakpoint: all move linearly
#pragma once

#include <array>

#include <noli/query.h>
#include <noli/time_of_impact.h>
#include "proofs/prover/windows/window_verifier.h"
#include "trajectory/world_lines.h"

namespace noli {

/// Encloses the time t = begin + s (end - begin) for s in an enclosure.
TimeEnclosure enclosure_in_window(TimeEnclosure s, double begin, double end);

/// Whether, and when, two features first meet in the piece [begin, end], in the unit of the lines. `vertices`: as in
/// FeatureContact.
std::optional<TimeEnclosure> meet_in_piece(FeaturePair pair, const std::array<VertexId, 4>& vertices,
                                           const WorldLines& lines, int dimension, double begin, double end);

/// Decides contacts of a window exactly. The lines must outlive this.
struct ExactlyInWindow {
  const WorldLines* lines;
  int dimension;

  /// Precondition: the features first meet within contact.first.
  FirstInWindow operator()(const FeatureContact& contact) const;
};

}  // namespace noli
