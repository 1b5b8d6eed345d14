// SPDX-License-Identifier: Apache-2.0
#include "proofs/prover/hierarchy.h"

#include <algorithm>
#include <cmath>

#include "kernel/parallel.h"
#include "proofs/prover/cells/features.h"
#include "proofs/prover/median.h"

namespace noli {

namespace {

/// One map for each axis.
std::array<Phi, 3> maps_for(std::span<const Position> x) {
  Position low = x[0], high = x[0];
  for (const Position& p : x) {
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], p[k]);
      high[k] = std::max(high[k], p[k]);
    }
  }
  std::array<Phi, 3> maps;
  for (std::size_t k = 0; k < 3; ++k) maps[k] = Phi::onto_unit(low[k], high[k]);
  return maps;
}

/// phi of one vertex at both ends.
struct MappedVertex {
  Lanes t0 = {}, t1 = {};
};

GroupBox box_of(const std::array<VertexId, 3>& corners, const MappedVertex* mapped) {
  const MappedVertex &a = mapped[corners[0]], &b = mapped[corners[1]], &c = mapped[corners[2]];
  return {least(a.t0, least(b.t0, c.t0)), least(a.t1, least(b.t1, c.t1)), greatest(a.t0, greatest(b.t0, c.t0)),
          greatest(a.t1, greatest(b.t1, c.t1))};
}

/// Puts entries into the order of the leaves and fits the boxes.
class Builder {
 public:
  Builder(const Mesh& mesh, std::span<const Position> x_t0, std::span<const Position> x_t1, int dimension, int threads)
      : mesh_(mesh),
        dimension_(static_cast<std::size_t>(dimension)),
        mapped_(std::make_unique_for_overwrite<MappedVertex[]>(mesh.vertex_count)),
        entries_(std::make_unique_for_overwrite<Entry[]>(mesh.cell_count())) {
    std::array<std::array<Phi, 3>, 2> maps;
    parallel_for(2, threads, [&](std::size_t end) { maps[end] = maps_for(end == 0 ? x_t0 : x_t1); });
    for (std::size_t k = 0; k < dimension_; ++k) unit_[k] = 1 / maps[0][k].scale + 1 / maps[1][k].scale;
    for_each_in_pieces(mesh.vertex_count, threads, [&](std::size_t v) { mapped_[v] = map(maps, x_t0[v], x_t1[v]); });
    for_each_in_pieces(mesh.cell_count(), threads,
                       [&](std::size_t cell) { fill_entry(static_cast<std::uint32_t>(cell)); });
  }

  /// Splits one group once.
  void split(Group g) {
    Entry* const first = &entries_[g.begin];
    split_at(first, first + g.count / 2, first + g.count, longest_axis(g));
  }

  /// Splits a group down to its leaves, lists them and fits its boxes.
  void finish(Group g, std::uint32_t* leaf_cells, GroupBox* boxes) {
    if (g.is_leaf()) {
      const std::uint32_t cell = leaf_cells[g.begin] = cell_in(entries_[g.begin]);
      boxes[g.node] = box_of(corners(mesh_, cell), mapped_.get());
      return;
    }
    split(g);
    finish(g.left(), leaf_cells, boxes);
    finish(g.right(), leaf_cells, boxes);
    boxes[g.node] = merged(boxes[g.left().node], boxes[g.right().node]);
  }

 private:
  MappedVertex map(const std::array<std::array<Phi, 3>, 2>& maps, const Position& x_t0, const Position& x_t1) const {
    MappedVertex v;
    for (std::size_t k = 0; k < dimension_; ++k) {
      v.t0[k] = maps[0][k](x_t0[k]);
      v.t1[k] = maps[1][k](x_t1[k]);
    }
    return v;
  }

  void fill_entry(std::uint32_t cell) {
    const GroupBox box = box_of(corners(mesh_, cell), mapped_.get());
    const Lanes centre = (box.low_t0 + box.high_t0) + (box.low_t1 + box.high_t1);
    entries_[cell] = Entry{ordered(centre[0]), ordered(centre[1]), ordered(centre[2]), static_cast<std::int32_t>(cell)};
  }

  std::size_t longest_axis(Group g) const {
    Entry low = entries_[g.begin], high = low;
    for (const Entry& e : std::span(&entries_[g.begin], g.count)) {
      low = e < low ? e : low;
      high = e > high ? e : high;
    }
    std::size_t best = 0;
    const auto extent = [&](std::size_t k) {
      return static_cast<double>(from_ordered(high[k]) - from_ordered(low[k])) * unit_[k];
    };
    for (std::size_t k = 1; k < dimension_; ++k) {
      if (extent(k) > extent(best)) best = k;
    }
    return best;
  }

  const Mesh& mesh_;
  std::size_t dimension_;
  std::array<double, 3> unit_{};
  std::unique_ptr<MappedVertex[]> mapped_;
  std::unique_ptr<Entry[]> entries_;
};

}  // namespace

Phi Phi::onto_unit(double low, double high) {
  const double half = 0.5 * high - 0.5 * low;
  int exponent = 0;
  std::frexp(half, &exponent);
  return {0.5 * low + 0.5 * high, std::ldexp(1.0, std::clamp(-exponent, -1022, 1022))};
}

Hierarchy::Hierarchy(const Mesh& mesh, std::span<const Position> x_t0, std::span<const Position> x_t1, int dimension,
                     int threads)
    : count_(static_cast<std::uint32_t>(mesh.cell_count())),
      leaf_cells_(std::make_unique_for_overwrite<std::uint32_t[]>(count_)),
      boxes_(std::make_unique_for_overwrite<GroupBox[]>(2 * static_cast<std::size_t>(count_) - 1)) {
  Builder builder(mesh, x_t0, x_t1, dimension, threads);
  std::vector<Group> inner;
  const std::vector<Group> level = top_groups(root(), [&](const std::vector<Group>& above) {
    parallel_for(above.size(), threads, [&](std::size_t i) { builder.split(above[i]); });
    inner.insert(inner.end(), above.begin(), above.end());
  });
  parallel_for(level.size(), threads,
               [&](std::size_t i) { builder.finish(level[i], leaf_cells_.get(), boxes_.get()); });
  std::reverse(inner.begin(), inner.end());  // children before parents
  for (const Group g : inner) boxes_[g.node] = merged(boxes_[g.left().node], boxes_[g.right().node]);
}

}  // namespace noli
