// SPDX-License-Identifier: Apache-2.0
//
// The cells of a mesh in binary trees: one for each sheet, one for each other large part, and one for all the rest. It
// depends only on the mesh and one set of positions, so it is made once for a run.
//
// Notation
//   tree     as in proofs/prover/hierarchy.h: a node over m > 1 leaves has the first m / 2 in its left child; nodes and
//            leaves are numbered across all trees
//   part, sheet   as in proofs/prover/windows/layout.h and sheet.h. The tree of a sheet splits the layout, the others
//                 the positions. Parts that are not sheets have charts (proofs/prover/windows/charts.h)
//   extent   of a group of a sheet: the bounding rectangle of its layout, rounded outwards
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <noli/mesh.h>
#include "proofs/prover/cells/labels.h"
#include "proofs/prover/cells/leftover.h"
#include "proofs/prover/cells/moving_cell.h"
#include "proofs/prover/windows/charts.h"
#include "proofs/prover/windows/monotone.h"
#include "proofs/prover/windows/window_verifier.h"
#include "trajectory/cell_features.h"

namespace noli {

/// The part of a cell that does not depend on its motion.
struct Leaf : CellIndices {
  std::uint32_t label;  ///< as in proofs/prover/cells/labels.h
};

/// A closed rectangle.
struct Extent {
  float low_u, low_v, high_u, high_v;

  bool meets(const Extent& other) const {
    return low_u <= other.high_u && other.low_u <= high_u && low_v <= other.high_v && other.low_v <= high_v;
  }
};

inline Extent merged(const Extent& a, const Extent& b) {
  return {std::min(a.low_u, b.low_u), std::min(a.low_v, b.low_v), std::max(a.high_u, b.high_u),
          std::max(a.high_v, b.high_v)};
}

struct Tree {
  Group root;
  bool sheet = false;
  bool part = false;               ///< a sheet or another part
  std::vector<VertexId> vertices;  ///< of its cells, ascending
};

/// Preconditions: as for WindowVerifier, which also says which options count; `x` has a position for each vertex; at
/// least one cell.
class Forest {
 public:
  Forest(const Mesh& mesh, std::span<const Position> x, const WindowOptions& options);

  /// Sheets first.
  const std::vector<Tree>& trees() const { return trees_; }
  /// The part that contains both groups; nullptr if they are in different trees, or in the tree of the rest.
  const Tree* part_of(Group a, Group b) const;
  std::size_t node_count() const { return labels_.size(); }
  const std::vector<Leaf>& leaves() const { return leaves_; }
  const Leaf& leaf(Group g) const { return leaves_[g.begin]; }
  /// Whether two groups, each of one label, are not compared.
  bool left_out(Group a, Group b) const {
    const std::uint32_t of_a = labels_[a.node], of_b = labels_[b.node];
    return of_a != no_label && of_b != no_label && cell_labels_.excludes(of_a, of_b);
  }
  /// The payload of block TREE (proofs/FORMAT.md): all trees, joined by a tree that halves their list.
  std::string encoded() const;

  /// The tree of the part that contains a vertex.
  static constexpr std::uint32_t no_part = ~std::uint32_t{0};
  std::uint32_t part_of(VertexId v) const { return part_of_[v]; }
  /// The length, at the given positions, of the shortest edge of a cell at a vertex; infinite if there is none.
  float size(VertexId v) const { return sizes_[v]; }

  const Charts& charts() const { return *charts_; }
  const Leftovers& leftovers() const { return leftovers_; }

  /// By leaf and by group; only for sheets.
  const LaidFace& laid_face(std::size_t leaf) const { return laid_faces_[leaf]; }
  const Extent& extent(Group g) const { return extents_[g.node]; }

 private:
  static constexpr std::uint32_t no_label = ~std::uint32_t{0};

  void add_tree(bool sheet, bool part, std::size_t begin);
  void finish(Group g, std::span<const Point2> layout, bool sheet);
  void make_charts(const Mesh& mesh, std::span<const Position> x, int dimension);

  std::vector<Tree> trees_;
  std::vector<Leaf> leaves_;
  std::vector<LaidFace> laid_faces_;
  CellLabels cell_labels_;
  std::vector<std::uint32_t> labels_;  ///< by node: the label of all its cells, or no_label
  std::vector<Extent> extents_;
  std::optional<Charts> charts_;
  Leftovers leftovers_;
  std::vector<std::uint32_t> part_of_;
  std::vector<float> sizes_;
};

}  // namespace noli
