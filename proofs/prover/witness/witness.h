// SPDX-License-Identifier: Apache-2.0
//
// Finds witnesses of contact: the payload of block WITN (proofs/FORMAT.md, section 5), for steps between frames and for
// windows.
//
// Notation
//   integer time   time in the step's units of 2^q
//   g          a polynomial that has the time, in integer time, as a root
//   weights    of the vertices of two features, as polynomials in time, such that g divides the difference of the two
//              points that they give
//
// Each vertex is taken on one segment between two of its breakpoints; the interval to search is cut at the breakpoints
// of the vertices.
//
// Algorithm: try all ways in which some vertices of the two features can meet (proofs/prover/witness/dependency.h),
// first at the time of the contact and then during the whole step: at the roots of their conditions, and at rest at
// breakpoints. Try cells that meet at the beginning at rest. Judge each witness (fault_of_witness) before returning it;
// if it does not hold, the search goes on.
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
  double shift;  ///< its times are exactly those of the lines plus this
  int dimension;
  bool strict;
  double eta = 0;                      ///< the least distance
  std::uint32_t ring = 1;              ///< features joined by a path of fewer edges may be nearer
  const CellLabels* labels = nullptr;  ///< decide which cells are not compared; nothing: all are compared

  bool compares(std::uint32_t i, std::uint32_t j) const { return labels == nullptr || !labels->leave_out(i, j); }
};

/// Why a checker would reject the payload of a block WITN; nothing if it holds. Judges all conditions and limits of
/// proofs/FORMAT.md, section 5.
std::optional<std::string> fault_of_witness(const WitnessStep& step, std::string_view payload);

/// The payload for a pair of features that meets; nothing if none was found.
std::optional<std::string> witness_of(const WitnessStep& step, const FeatureContact& contact);

/// The same for two cells that meet at the beginning.
std::optional<std::string> witness_of(const WitnessStep& step, const InitialIntersection& pair);

/// The same for two cells that are nearer to each other than the least distance at a time of the lines.
std::optional<std::string> witness_of(const WitnessStep& step, const TooNear& near, const MeshPaths& paths);

/// The payload for the first contact; if it has none, for any other that was found.
std::optional<std::string> witness_of(const WitnessStep& step, const std::optional<FeatureContact>& first,
                                      std::span<const InitialIntersection> initial,
                                      std::span<const FeatureContact> contacts);

}  // namespace noli
