// SPDX-License-Identifier: Apache-2.0
#include "proofs/prover/hierarchy.h"

#include <algorithm>
#include <cmath>

#include "kernel/parallel.h"
#include "proofs/prover/median.h"
#include "trajectory/cell_features.h"

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

GroupBox box_around(const std::array<VertexId, 3>& corners, const MappedVertex* mapped) {
  const MappedVertex &a = mapped[corners[0]], &b = mapped[corners[1]], &c = mapped[corners[2]];
  return {least(a.t0, least(b.t0, c.t0)), least(a.t1, least(b.t1, c.t1)), greatest(a.t0, greatest(b.t0, c.t0)),
          greatest(a.t1, greatest(b.t1, c.t1))};
}

}  // namespace

Phi Phi::onto_unit(double low, double high) {
  const double half = 0.5 * high - 0.5 * low;
  int exponent = 0;
  std::frexp(half, &exponent);
  return {0.5 * low + 0.5 * high, std::ldexp(1.0, std::clamp(-exponent, -1022, 1022))};
}

/// Fits boxes to the positions of a step.
class Hierarchy::Fit {
 public:
  Fit(const Mesh& mesh, std::span<const Position> x_t0, std::span<const Position> x_t1, int dimension, int threads)
      : mesh_(mesh), mapped_(std::make_unique_for_overwrite<MappedVertex[]>(mesh.vertex_count)) {
    std::array<std::array<Phi, 3>, 2> maps;
    parallel_for(2, threads, [&](std::size_t end) { maps[end] = maps_for(end == 0 ? x_t0 : x_t1); });
    for (std::size_t k = 0; k < static_cast<std::size_t>(dimension); ++k) {
      unit_t0_[k] = static_cast<float>(maps[1][k].scale / maps[0][k].scale);
      unit_[k] = 1 / maps[0][k].scale + 1 / maps[1][k].scale;
    }
    for_each_in_pieces(mesh.vertex_count, threads,
                       [&](std::size_t v) { mapped_[v] = map(maps, x_t0[v], x_t1[v], dimension); });
  }

  GroupBox box_of_cell(std::uint32_t cell) const { return box_around(corners(mesh_, cell), mapped_.get()); }
  double unit(std::size_t axis) const { return unit_[axis]; }

  /// Fits the boxes of a group and all below it; returns the sum of their extents.
  double fit(Group g, const std::uint32_t* leaf_cells, GroupBox* boxes) const {
    if (g.is_leaf()) {
      boxes[g.node] = box_of_cell(leaf_cells[g.begin]);
      return extent(boxes[g.node]);
    }
    const double left = fit(g.left(), leaf_cells, boxes), right = fit(g.right(), leaf_cells, boxes);
    return left + right + join(g, boxes);
  }

  /// The box of a group whose children have theirs; returns its extent.
  double join(Group g, GroupBox* boxes) const {
    boxes[g.node] = merged(boxes[g.left().node], boxes[g.right().node]);
    return extent(boxes[g.node]);
  }

  /// In the unit of phi at the end of the step.
  double extent(const GroupBox& box) const {
    const Lanes sides = (box.high_t0 - box.low_t0) * unit_t0_ + (box.high_t1 - box.low_t1);
    return static_cast<double>(sides[0] + sides[1] + sides[2]);
  }

 private:
  static MappedVertex map(const std::array<std::array<Phi, 3>, 2>& maps, const Position& x_t0, const Position& x_t1,
                          int dimension) {
    MappedVertex v;
    for (std::size_t k = 0; k < static_cast<std::size_t>(dimension); ++k) {
      v.t0[k] = maps[0][k](x_t0[k]);
      v.t1[k] = maps[1][k](x_t1[k]);
    }
    return v;
  }

  const Mesh& mesh_;
  Lanes unit_t0_ = {};  ///< a length of phi at the beginning, in that of the end
  std::array<double, 3> unit_{};
  std::unique_ptr<MappedVertex[]> mapped_;
};

