// SPDX-License-Identifier: Apache-2.0
//
// Bounds of the groups of a forest over a span: boxes around the chords with their radii, boxes around the tangents of
// sheets, and which charts are monotone.
//
// Notation
//   box      as in proofs/prover/hierarchy.h: if on one axis the boxes of two groups are in the same strict order at
//            both ends of the span, it separates the world lines throughout
//   phi      as there, the same at both ends and for all trees
//
// Bounds below the roots exist only for trees given to make().
#pragma once

#include <vector>

#include "proofs/prover/hierarchy.h"
#include "proofs/prover/windows/window_cell.h"

namespace noli {

template <int Dim>
class WindowBoxes {
 public:
  /// `monotone`: whether to find out which sheets and charts are monotone.
  WindowBoxes(const Forest& forest, const WindowChords<Dim>& chords, int threads, bool monotone = true);

  /// Makes the bounds of all groups of the trees with these numbers.
  void make(const std::vector<std::size_t>& trees);

  /// The box of a whole tree.
  const GroupBox& root_box(std::size_t tree) const { return root_boxes_[tree]; }
  /// Whether a sheet is monotone as a whole.
  bool root_monotone(std::size_t tree) const { return root_monotone_[tree] != 0; }
  /// The bounds of a group of a tree given to make(); tangents only for groups of sheets.
  const GroupBox& box(Group g) const { return box_of(g.node); }
  const GroupBox& box_of(std::size_t node) const { return boxes_[node]; }
  const TangentBox& tangents(Group g) const { return tangents_[g.node]; }
  /// Whether a chart is monotone, for trees given to make().
  bool monotone(std::uint32_t chart) const { return monotone_[chart] != 0; }

 private:
  void find_phi();
  void bound_roots();
  bool sheet_monotone(const Tree& tree) const;
  bool chart_monotone(std::span<const LaidFace> faces) const;
  void look_at_charts();
  GroupBox box_around(const VertexChord<Dim>& chord) const;
  TangentBox tangents_at(const LaidFace& face) const;
  void fit(Group g, bool sheet);
  void join(Group g, bool sheet);

  const Forest& forest_;
  const WindowChords<Dim>& chords_;
  int threads_;
  bool asked_monotone_;
  std::array<Phi, Dim> phi_;
  std::vector<GroupBox> root_boxes_, boxes_;
  std::vector<TangentBox> tangents_;
  std::vector<std::uint8_t> root_monotone_;
  std::vector<std::uint8_t> monotone_;
};

}  // namespace noli
