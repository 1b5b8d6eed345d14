// SPDX-License-Identifier: Apache-2.0
//
// Positions of vertices in a span of a window, for the walk over pairs of groups: along their chords, with radii.
//
// Two groups of one part are settled at once if the part is monotone around both (proofs/prover/windows/monotone.h): a
// sheet in a rectangle around both, another part in a chart that contains both.
#pragma once

#include "proofs/prover/group_pair.h"
#include "proofs/prover/tokens/proof_parts.h"
#include "proofs/prover/windows/pieces.h"
#include "proofs/prover/windows/window_boxes.h"

namespace noli {

/// What tokens must prove, and when to give up.
struct SpanProof {
  Piece span;
  double eta;              ///< the least distance, for which the radii of the chords have room
  const MeshPaths* paths;  ///< paths between features that may be nearer
  const StopSignal& stop;
};

/// As Straight in proofs/prover/straight.h.
template <int Dim>
class Chords {
 public:
  static constexpr int dim = Dim;
  static constexpr bool straight = false;
  static constexpr std::uint32_t least_grain = 64;  ///< the least number of cells of a task
  using Cell = ChordCell<Dim>;
  using Gathered = WindowCell<Dim>;
  using Tally = WindowTally;

  /// `proof`: where tokens are written.
  Chords(const WorldLines& lines, const Forest& forest, const WindowChords<Dim>& chords, const WindowBoxes<Dim>& boxes,
         const SpanProof* proof = nullptr)
      : lines_(lines), forest_(forest), chords_(chords), boxes_(boxes), pieces_(lines, chords.span), proof_(proof) {}

  void begin(const Obligation& obligation) { part_ = forest_.part_of(obligation.first, obligation.second); }

  const GroupBox& box_of(std::size_t node) const { return boxes_.box_of(node); }
  Cell cell(Group leaf) const { return {forest_.leaf(leaf), chords_.of.data()}; }
  const Leftovers& leftovers() const { return forest_.leftovers(); }

  bool left_out(const GroupPair& pair) const { return forest_.left_out(pair.first(), pair.second()); }

  bool settled_at_once(const GroupPair& pair) const {
    if (part_ == nullptr) return false;
    const Group a = pair.first(), b = pair.second();
    if (!part_->sheet) return holds_both(a, b) || holds_both(b, a);
    if (a.count + (pair.is_self() ? 0 : b.count) < worth_asking) return false;
    const TangentBox both = merged(boxes_.tangents(a), boxes_.tangents(b));
    return monotone_around(both, merged(forest_.extent(a), forest_.extent(b)));
  }

  double begin_time() const { return chords_.span.begin; }
  bool from_the_beginning() const { return begin_time() == lines_.first_time(); }
  Gathered at_begin(const Gathered& cell) const { return pieces_.at_begin(cell); }

  /// Writes the tokens for parts without a common vertex. False if it was stopped; the tokens are then incomplete.
  bool prove_apart(const Gathered& a, CornerMask a_part, const Gathered& b, CornerMask b_part, Tokens& tokens) const {
    ProofParts<Dim> parts(lines_, proof_->span, proof_->eta, proof_->paths, proof_->stop, tokens);
    return parts.settle(a.cell, vertices_of(a, a_part), b.cell, vertices_of(b, b_part));
  }

  /// The beginning of the first piece in which no direction separates two parts, if there is one.
  std::optional<double> resisting(const Gathered& a, CornerMask a_part, const Gathered& b, CornerMask b_part,
                                  Tally& tally) const {
    return pieces_.resisting(a, a_part, b, b_part, tally);
  }
  std::optional<TimeEnclosure> meet(const FeatureQuestion<Dim>& question, double begin, Tally& tally) const {
    return pieces_.meet(question, begin, tally);
  }

 private:
  static ProofCell vertices_of(const Gathered& cell, CornerMask part) {
    ProofCell vertices;
    for (std::size_t i = 0; i < 3; ++i) {
      if ((part >> i & 1) != 0) vertices.add(cell.vertices[i]);
    }
    return vertices;
  }

  /// Pairs of smaller groups are settled cell by cell, without a test whether the sheet is monotone around them.
  static constexpr std::uint32_t worth_asking = 8;

  /// Whether the chart of the first group is monotone and covers the second.
  bool holds_both(Group a, Group b) const {
    const Charts& charts = forest_.charts();
    const std::uint32_t chart = charts.chart_of(a);
    return chart != Charts::none && boxes_.monotone(chart) && charts.covers(chart, b);
  }

  /// Whether the sheet is monotone in a rectangle, given the tangents of some of its faces.
  bool monotone_around(TangentBox tangents, const Extent& extent) const {
    return is_monotone(tangents, Dim) && add_tangents(part_->root, extent, tangents);
  }

  /// Adds the tangents of the faces of a group that are laid out in a rectangle. False if nothing is monotone then.
  bool add_tangents(Group g, const Extent& extent, TangentBox& tangents) const {
    if (!forest_.extent(g).meets(extent)) return true;
    const TangentBox more = merged(tangents, boxes_.tangents(g));
    if (is_monotone(more, Dim)) {
      tangents = more;
      return true;
    }
    return !g.is_leaf() && add_tangents(g.left(), extent, tangents) && add_tangents(g.right(), extent, tangents);
  }

  const WorldLines& lines_;
  const Forest& forest_;
  const WindowChords<Dim>& chords_;
  const WindowBoxes<Dim>& boxes_;
  Pieces<Dim> pieces_;
  const SpanProof* proof_;
  const Tree* part_ = nullptr;
};

}  // namespace noli