/// Puts entries into the order of the leaves.
class Hierarchy::Builder {
 public:
  Builder(const Mesh& mesh, const Fit& fit, int dimension, int threads)
      : fit_(fit),
        dimension_(static_cast<std::size_t>(dimension)),
        entries_(std::make_unique_for_overwrite<Entry[]>(mesh.cell_count())) {
    for_each_in_pieces(mesh.cell_count(), threads,
                       [&](std::size_t cell) { fill_entry(static_cast<std::uint32_t>(cell)); });
  }

  /// Splits one group once.
  void split(Group g) {
    Entry* const first = &entries_[g.begin];
    split_at(first, first + g.count / 2, first + g.count, longest_axis(g));
  }

  /// Splits a group down to its leaves, lists them and fits its boxes; returns the sum of their extents.
  double finish(Group g, std::uint32_t* leaf_cells, GroupBox* boxes) {
    if (g.is_leaf()) {
      leaf_cells[g.begin] = cell_in(entries_[g.begin]);
      return fit_.fit(g, leaf_cells, boxes);
    }
    split(g);
    const double left = finish(g.left(), leaf_cells, boxes), right = finish(g.right(), leaf_cells, boxes);
    return left + right + fit_.join(g, boxes);
  }

 private:
  void fill_entry(std::uint32_t cell) {
    const GroupBox box = fit_.box_of_cell(cell);
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
      return static_cast<double>(from_ordered(high[k]) - from_ordered(low[k])) * fit_.unit(k);
    };
    for (std::size_t k = 1; k < dimension_; ++k) {
      if (extent(k) > extent(best)) best = k;
    }
    return best;
  }

  const Fit& fit_;
  std::size_t dimension_;
  std::unique_ptr<Entry[]> entries_;
};

Hierarchy::Hierarchy(const Mesh& mesh, std::span<const Position> x_t0, std::span<const Position> x_t1, int dimension,
                     int threads)
    : count_(static_cast<std::uint32_t>(mesh.cell_count())),
      leaf_cells_(std::make_unique_for_overwrite<std::uint32_t[]>(count_)),
      boxes_(std::make_unique_for_overwrite<GroupBox[]>(2 * static_cast<std::size_t>(count_) - 1)) {
  build(mesh, Fit(mesh, x_t0, x_t1, dimension, threads), dimension, threads);
}

bool Hierarchy::refit(const Mesh& mesh, std::span<const Position> x_t0, std::span<const Position> x_t1, int dimension,
                      int threads) {
  // Measured on simulated cloth and a sheet that folds: docs/reference/performance.md.
  constexpr double too_large = 1.1;
  const Fit fit(mesh, x_t0, x_t1, dimension, threads);
  const double size = fit_groups(
      fit, threads, [](const std::vector<Group>& /*above*/) {},
      [&](Group g) { return fit.fit(g, leaf_cells_.get(), boxes_.get()); });
  if (size <= too_large * size_) return true;
  build(mesh, fit, dimension, threads);
  return false;
}

void Hierarchy::build(const Mesh& mesh, const Fit& fit, int dimension, int threads) {
  Builder builder(mesh, fit, dimension, threads);
  size_ = fit_groups(
      fit, threads,
      [&](const std::vector<Group>& above) {
        parallel_for(above.size(), threads, [&](std::size_t i) { builder.split(above[i]); });
      },
      [&](Group g) { return builder.finish(g, leaf_cells_.get(), boxes_.get()); });
}

template <class AtLevel, class FitGroup>
double Hierarchy::fit_groups(const Fit& fit, int threads, const AtLevel& at_level, const FitGroup& fit_group) {
  std::vector<Group> inner;
  const std::vector<Group> level = top_groups(root(), [&](const std::vector<Group>& above) {
    at_level(above);
    inner.insert(inner.end(), above.begin(), above.end());
  });
  std::vector<double> extents(level.size());
  parallel_for(level.size(), threads, [&](std::size_t i) { extents[i] = fit_group(level[i]); });
  double sum = 0;  // in one order, for any number of threads
  for (const double extent : extents) sum += extent;
  std::reverse(inner.begin(), inner.end());  // children before parents
  for (const Group g : inner) sum += fit.join(g, boxes_.get());
  const double whole = fit.extent(boxes_[0]);
  return whole > 0 ? sum / whole : 0;
}

}  // namespace noli
