// SPDX-License-Identifier: Apache-2.0
#include "brute_force.h"

#include <algorithm>
#include <iterator>

#include "hulls.h"

namespace noli::testing {

namespace {

using Edge = std::pair<VertexId, VertexId>;
using Cell = std::vector<VertexId>;

Cell cell_of(const Mesh& mesh, std::size_t i) {
  if (i < mesh.faces.size()) return {mesh.faces[i].begin(), mesh.faces[i].end()};
  i -= mesh.faces.size();
  if (i < mesh.edges.size()) return {mesh.edges[i].begin(), mesh.edges[i].end()};
  return {mesh.points[i - mesh.edges.size()]};
}

std::vector<Cell> cells_of(const Mesh& mesh) {
  std::vector<Cell> cells;
  for (std::size_t i = 0; i < mesh.cell_count(); ++i) cells.push_back(cell_of(mesh, i));
  return cells;
}

std::set<Edge> edges_of(const Cell& cell) {
  std::set<Edge> edges;
  if (cell.size() == 2) edges.insert(std::minmax(cell[0], cell[1]));
  for (std::size_t i = 0; cell.size() == 3 && i < 3; ++i) edges.insert(std::minmax(cell[i], cell[(i + 1) % 3]));
  return edges;
}

bool has(const Edge& e, VertexId v) { return e.first == v || e.second == v; }

/// The cells that contain each vertex and each edge.
struct Incidences {
  std::map<VertexId, std::set<std::size_t>> of_vertex;
  std::map<Edge, std::set<std::size_t>> of_edge;

