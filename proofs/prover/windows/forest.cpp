// SPDX-License-Identifier: Apache-2.0
#include "proofs/prover/windows/forest.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "proofs/prover/tokens/tokens.h"
#include "proofs/prover/windows/layout.h"

namespace noli {

namespace {

/// Smaller parts gain nothing from a tree of their own. The number of parts is limited, as every pair of trees is
/// tested.
constexpr std::size_t least_part = 32;
constexpr std::size_t most_parts = 256;

/// The input of the median split.
struct Entry {
  std::array<float, 3> centre{};
  std::uint32_t cell = 0;
};
using Entries = std::span<Entry>;

float rounded(double x) {
  constexpr double most = std::numeric_limits<float>::max();
  return static_cast<float>(std::clamp(x, -most, most));
}

/// Positions scaled into [-1, 1], by the same factor on all axes.
std::vector<std::array<double, 3>> scaled(std::span<const Position> x) {
  std::array<double, 3> middle{};
  double most = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto [low, high] = std::minmax_element(x.begin(), x.end(), [k](auto& p, auto& q) { return p[k] < q[k]; });
    middle[k] = 0.5 * (*low)[k] + 0.5 * (*high)[k];
    most = std::max(most, 0.5 * (*high)[k] - 0.5 * (*low)[k]);
  }
  int exponent = 0;
  std::frexp(most, &exponent);
  const double scale = std::ldexp(1.0, std::clamp(-exponent, -1022, 1022));
  std::vector<std::array<double, 3>> result(x.size());
  for (std::size_t v = 0; v < x.size(); ++v) {
    for (std::size_t k = 0; k < 3; ++k) result[v][k] = (x[v][k] - middle[k]) * scale;
  }
  return result;
}

std::size_t longest_axis(Entries entries) {
  std::array<float, 3> low = entries[0].centre, high = low;
  for (const Entry& e : entries) {
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], e.centre[k]);
      high[k] = std::max(high[k], e.centre[k]);
    }
  }
  std::size_t best = 0;
  for (std::size_t k = 1; k < 3; ++k) {
    if (high[k] - low[k] > high[best] - low[best]) best = k;
  }
  return best;
}

/// Puts entries into the order of the leaves: each group split at the median of the centres along its longest axis.
void sort_leaves(Entries entries) {
  if (entries.size() < 2) return;
  const std::size_t axis = longest_axis(entries), half = entries.size() / 2;
  std::nth_element(entries.begin(), entries.begin() + static_cast<std::ptrdiff_t>(half), entries.end(),
                   [axis](const Entry& a, const Entry& b) {
                     return a.centre[axis] != b.centre[axis] ? a.centre[axis] < b.centre[axis] : a.cell < b.cell;
                   });
  sort_leaves(entries.first(half));
  sort_leaves(entries.subspan(half));
}

template <class Place>
Entry entry_of(const Mesh& mesh, std::uint32_t cell, std::size_t axes, const Place& place) {
  Entry entry{{}, cell};
  for (const VertexId v : corners(mesh, cell)) {
    for (std::size_t k = 0; k < axes; ++k) entry.centre[k] += rounded(place(v)[k] / 3);
  }
  return entry;
}

float below(double x) { return std::nextafter(static_cast<float>(x), -std::numeric_limits<float>::max()); }
float above(double x) { return std::nextafter(static_cast<float>(x), std::numeric_limits<float>::max()); }

Extent extent_of(const std::array<VertexId, 3>& v, std::span<const Point2> r) {
  return {below(std::min({r[v[0]][0], r[v[1]][0], r[v[2]][0]})), below(std::min({r[v[0]][1], r[v[1]][1], r[v[2]][1]})),
          above(std::max({r[v[0]][0], r[v[1]][0], r[v[2]][0]})), above(std::max({r[v[0]][1], r[v[1]][1], r[v[2]][1]}))};
}

/// For each vertex the length of the shortest edge of a cell at it; infinite if there is none.
std::vector<float> sizes_of(const Mesh& mesh, std::span<const Position> x, int dimension) {
  std::vector<float> size(x.size(), std::numeric_limits<float>::infinity());
  const auto add = [&](VertexId a, VertexId b) {
    double square = 0;
    for (int k = 0; k < dimension; ++k) {
      const double d = x[a][static_cast<std::size_t>(k)] - x[b][static_cast<std::size_t>(k)];
      square += d * d;
    }
    const auto length = static_cast<float>(std::sqrt(square));
    size[a] = std::min(size[a], length);
    size[b] = std::min(size[b], length);
  };
  for (const auto& [a, b, c] : mesh.faces) {
    add(a, b);
    add(b, c);
    add(c, a);
  }
  for (const auto& [a, b] : mesh.edges) add(a, b);
  return size;
}

/// Sheets and other parts, at most `most_parts` of them.
Sheets parts_of(const Mesh& mesh, std::span<const Position> x, int dimension) {
  Sheets parts = find_sheets(mesh, x, dimension, least_part);
  parts.faces.resize(std::min(parts.faces.size(), most_parts));
  parts.others.resize(std::min(parts.others.size(), most_parts - parts.faces.size()));
  return parts;
}

/// The cells that are in no part.
std::vector<std::uint32_t> rest_of(const Mesh& mesh, const Sheets& parts) {
  std::vector<bool> taken(mesh.cell_count(), false);
  for (const auto* list : {&parts.faces, &parts.others}) {
    for (const auto& faces : *list) {
      for (const std::uint32_t f : faces) taken[f] = true;
    }
  }
  std::vector<std::uint32_t> result;
  for (std::uint32_t cell = 0; cell < taken.size(); ++cell) {
    if (!taken[cell]) result.push_back(cell);
  }
  return result;
}

