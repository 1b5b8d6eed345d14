// SPDX-License-Identifier: Apache-2.0
//
// Witnesses of contact: the payload of block WITN (proofs/FORMAT.md, section 5), for steps between frames and for
// windows.
//
// Notation
//   integer time   time in units of 2^q, the step's
//   g          the polynomial one of whose roots is the time, in integer time
//   weights    of the vertices of two features, as polynomials in the time, such that g divides the difference of the
//              two points that they give
//
// Each vertex is looked at on one segment between two of its breakpoints; the time at which the features meet is cut
// where one of them has a breakpoint.
//
// Algorithm: all ways in which some vertices of the two features can meet (proofs/prover/witness/dependency.h) are
// tried, first at the time of the contact and then during the whole step: at the roots of their conditions, and at rest
// at breakpoints. Cells that meet at the beginning are looked at, at rest. A witness that is found is judged
// (fault_of_witness) before it is given away; where it does not hold, the search goes on.
//
// What this does not do: it does not find contacts.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include <noli/findings.h>
#include "proofs/prover/cells/labels.h"
#include "proofs/prover/tokens/mesh_paths.h"
#include "proofs/prover/tokens/no_proof.h"
#include "proofs/prover/verifier.h"
#include "trajectory/world_lines.h"

namespace noli {

/// A step in which something meets. In two dimensions third coordinates count as 0.
struct WitnessStep {
  const Mesh& mesh;  ///< after merging
  const WorldLines& lines;
  double shift;  ///< its times are those of the lines and this more, exactly
  int dimension;
  bool strict;
  double eta = 0;                      ///< the least distance
  std::uint32_t ring = 1;              ///< features that a path of fewer edges joins may be nearer
  const CellLabels* labels = nullptr;  ///< which say what is not compared; nothing: all cells are

  bool compares(std::uint32_t i, std::uint32_t j) const { return labels == nullptr || !labels->leave_out(i, j); }
};

/// Why a checker would refuse the payload of a block WITN, in words: it judges all conditions and limits of
/// proofs/FORMAT.md, section 5. Nothing if it holds.
std::optional<std::string> fault_of_witness(const WitnessStep& step, std::string_view payload);

/// The payload for a pair of features that meets; nothing if none was found.
std::optional<std::string> witness_of(const WitnessStep& step, const FeatureContact& contact);

/// The same for two cells that meet at the beginning.
std::optional<std::string> witness_of(const WitnessStep& step, const InitialIntersection& pair);

/// The same for two cells that are nearer to each other than the least distance at a time of the lines.
std::optional<std::string> witness_of(const WitnessStep& step, const TooNear& near, const MeshPaths& paths);

/// Of the first contact; where that has none, of any of those that were found.
std::optional<std::string> witness_of(const WitnessStep& step, const std::optional<FeatureContact>& first,
                                      std::span<const InitialIntersection> initial,
                                      std::span<const FeatureContact> contacts);

}  // namespace noli