  explicit Incidences(const Mesh& mesh) {
    const auto cells = cells_of(mesh);
    for (std::size_t i = 0; i < cells.size(); ++i) {
      for (const VertexId v : cells[i]) of_vertex[v].insert(i);
      for (const Edge& e : edges_of(cells[i])) of_edge[e].insert(i);
    }
  }
};

/// Whether the sets contain two different cells, one in each.
bool two_different(const std::set<std::size_t>& a, const std::set<std::size_t>& b) {
  return a.size() > 1 || b.size() > 1 || *a.begin() != *b.begin();
}

PairKey vertex_edge(VertexId v, const Edge& e) {
  return canonical_key(FeaturePair::vertex_edge, {v, e.first, e.second, 0});
}

PairKey vertex_vertex(VertexId v, VertexId w) { return canonical_key(FeaturePair::vertex_vertex, {v, w, 0, 0}); }

void add_pairs_3d(const Mesh& mesh, std::map<PairKey, int>& pairs) {
  const Incidences incidences(mesh);
  for (const auto& f : mesh.faces) {
    for (const auto& [v, cells] : incidences.of_vertex) {
      if (v != f[0] && v != f[1] && v != f[2]) ++pairs[{FeaturePair::vertex_face, {v, f[0], f[1], f[2]}}];
    }
  }
  for (const auto& [e, cells] : incidences.of_edge) {
    for (const auto& [g, others] : incidences.of_edge) {
      if (e < g && !has(e, g.first) && !has(e, g.second)) {
        ++pairs[canonical_key(FeaturePair::edge_edge, {e.first, e.second, g.first, g.second})];
      }
    }
  }
}

void add_pairs_2d(const Mesh& mesh, bool strict, std::map<PairKey, int>& pairs) {
  const Incidences incidences(mesh);
  for (const auto& [v, cells] : incidences.of_vertex) {
    for (const auto& [e, others] : incidences.of_edge) {
      if (!has(e, v) && (strict || two_different(cells, others))) ++pairs[vertex_edge(v, e)];
    }
  }
}

/// A vertex, edge or face of a cell: 1, 2 or 3 vertices, perhaps with repetitions.
using Simplex = std::vector<VertexId>;

std::vector<Simplex> features_of(const Cell& cell) {
  std::vector<Simplex> features;
  for (const VertexId v : std::set(cell.begin(), cell.end())) features.push_back({v});
  for (const Edge& e : edges_of(cell)) features.push_back({e.first, e.second});
  if (cell.size() == 3) features.push_back(cell);
  return features;
}

bool within(const Simplex& part, const Simplex& whole) {
  return std::all_of(part.begin(), part.end(),
                     [&](VertexId v) { return std::find(whole.begin(), whole.end(), v) != whole.end(); });
}

bool disjoint(const Simplex& x, const Simplex& y) {
  return std::none_of(x.begin(), x.end(), [&](VertexId v) { return within({v}, y); });
}

using SimplexPairs = std::vector<std::pair<Simplex, Simplex>>;

/// All pairs of a feature of a and a feature of b without a common vertex.
SimplexPairs disjoint_pairs(const Cell& a, const Cell& b) {
  SimplexPairs pairs;
  for (const Simplex& x : features_of(a)) {
    for (const Simplex& y : features_of(b)) {
      if (disjoint(x, y)) pairs.emplace_back(x, y);
    }
  }
  return pairs;
}

/// Whether a pair of features with more points than x and y together contains x in its first feature and y in its
/// second.
bool stood_for(const Simplex& x, const Simplex& y, const SimplexPairs& pairs) {
  return std::any_of(pairs.begin(), pairs.end(), [&](const auto& p) {
    return p.first.size() + p.second.size() > x.size() + y.size() && p.first.size() >= x.size() &&
           p.second.size() >= y.size() && within(x, p.first) && within(y, p.second);
  });
}

/// Adds vertex-edge pairs (in 3D) and vertex-vertex pairs that no larger pair of the same cells covers.
void add_small_pairs(const Cell& a, const Cell& b, int dimension, std::set<PairKey>& small) {
  const SimplexPairs pairs = disjoint_pairs(a, b);
  for (const auto& [x, y] : pairs) {
    if (x.size() + y.size() > (dimension == 3 ? 3 : 2) || stood_for(x, y, pairs)) continue;
    const Simplex &v = x.size() == 1 ? x : y, &other = x.size() == 1 ? y : x;
    small.insert(other.size() == 1 ? vertex_vertex(v[0], other[0]) : vertex_edge(v[0], {other[0], other[1]}));
  }
}

void add_small_pairs(const Mesh& mesh, int dimension, std::map<PairKey, int>& pairs) {
  const auto cells = cells_of(mesh);
  std::set<PairKey> small;
  for (std::size_t b = 0; b < cells.size(); ++b) {
    for (std::size_t a = 0; a < b; ++a) add_small_pairs(cells[a], cells[b], dimension, small);
  }
  for (const PairKey& key : small) ++pairs[key];
}

/// Adds the pairs of features within one cell.
void add_strict(const Mesh& mesh, int dimension, std::map<PairKey, int>& pairs) {
  std::set<Cell> seen;
  for (Cell cell : cells_of(mesh)) {
    std::sort(cell.begin(), cell.end());
    if (!seen.insert(cell).second) continue;
    // A pair that already occurs between two cells is not counted again.
    if (cell.size() == 2 && cell[0] != cell[1]) pairs[vertex_vertex(cell[0], cell[1])] = 1;
    for (const VertexId v : std::set(cell.begin(), cell.end())) {
      for (const Edge& e : edges_of(cell)) {
        if (cell.size() == 3 && dimension == 3 && !has(e, v)) pairs[vertex_edge(v, e)] = 1;
      }
    }
  }
}

/// The vertices of a cell selected by the bits of `mask`.
Cell part_of(const Cell& cell, unsigned mask) {
  Cell part;
  for (std::size_t i = 0; i < cell.size(); ++i) {
    if ((mask >> i & 1) != 0) part.push_back(cell[i]);
  }
  return part;
}

/// The vertices of b that are not in a.
Cell without(const Cell& b, const Cell& a) {
  Cell rest;
  std::copy_if(b.begin(), b.end(), std::back_inserter(rest),
               [&](VertexId v) { return std::find(a.begin(), a.end(), v) == a.end(); });
  return rest;
}

std::vector<Position> at_begin(const Step& step, int dimension, const Cell& part) {
  std::vector<Position> points;
  for (const VertexId v : part) {
    points.push_back(step.x_t0[v]);
    if (dimension == 2) points.back()[2] = 0;
  }
  return points;
}

/// Tests each part of a against the largest vertex-disjoint part of b, whose hull contains the smaller ones.
bool cells_meet(const Step& step, int dimension, const Cell& a, const Cell& b) {
  for (unsigned i = 1; i < 1U << a.size(); ++i) {
    const Cell p = part_of(a, i), q = without(b, p);
    if (hulls_meet(at_begin(step, dimension, p), at_begin(step, dimension, q))) return true;
  }
  return false;
}

/// The pair as input for the contact oracle. Nullopt for an edge or face against a face, and for two edges in 2D: these
/// meet at the beginning, or first where their smaller features meet.
std::optional<PairKey> decidable_key(const Simplex& x, const Simplex& y, int dimension) {
  if (x.size() > y.size()) return decidable_key(y, x, dimension);
  if (x.size() == 1 && y.size() == 1) return vertex_vertex(x[0], y[0]);
  if (x.size() == 1 && y.size() == 2) return vertex_edge(x[0], {y[0], y[1]});
  if (dimension == 2) return std::nullopt;
  if (x.size() == 1) return PairKey{FeaturePair::vertex_face, {x[0], y[0], y[1], y[2]}};
  if (y.size() == 2) return canonical_key(FeaturePair::edge_edge, {x[0], x[1], y[0], y[1]});
  return std::nullopt;
}

}  // namespace

PairKey key_of(const FeatureContact& contact) { return {contact.pair, contact.vertices}; }

PairKey canonical_key(FeaturePair pair, std::array<VertexId, 4> v) {
  if (pair == FeaturePair::vertex_edge && v[2] < v[1]) std::swap(v[1], v[2]);
  if (pair == FeaturePair::vertex_vertex && v[1] < v[0]) std::swap(v[0], v[1]);
  if (pair == FeaturePair::edge_edge) {
    if (v[1] < v[0]) std::swap(v[0], v[1]);
    if (v[3] < v[2]) std::swap(v[2], v[3]);
    if (Edge(v[2], v[3]) < Edge(v[0], v[1])) v = {v[2], v[3], v[0], v[1]};
  }
  return {pair, v};
}

std::map<PairKey, int> all_pairs(const Mesh& mesh, int dimension, bool strict) {
  std::map<PairKey, int> pairs;
  if (dimension == 3) {
    add_pairs_3d(mesh, pairs);
  } else {
    add_pairs_2d(mesh, strict, pairs);
  }
  add_small_pairs(mesh, dimension, pairs);
  if (strict) add_strict(mesh, dimension, pairs);
  return pairs;
}

oracle::Answer decide(const PairKey& key, const Step& step, int dimension) {
  oracle::Motion motion;
  motion.pair = static_cast<oracle::Pair>(key.first);
  motion.dimension = dimension;
  for (std::size_t i = 0; i < point_count(key.first); ++i) {
    motion.x_t0[i] = step.x_t0[key.second[i]];
    motion.x_t1[i] = step.x_t1[key.second[i]];
  }
  return oracle::first_contact(motion);
}

BruteForce brute_force(const Step& step, int dimension, bool strict) {
  BruteForce result;
  for (const auto& [key, count] : all_pairs(step.mesh, dimension, strict)) {
    const oracle::Answer answer = decide(key, step, dimension);
    if (!answer.time) continue;
    result.contacts[key] = count;
    const int order = result.first_time ? answer.time->compare(*result.first_time) : -1;
    if (order < 0) {
      result.first_time = answer.time;
      result.first.clear();
    }
    if (order <= 0) result.first.insert(key);
  }
  for (std::uint32_t b = 0; b < step.mesh.cell_count(); ++b) {
    for (std::uint32_t a = 0; a < b; ++a) {
      if (cells_meet_at_begin(step, dimension, a, b)) result.initial.insert({a, b});
    }
  }
  return result;
}

bool ever_meet(const Step& step, int dimension) {
  const auto cells = cells_of(step.mesh);
  for (std::uint32_t b = 0; b < cells.size(); ++b) {
    for (std::uint32_t a = 0; a < b; ++a) {
      if (cells_meet_at_begin(step, dimension, a, b)) return true;
      for (const auto& [x, y] : disjoint_pairs(cells[a], cells[b])) {
        const auto key = decidable_key(x, y, dimension);
        if (key && decide(*key, step, dimension).time) return true;
      }
    }
  }
  return false;
}

bool cells_meet_at_begin(const Step& step, int dimension, std::uint32_t a, std::uint32_t b) {
  return cells_meet(step, dimension, cell_of(step.mesh, a), cell_of(step.mesh, b));
}

}  // namespace noli::testing
