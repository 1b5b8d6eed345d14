// SPDX-License-Identifier: Apache-2.0
#include "proofs/prover/cells/leftover.h"

#include <algorithm>

#include "trajectory/cell_features.h"

namespace noli {

namespace {

/// Whether c has an edge with v and without both p and q.
bool edge_beside(const CellShape& c, VertexId v, VertexId p, VertexId q) {
  for (unsigned i = 0; i < c.edge_count(); ++i) {
    const auto [x, y] = c.edge(i);
    if ((x == v || y == v) && x != p && x != q && y != p && y != q) return true;
  }
  return false;
}

bool has_edge(const CellShape& c, const std::array<VertexId, 2>& ascending) {
  for (unsigned i = 0; i < c.edge_count(); ++i) {
    const auto [x, y] = c.edge(i);
    if (std::min(x, y) == ascending[0] && std::max(x, y) == ascending[1]) return true;
  }
  return false;
}

/// Whether the first feature is on a, the second on b, and the pair is left over.
bool leaves_in_order(const CellShape& a, const CellShape& b, const SmallPair& pair) {
  if (!a.has(pair.vertex)) return false;
  if (pair.pair == FeaturePair::vertex_vertex) {
    return b.has(pair.other[0]) && leaves_vertex_vertex(a, pair.vertex, b, pair.other[0]);
  }
  return has_edge(b, pair.other) && leaves_vertex_edge(a, pair.vertex, b, pair.other);
}

/// The first two different cells that leave the pair over. Sorts the cells.
std::optional<Leftovers::CellPair> least_of(std::vector<Leftovers::NumberedShape>& cells, const SmallPair& pair) {
  std::sort(cells.begin(), cells.end(), [](const auto& a, const auto& b) { return a.cell < b.cell; });
  for (std::size_t i = 0; i < cells.size(); ++i) {
    for (std::size_t j = i + 1; j < cells.size(); ++j) {
      const CellShape &a = cells[i].shape, &b = cells[j].shape;
      if (leaves_in_order(a, b, pair) || leaves_in_order(b, a, pair)) {
        return Leftovers::CellPair(cells[i].cell, cells[j].cell);
      }
    }
  }
  return std::nullopt;
}

std::vector<VertexId> vertices_of(const SmallPair& pair) {
  std::vector<VertexId> vertices = {pair.vertex, pair.other[0], pair.other[1]};
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  return vertices;
}

}  // namespace

SmallPair vertex_edge_pair(VertexId v, const std::array<VertexId, 2>& edge) {
  return {FeaturePair::vertex_edge, v, {std::min(edge[0], edge[1]), std::max(edge[0], edge[1])}};
}

SmallPair vertex_vertex_pair(VertexId v, VertexId w) {
  return {FeaturePair::vertex_vertex, std::min(v, w), {std::max(v, w), std::max(v, w)}};
}

bool leaves_vertex_edge(const CellShape& a, VertexId v, const CellShape& b, const std::array<VertexId, 2>& edge) {
  if (v == edge[0] || v == edge[1] || edge_beside(a, v, edge[0], edge[1])) return false;
  return b.corners < 3 || b.has(v);
}

bool leaves_vertex_vertex(const CellShape& a, VertexId v, const CellShape& b, VertexId w) {
  return v != w && !edge_beside(a, v, w, w) && !edge_beside(b, w, v, v);
}

Leftovers::Leftovers(std::size_t count, std::function<NumberedShape(std::size_t)> shape_of)
    : count_(count), shape_of_(std::move(shape_of)) {}

std::optional<Leftovers::CellPair> Leftovers::place_of(const SmallPair& pair) const {
  const std::vector<VertexId> vertices = vertices_of(pair);
  std::vector<NumberedShape> cells;
  add_narrow(vertices, cells);
  const auto narrow = least_of(cells, pair);
  if (narrow || vertices.size() < 3) return narrow;
  add_alike(false, {3, vertices[0], vertices[1], vertices[2]}, cells);
  return least_of(cells, pair);
}

Leftovers::Key Leftovers::key_of(const CellShape& shape) {
  const auto [x, y, z] = ascending(shape.vertices, shape.corners);
  return {shape.corners, x, y, z};
}

bool Leftovers::is_narrow(const Key& key) { return key[1] == key[2] || key[2] == key[3]; }

const std::vector<Leftovers::Entry>& Leftovers::entries(bool narrow) const {
  Index& index = narrow ? narrow_ : wide_;
  std::call_once(index.made, [&] {
    index.entries.clear();  // a thread that ran out of memory may have left some
    for (std::size_t i = 0; i < count_; ++i) {
      const NumberedShape cell = shape_of_(i);
      const Key key = key_of(cell.shape);
      if (is_narrow(key) == narrow) index.entries.push_back({key, cell.cell});
    }
    std::sort(index.entries.begin(), index.entries.end(),
              [](const Entry& a, const Entry& b) { return a.key != b.key ? a.key < b.key : a.cell < b.cell; });
  });
  return index.entries;
}

/// Adds the first two of the cells that have this key: further ones leave nothing else over.
void Leftovers::add_alike(bool narrow, const Key& key, std::vector<NumberedShape>& cells) const {
  const std::vector<Entry>& all = entries(narrow);
  auto at = std::lower_bound(all.begin(), all.end(), key, [](const Entry& e, const Key& k) { return e.key < k; });
  for (int n = 0; n < 2 && at != all.end() && at->key == key; ++n, ++at) {
    cells.push_back({{{key[1], key[2], key[3]}, static_cast<std::uint8_t>(key[0])}, at->cell});
  }
}

/// Adds cells with at most two different vertices, all of them in `vertices`.
void Leftovers::add_narrow(const std::vector<VertexId>& vertices, std::vector<NumberedShape>& cells) const {
  for (const VertexId v : vertices) {
    for (const VertexId corners : {1U, 2U, 3U}) add_alike(true, {corners, v, v, v}, cells);
  }
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    for (std::size_t j = i + 1; j < vertices.size(); ++j) {
      const VertexId v = vertices[i], w = vertices[j];
      for (const Key& key : {Key{2, v, w, w}, Key{3, v, v, w}, Key{3, v, w, w}}) add_alike(true, key, cells);
    }
  }
}

}  // namespace noli