CellLabels labels_of(const Mesh& mesh, const WindowOptions& options) {
  if (options.labels != nullptr) return *options.labels;
  const Exclusions none;
  return labels_of_run(mesh, options.scripted, options.exclusions != nullptr ? *options.exclusions : none);
}

/// Whether each cell is scripted. `labels`: of a run.
std::vector<bool> scripted_cells(const CellLabels& labels) {
  std::vector<bool> scripted(labels.of.size());
  for (std::size_t cell = 0; cell < scripted.size(); ++cell) scripted[cell] = labels.of[cell] % 2 == 1;
  return scripted;
}

}  // namespace

Forest::Forest(const Mesh& mesh, std::span<const Position> x, const WindowOptions& options)
    : cell_labels_(labels_of(mesh, options)),
      leftovers_(mesh.cell_count(),
                 [this](std::size_t i) {
                   return Leftovers::NumberedShape{shape_of(leaves_[i]), leaves_[i].cell};
                 }),
      part_of_(mesh.vertex_count, no_part),
      sizes_(sizes_of(mesh, x, options.dimension)) {
  const CellFeatures features =
      find_owners(mesh, options.strict, options.labels == nullptr ? scripted_cells(cell_labels_) : std::vector<bool>());

  const Sheets parts = parts_of(mesh, x, options.dimension);
  const std::vector<std::uint32_t> rest = rest_of(mesh, parts);
  const auto places = scaled(x);
  const auto axes = static_cast<std::size_t>(options.dimension);
  std::vector<Entry> entries;
  const auto grow = [&](const std::vector<std::uint32_t>& cells, bool sheet, bool part) {
    const std::size_t begin = entries.size();
    for (const std::uint32_t cell : cells) {
      entries.push_back(sheet ? entry_of(mesh, cell, 2, [&](VertexId v) { return parts.layout[v]; })
                              : entry_of(mesh, cell, axes, [&](VertexId v) { return places[v]; }));
    }
    sort_leaves(Entries(entries).subspan(begin));
    for (std::size_t i = begin; i < entries.size(); ++i) {
      const std::uint32_t cell = entries[i].cell;
      leaves_.push_back({indices_of(mesh, features, cell), cell_labels_.of[cell]});
    }
    add_tree(sheet, part, begin);
  };
  for (const auto& faces : parts.faces) grow(faces, true, true);
  for (const Leaf& leaf : leaves_) {
    const auto& v = leaf.vertices;
    laid_faces_.push_back(noli::laid_face(v, parts.layout[v[0]], parts.layout[v[1]], parts.layout[v[2]]));
  }
  for (const auto& faces : parts.others) grow(faces, false, true);
  if (!rest.empty()) grow(rest, false, false);
  for (const Tree& tree : trees_) finish(tree.root, parts.layout, tree.sheet);
  make_charts(mesh, x, options.dimension);
}

std::string Forest::encoded() const {
  std::vector<std::string> trees;
  std::vector<std::uint32_t> cells;
  for (const Tree& tree : trees_) {
    cells.clear();
    for (std::uint32_t i = 0; i < tree.root.count; ++i) cells.push_back(leaves_[tree.root.begin + i].cell);
    trees.push_back(encoded_tree(cells));
  }
  return encoded_join(trees);
}

const Tree* Forest::part_of(Group a, Group b) const {
  const auto tree = std::upper_bound(trees_.begin(), trees_.end(), a.begin,
                                     [](std::uint32_t leaf, const Tree& t) { return leaf < t.root.begin; }) -
                    1;
  const bool both = b.begin >= tree->root.begin && b.begin < tree->root.begin + tree->root.count;
  return both && tree->part ? &*tree : nullptr;
}

void Forest::make_charts(const Mesh& mesh, std::span<const Position> x, int dimension) {
  std::vector<std::uint32_t> cells;
  for (const Leaf& leaf : leaves_) cells.push_back(leaf.cell);
  std::vector<Group> roots;
  for (const Tree& tree : trees_) {
    if (tree.part && !tree.sheet) roots.push_back(tree.root);
  }
  charts_.emplace(mesh, x, dimension, cells, roots);
}

void Forest::add_tree(bool sheet, bool part, std::size_t begin) {
  const std::size_t count = leaves_.size() - begin;
  const Group root = {static_cast<std::uint32_t>(labels_.size()), static_cast<std::uint32_t>(begin),
                      static_cast<std::uint32_t>(count)};
  Tree tree{root, sheet, part, {}};
  labels_.resize(labels_.size() + 2 * count - 1);
  if (sheet) extents_.resize(labels_.size());
  for (std::size_t i = begin; i < leaves_.size(); ++i) {
    tree.vertices.insert(tree.vertices.end(), leaves_[i].vertices.begin(), leaves_[i].vertices.end());
  }
  std::sort(tree.vertices.begin(), tree.vertices.end());
  tree.vertices.erase(std::unique(tree.vertices.begin(), tree.vertices.end()), tree.vertices.end());
  for (const VertexId v : tree.vertices) {
    if (part) part_of_[v] = static_cast<std::uint32_t>(trees_.size());
  }
  trees_.push_back(std::move(tree));
}

void Forest::finish(Group g, std::span<const Point2> layout, bool sheet) {
  if (g.is_leaf()) {
    labels_[g.node] = leaf(g).label;
    if (sheet) extents_[g.node] = extent_of(leaf(g).vertices, layout);
    return;
  }
  finish(g.left(), layout, sheet);
  finish(g.right(), layout, sheet);
  const std::uint32_t left = labels_[g.left().node], right = labels_[g.right().node];
  labels_[g.node] = left == right ? left : no_label;
  if (sheet) extents_[g.node] = merged(extent(g.left()), extent(g.right()));
}

}  // namespace noli
