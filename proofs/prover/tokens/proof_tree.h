// SPDX-License-Identifier: Apache-2.0
//
// The tree over the cells of which a proof's obligations speak (proofs/FORMAT.md, TREE).
//
// Notation
//   order    the cells in the order of the leaves
//   range    successive entries of the order: one tree each, in which a node over m > 1 leaves has the first m / 2 in
//            its left child; these trees are joined in the same way
//   node     numbered in prefix order; the root is 0
//
// What this does not do: it knows no positions.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include <noli/mesh.h>

namespace noli {

/// A cell's vertices, each once, ascending.
struct ProofCell {
  std::array<VertexId, 3> vertices{};
  std::uint8_t corners = 0;
};

class ProofTree {
 public:
  static constexpr std::uint32_t no_label = std::numeric_limits<std::uint32_t>::max();

  struct Node {
    std::uint32_t left = 0, right = 0;  ///< children; 0, 0 at a leaf
    std::uint32_t cell = 0;             ///< of a leaf
    std::uint32_t count = 1;            ///< leaves below
    std::uint32_t label = no_label;     ///< that all cells below have, if they have one

    bool leaf() const { return left == 0; }
  };

  /// Preconditions: `order` has each cell of the mesh once; `ends` ascend, and the last is its size; `labels` has one
  /// entry a cell, below no_label.
  ProofTree(const Mesh& mesh, std::span<const std::uint32_t> order, std::span<const std::uint32_t> ends,
            std::span<const std::uint32_t> labels);

  const std::vector<Node>& nodes() const { return nodes_; }
  const Node& node(std::uint32_t i) const { return nodes_[i]; }
  const ProofCell& cell(std::uint32_t c) const { return cells_[c]; }
  /// The payload of block TREE.
  std::string encoded() const;

 private:
  std::uint32_t join(std::span<const std::uint32_t> ends, std::uint32_t begin);
  std::uint32_t halves(std::uint32_t begin, std::uint32_t end);
  std::uint32_t add_node();
  void close(std::uint32_t i, std::uint32_t left, std::uint32_t right);

  std::span<const std::uint32_t> order_, labels_;  ///< while it is made
  std::vector<Node> nodes_;
  std::vector<ProofCell> cells_;
};

}  // namespace noli
