// SPDX-License-Identifier: Apache-2.0
//
// Positions of vertices in a step between two frames, for the walk over pairs of groups: exact, along straight lines.
//
// `Traversal` and `CellPairs` take these positions or those of proofs/prover/windows/chords.h.
#pragma once

#include "proofs/prover/feature_pairs.h"
#include "proofs/prover/group_pair.h"
#include "proofs/prover/hierarchy.h"
#include "proofs/prover/tally.h"

namespace noli {

template <int Dim>
class Straight {
 public:
  static constexpr int dim = Dim;
  static constexpr bool straight = true;             ///< each vertex moves along one straight line, exactly
  static constexpr std::uint32_t least_grain = 256;  ///< the least number of cells of a task
  using Cell = StepCell<Dim>;
  using Gathered = MovingCell<Dim>;
  using Tally = noli::Tally;

  /// `cells`: in the order of the leaves.
  Straight(const Hierarchy& hierarchy, const StepCell<Dim>* cells, const Leftovers& leftovers)
      : hierarchy_(hierarchy), cells_(cells), leftovers_(leftovers) {}

  /// Called before the walk over an obligation.
  void begin(const Obligation& /*obligation*/) {}

  const GroupBox& box_of(std::size_t node) const { return hierarchy_.box_of(node); }
  const Cell& cell(Group leaf) const { return cells_[leaf.begin]; }
  const Leftovers& leftovers() const { return leftovers_; }

  /// Whether a pair of groups is not to be compared.
  static constexpr bool left_out(const GroupPair& /*pair*/) { return false; }
  /// Whether a pair of groups is settled by other means than a direction.
  static constexpr bool settled_at_once(const GroupPair& /*pair*/) { return false; }

  static constexpr double begin_time() { return 0; }
  /// Whether begin_time() is the beginning of the step; and a cell with its exact positions then.
  static constexpr bool from_the_beginning() { return true; }
  const Gathered& at_begin(const Gathered& cell) const { return cell; }

  /// When two features first meet, from `begin` on.
  std::optional<TimeEnclosure> meet(const FeatureQuestion<Dim>& question, double /*begin*/, Tally& tally) const {
    return ask(question, tally.stages);
  }

 private:
  const Hierarchy& hierarchy_;
  const StepCell<Dim>* cells_;
  const Leftovers& leftovers_;
};

}  // namespace noli
