// SPDX-License-Identifier: Apache-2.0
#include "noli/proofs/prover/hierarchy.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "noli/kernel/parallel.h"
#include "noli/proofs/prover/features.h"

namespace noli {

namespace {

/// phi, for one axis and one end of the step.
struct MonotoneMap {
  double middle = 0;
  double scale = 1;

  float operator()(double x) const { return static_cast<float>((x - middle) * scale); }
};

/// The map that takes [low, high] into [-1, 1]; both bounds are finite.
MonotoneMap map_onto_unit(double low, double high) {
  const double half = 0.5 * high - 0.5 * low;
  int exponent = 0;
  std::frexp(half, &exponent);
  return {0.5 * low + 0.5 * high, std::ldexp(1.0, std::clamp(-exponent, -1022, 1022))};
}

MonotoneMap map_for(std::span<const Position> x, std::size_t axis) {
  double low = std::numeric_limits<double>::max(), high = std::numeric_limits<double>::lowest();
  for (const Position& p : x) {
    low = std::min(low, p[axis]);
    high = std::max(high, p[axis]);
  }
  return map_onto_unit(low, high);
}

/// phi of one vertex at both ends.
struct MappedVertex {
  Lanes t0{}, t1{};
};

/// What the median split looks at: twice the centre of a cell, per axis, in units of phi.
struct Entry {
  std::array<float, 3> centre{};
  std::uint32_t cell = 0;
};

Lanes lower(const Lanes& a, const Lanes& b) { return a < b ? a : b; }
Lanes higher(const Lanes& a, const Lanes& b) { return a > b ? a : b; }

GroupBox merge(const GroupBox& a, const GroupBox& b) {
  return {lower(a.low_t0, b.low_t0), lower(a.low_t1, b.low_t1), higher(a.high_t0, b.high_t0),
          higher(a.high_t1, b.high_t1)};
}

GroupBox box_of(const std::array<VertexId, 3>& corners, const std::vector<MappedVertex>& mapped) {
  const MappedVertex &a = mapped[corners[0]], &b = mapped[corners[1]], &c = mapped[corners[2]];
  return {lower(a.t0, lower(b.t0, c.t0)), lower(a.t1, lower(b.t1, c.t1)), higher(a.t0, higher(b.t0, c.t0)),
          higher(a.t1, higher(b.t1, c.t1))};
}

/// Puts entries into the order of the leaves and fits the boxes.
class Builder {
 public:
  Builder(const Mesh& mesh, std::span<const Position> x_t0, std::span<const Position> x_t1, int dimension)
      : mesh_(mesh), dimension_(static_cast<std::size_t>(dimension)), mapped_(mesh.vertex_count) {
    for (std::size_t k = 0; k < dimension_; ++k) {
      const MonotoneMap at_t0 = map_for(x_t0, k), at_t1 = map_for(x_t1, k);
      unit_[k] = 1 / at_t0.scale + 1 / at_t1.scale;
      for (std::size_t v = 0; v < mapped_.size(); ++v) {
        mapped_[v].t0[k] = at_t0(x_t0[v][k]);
        mapped_[v].t1[k] = at_t1(x_t1[v][k]);
      }
    }
    fill_entries();
  }

  /// Splits one group once.
  void split(Group g) {
    const auto first = entries_.begin() + g.begin;
    const std::size_t axis = longest_axis(g);
    std::nth_element(first, first + g.count / 2, first + g.count, [axis](const Entry& a, const Entry& b) {
      return a.centre[axis] != b.centre[axis] ? a.centre[axis] < b.centre[axis] : a.cell < b.cell;
    });
  }

  /// Splits a group all the way down and fits its boxes.
  void finish(Group g, std::vector<GroupBox>& boxes) {
    if (g.is_leaf()) {
      boxes[g.node] = box_of(corners(mesh_, entries_[g.begin].cell), mapped_);
      return;
    }
    split(g);
    finish(g.left(), boxes);
    finish(g.right(), boxes);
    boxes[g.node] = merge(boxes[g.left().node], boxes[g.right().node]);
  }

  const std::vector<Entry>& entries() const { return entries_; }

 private:
  void fill_entries() {
    entries_.resize(mesh_.cell_count());
    for (std::uint32_t cell = 0; cell < entries_.size(); ++cell) {
      const GroupBox box = box_of(corners(mesh_, cell), mapped_);
      entries_[cell].cell = cell;
      for (std::size_t k = 0; k < dimension_; ++k) {
        entries_[cell].centre[k] = (box.low_t0[k] + box.high_t0[k]) + (box.low_t1[k] + box.high_t1[k]);
      }
    }
  }

  std::size_t longest_axis(Group g) const {
    std::array<float, 3> low = entries_[g.begin].centre, high = low;
    for (std::size_t i = g.begin; i < g.begin + g.count; ++i) {
      for (std::size_t k = 0; k < 3; ++k) {
        low[k] = std::min(low[k], entries_[i].centre[k]);
        high[k] = std::max(high[k], entries_[i].centre[k]);
      }
    }
    std::size_t best = 0;
    const auto extent = [&](std::size_t k) { return static_cast<double>(high[k] - low[k]) * unit_[k]; };
    for (std::size_t k = 1; k < dimension_; ++k) {
      if (extent(k) > extent(best)) best = k;
    }
    return best;
  }

  const Mesh& mesh_;
  std::size_t dimension_;
  std::array<double, 3> unit_{};
  std::vector<MappedVertex> mapped_;
  std::vector<Entry> entries_;
};

/// Groups of one level of the tree, until there are enough to share them out.
std::vector<Group> split_top(Builder& builder, Group root, std::size_t wanted, int threads, std::vector<Group>& inner) {
  std::vector<Group> level = {root};
  while (level.size() < wanted && level.back().count >= 64) {
    parallel_for(level.size(), threads, [&](std::size_t i) { builder.split(level[i]); });
    inner.insert(inner.end(), level.begin(), level.end());
    std::vector<Group> next;
    for (const Group g : level) {
      next.push_back(g.left());
      next.push_back(g.right());
    }
    level = std::move(next);
  }
  return level;
}

}  // namespace

std::array<double, 3> separating_axis(const GroupBox& a, const GroupBox& b) {
  for (std::size_t k = 0; k < 3; ++k) {
    std::array<double, 3> n{};
    n[k] = a.low_t0[k] > b.high_t0[k] && a.low_t1[k] > b.high_t1[k] ? 1 : -1;
    if (n[k] > 0 || (b.low_t0[k] > a.high_t0[k] && b.low_t1[k] > a.high_t1[k])) return n;
  }
  return {};
}

Hierarchy::Hierarchy(const Mesh& mesh, std::span<const Position> x_t0, std::span<const Position> x_t1, int dimension,
                     int threads)
    : leaf_cells_(mesh.cell_count()), boxes_(2 * mesh.cell_count() - 1) {
  Builder builder(mesh, x_t0, x_t1, dimension);
  std::vector<Group> inner;
  const std::vector<Group> level = split_top(builder, root(), 64, threads, inner);
  parallel_for(level.size(), threads, [&](std::size_t i) { builder.finish(level[i], boxes_); });
  for (auto g = inner.rbegin(); g != inner.rend(); ++g) {
    boxes_[g->node] = merge(boxes_[g->left().node], boxes_[g->right().node]);
  }
  for (std::size_t i = 0; i < leaf_cells_.size(); ++i) leaf_cells_[i] = builder.entries()[i].cell;
}

}  // namespace noli
