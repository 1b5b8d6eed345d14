// SPDX-License-Identifier: Apache-2.0
//
// Finds small pairs of features that no larger pair stands for.
//
// Notation
//   small pair   in 3D a vertex and an edge, or two vertices; in 2D two vertices; without a common vertex
//   left over    by two different cells: each cell has one of the two features. And a larger feature of one cell (an
//                edge; for a vertex against an edge, also a face) that contains one feature of the pair always has a
//                vertex of the other. So (c, ab) is left over by the loose edges ac and ab, but not by cd and ab, where
//                the edge_edge pair (cd, ab) stands for it; (p, q) is left over by two loose points p and q, but not by
//                p and the loose edge qr, where the vertex_edge pair (p, qr) stands for it
//
// Two cells that leave a pair over have only vertices of the pair: loose points, loose edges around one vertex, or
// faces that are listed twice, have a vertex twice, or have an edge or corner that is a loose cell too. A pair that any
// two cells leave over is counted once, at one pair of cells, which is found here.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include <noli/mesh.h>
#include <noli/query.h>

namespace noli {

/// A cell by its corners; a loose edge or point repeats its last one.
struct CellShape {
  std::array<VertexId, 3> vertices;
  std::uint8_t corners;  ///< 3, 2 or 1

  bool has(VertexId v) const { return vertices[0] == v || vertices[1] == v || vertices[2] == v; }
  unsigned edge_count() const { return corners == 3 ? 3 : corners - 1U; }
  std::array<VertexId, 2> edge(unsigned i) const { return {vertices[i], vertices[i == 2 ? 0 : i + 1]}; }
};

/// A vertex against an edge, or against another vertex, which is then twice in `other`.
struct SmallPair {
  FeaturePair pair;
  VertexId vertex;
  std::array<VertexId, 2> other;
  friend bool operator==(const SmallPair&, const SmallPair&) = default;
};

/// In canonical order: the edge ascending; the lesser vertex first.
SmallPair vertex_edge_pair(VertexId v, const std::array<VertexId, 2>& edge);
SmallPair vertex_vertex_pair(VertexId v, VertexId w);

/// Whether two cells have few enough vertices to leave anything over: at most three together.
inline bool few_vertices(const CellShape& a, const CellShape& b) {
  std::array<VertexId, 3> seen{};
  std::size_t count = 0;
  for (const CellShape* c : {&a, &b}) {
    for (const VertexId v : c->vertices) {
      bool known = false;
      for (std::size_t i = 0; i < count; ++i) known = known || seen[i] == v;
      if (known) continue;
      if (count == 3) return false;
      seen[count++] = v;
    }
  }
  return true;
}

/// Whether a vertex of a and an edge of b, or a vertex of a and one of b, are left over by a and b.
bool leaves_vertex_edge(const CellShape& a, VertexId v, const CellShape& b, const std::array<VertexId, 2>& edge);
bool leaves_vertex_vertex(const CellShape& a, VertexId v, const CellShape& b, VertexId w);

/// The cells at which the small pairs of a mesh are counted. The first question makes an index, in O(n log n) time and
/// memory linear in the cells.
class Leftovers {
 public:
  struct NumberedShape {
    CellShape shape;
    std::uint32_t cell;
  };
  using CellPair = std::pair<std::uint32_t, std::uint32_t>;

  /// `shape_of(i)` for i below `count`: the cells, in any order. It is called until this is destroyed, from any thread.
  Leftovers(std::size_t count, std::function<NumberedShape(std::size_t)> shape_of);

  /// The two cells, ascending, at which a pair is counted; nothing if no two cells leave it over. May be called from
  /// several threads at once.
  std::optional<CellPair> place_of(const SmallPair& pair) const;
  bool counted_at(const SmallPair& pair, std::uint32_t a, std::uint32_t b) const {
    return place_of(pair) == std::optional(CellPair(std::minmax(a, b)));
  }

 private:
  /// Number of corners and the vertices, ascending: cells with equal keys leave the same pairs over.
  using Key = std::array<VertexId, 4>;
  struct Entry {
    Key key;
    std::uint32_t cell;
  };
  struct Index {
    std::once_flag made;
    std::vector<Entry> entries;  ///< by key, then cell
  };

  static Key key_of(const CellShape& shape);
  static bool is_narrow(const Key& key);
  const std::vector<Entry>& entries(bool narrow) const;
  void add_alike(bool narrow, const Key& key, std::vector<NumberedShape>& cells) const;
  void add_narrow(const std::vector<VertexId>& vertices, std::vector<NumberedShape>& cells) const;

  std::size_t count_;
  std::function<NumberedShape(std::size_t)> shape_of_;
  mutable Index narrow_, wide_;  ///< cells with at most two different vertices; faces with three
};

}  // namespace noli
