// SPDX-License-Identifier: Apache-2.0
#include "proofs/prover/tokens/proof_tree.h"

#include "proofs/prover/cells/features.h"
#include "proofs/prover/tokens/tokens.h"

namespace noli {

namespace {

ProofCell cell_of(const Mesh& mesh, std::uint32_t cell) {
  const auto all = corners(mesh, cell);
  ProofCell result;
  const auto count = static_cast<std::size_t>(corner_count(mesh, cell));
  for (std::size_t i = 0; i < count; ++i) {
    std::size_t at = 0;
    while (at < result.corners && result.vertices[at] < all[i]) ++at;
    if (at < result.corners && result.vertices[at] == all[i]) continue;
    for (std::size_t k = result.corners; k > at; --k) result.vertices[k] = result.vertices[k - 1];
    result.vertices[at] = all[i];
    ++result.corners;
  }
  return result;
}

}  // namespace

ProofTree::ProofTree(const Mesh& mesh, std::span<const std::uint32_t> order, std::span<const std::uint32_t> ends,
                     std::span<const std::uint32_t> labels)
    : order_(order), labels_(labels) {
  nodes_.reserve(2 * order.size());
  cells_.reserve(order.size());
  for (std::uint32_t c = 0; c < order.size(); ++c) cells_.push_back(cell_of(mesh, c));
  join(ends, 0);
  order_ = labels_ = {};
}

std::uint32_t ProofTree::join(std::span<const std::uint32_t> ends, std::uint32_t begin) {
  if (ends.size() == 1) return halves(begin, ends[0]);
  const std::uint32_t i = add_node();
  const std::size_t half = ends.size() / 2;
  const std::uint32_t left = join(ends.first(half), begin);
  close(i, left, join(ends.subspan(half), ends[half - 1]));
  return i;
}

std::uint32_t ProofTree::halves(std::uint32_t begin, std::uint32_t end) {
  const std::uint32_t i = add_node();
  if (end - begin == 1) {
    nodes_[i].cell = order_[begin];
    nodes_[i].label = labels_[order_[begin]];
    return i;
  }
  const std::uint32_t middle = begin + (end - begin) / 2;
  const std::uint32_t left = halves(begin, middle);
  close(i, left, halves(middle, end));
  return i;
}

std::uint32_t ProofTree::add_node() {
  nodes_.emplace_back();
  return static_cast<std::uint32_t>(nodes_.size() - 1);
}

void ProofTree::close(std::uint32_t i, std::uint32_t left, std::uint32_t right) {
  const Node &l = nodes_[left], &r = nodes_[right];
  nodes_[i] = {left, right, 0, l.count + r.count, l.label == r.label ? l.label : no_label};
}

std::string ProofTree::encoded() const {
  std::string bytes;
  for (const Node& node : nodes_) put_uint(bytes, node.leaf() ? std::uint64_t{node.cell} + 1 : 0);
  return bytes;
}

}  // namespace noli
