// SPDX-License-Identifier: Apache-2.0
//
// How far each vertex is from what it may meet.
//
// Notation
//   gap of a vertex   the least distance of a pair of features that it is part of, as far as that matters: at most its
//                     reach. Pairs that nothing can move, or that are excluded, do not count
//
// The numbers are rounded. They choose layers of contact (step_contact.h), and decide nothing else.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <noli/mesh.h>
#include "certificates/closest.h"
#include "certificates/features.h"
#include "certificates/hierarchy.h"

namespace noli {

template <int Dim>
class NearGaps {
 public:
  using Vector = certificates::Vector<Dim>;

  /// x: any positions of the mesh, from which the tree is built. `fixed`: by vertex. `exclusions`: nothing, or pairs of
  /// groups that do not count. `excluded`: keys of pairs that do not count either, ascending. The arguments but x have
  /// to outlive this.
  NearGaps(const Mesh& mesh, std::span<const Vector> x, std::span<const std::uint8_t> fixed,
           const Exclusions* exclusions, const std::vector<certificates::PairKey>& excluded)
      : features_(mesh, Dim), fixed_(fixed), exclusions_(exclusions), excluded_(excluded) {
    std::vector<Vector> centres;
    std::vector<bool> cell_is_fixed;
    for (const auto& cell : features_.cells()) {
      centres.push_back(x[cell.vertices[0]]);
      cell_is_fixed.push_back(std::ranges::all_of(cell.all(), [&](VertexId v) { return fixed[v] != 0; }));
    }
    tree_ = certificates::Hierarchy<Dim>(centres, cell_is_fixed);
  }

  const certificates::Features& features() const { return features_; }

  /// The gaps at positions x. `reach`: by vertex. O(n log n) where few are near.
  std::vector<double> operator()(std::span<const Vector> x, std::span<const double> reach) {
    tree_.refit([&](std::uint32_t c) { return box_of(features_.cells()[c], x, reach); });
    std::vector<double> gaps(reach.begin(), reach.end());
    tree_.for_each_pair([&](std::uint32_t a, std::uint32_t b) {
      features_.for_each_pair(a, b, [&](const certificates::Stencil& pair) { look_at(pair, x, gaps); });
    });
    return gaps;
  }

 private:
  using Box = certificates::MovingBox<Dim>;

  /// Two cells that are as near as the lesser of their reaches have boxes that meet.
  static Box box_of(const certificates::Features::Cell& cell, std::span<const Vector> x,
                    std::span<const double> reach) {
    Box box = Box::empty();
    double most = 0;
    for (const VertexId v : cell.all()) {
      box.low[0] = box.low[0].cwiseMin(x[v]);
      box.high[0] = box.high[0].cwiseMax(x[v]);
      most = std::max(most, reach[v]);
    }
    const Vector margin = Vector::Constant(most / 2);
    box.low[0] -= margin;
    box.high[0] += margin;
    box.low[1] = box.low[0];
    box.high[1] = box.high[0];
    return box;
  }

  void look_at(const certificates::Stencil& pair, std::span<const Vector> x, std::vector<double>& gaps) const {
    const std::span<const VertexId> all(pair.vertices.data(), pair.size());
    if (std::ranges::all_of(all, [&](VertexId v) { return fixed_[v] != 0; })) return;
    if (exclusions_ != nullptr && !exclusions_->empty() &&
        exclusions_->excluded(exclusions_->groups[all.front()], exclusions_->groups[all.back()])) {
      return;
    }
    if (std::ranges::binary_search(excluded_, pair.key)) return;
    std::array<Vector, 4> corners;
    for (std::size_t i = 0; i < all.size(); ++i) corners[i] = x[all[i]];
    const double gap =
        certificates::closest<Dim>(pair.kind, std::span<const Vector>(corners.data(), all.size())).distance();
    for (const VertexId v : all) gaps[v] = std::min(gaps[v], gap);
  }

  certificates::Features features_;
  certificates::Hierarchy<Dim> tree_;
  std::span<const std::uint8_t> fixed_;
  const Exclusions* exclusions_;
  const std::vector<certificates::PairKey>& excluded_;
};

}  // namespace noli
