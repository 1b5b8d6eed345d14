// SPDX-License-Identifier: Apache-2.0
#include "replay.h"

#include <gmpxx.h>

#include <algorithm>

namespace noli::testing {

namespace {

std::vector<VertexId> corners_of(const Mesh& mesh, std::uint32_t cell) {
  if (cell < mesh.faces.size()) return {mesh.faces[cell].begin(), mesh.faces[cell].end()};
  cell -= static_cast<std::uint32_t>(mesh.faces.size());
  if (cell < mesh.edges.size()) return {mesh.edges[cell].begin(), mesh.edges[cell].end()};
  return {mesh.points[cell - mesh.edges.size()]};
}

/// The cell's own pairs of features with another, as if the mesh had no other cells: by the definition.
std::set<PairKey> pairs_between(const Mesh& mesh, std::uint32_t a, std::uint32_t b, int dimension) {
  Mesh two;
  two.vertex_count = mesh.vertex_count;
  for (const std::uint32_t cell : {a, b}) {
    const auto v = corners_of(mesh, cell);
    if (v.size() == 3) two.faces.push_back({v[0], v[1], v[2]});
    if (v.size() == 2) two.edges.push_back({v[0], v[1]});
    if (v.size() == 1) two.points.push_back(v[0]);
  }
  std::set<PairKey> pairs;
  for (const auto& [key, count] : all_pairs(two, dimension, false)) pairs.insert(key);
  return pairs;
}

}  // namespace

void Replay::expect(bool condition, const std::string& fault) {
  if (!condition) faults_.push_back(fault);
}

Replay::Obligation Replay::pop(const std::string& step, bool self) {
  ++counts_[step];
  if (stack_.empty() || stack_.back().self != self) {
    faults_.push_back(step + ": no such obligation on top");
    return {self, {0, 1, {}}, {0, 1, {}}};
  }
  Obligation top = std::move(stack_.back());
  stack_.pop_back();
  return top;
}

void Replay::begin_step(std::span<const std::uint32_t> leaf_cells) {
  leaves_.assign(leaf_cells.begin(), leaf_cells.end());
  std::vector<std::uint32_t> sorted = leaves_;
  std::sort(sorted.begin(), sorted.end());
  expect(sorted.size() == step_.mesh.cell_count(), "begin_step: not all cells are leaves");
  for (std::uint32_t i = 0; i < sorted.size(); ++i) expect(sorted[i] == i, "begin_step: a cell is no leaf, or twice");
  const Part root = {0, leaves_.size(), {}};
  stack_.push_back({true, root, root});
}

void Replay::split_self() {
  const Obligation top = pop("split_self", true);
  const Part l = left(top.first), r = right(top.first);
  expect(l.count > 0, "split_self of a leaf");
  stack_.push_back({true, r, r});
  stack_.push_back({false, l, r});
  stack_.push_back({true, l, l});
}

void Replay::split_first() {
  const Obligation top = pop("split_first", false);
  expect(top.first.count > 1, "split_first of a leaf");
  stack_.push_back({false, right(top.first), top.second, top.begin, top.end});
  stack_.push_back({false, left(top.first), top.second, top.begin, top.end});
}

void Replay::split_second() {
  const Obligation top = pop("split_second", false);
  expect(top.second.count > 1, "split_second of a leaf");
  stack_.push_back({false, top.first, right(top.second), top.begin, top.end});
  stack_.push_back({false, top.first, left(top.second), top.begin, top.end});
}

void Replay::drop_vertex(VertexId v) {
  const Obligation top = pop("drop_vertex", false);
  expect(top.first.count == 1 && top.second.count == 1, "drop_vertex: no leaves");
  const auto has = [&](const Part& part) {
    const auto vertices = vertices_of(part);
    return std::find(vertices.begin(), vertices.end(), v) != vertices.end();
  };
  expect(has(top.first) && has(top.second), "drop_vertex of a vertex that is not shared");
  Obligation without_first = top, without_second = top;
  without_first.first.dropped.insert(v);
  without_second.second.dropped.insert(v);
  stack_.push_back(without_second);
  stack_.push_back(without_first);
}

void Replay::halve() {
  const Obligation top = pop("halve", false);
  Obligation first = top, second = top;
  first.end = second.begin = (top.begin + top.end) / 2;
  stack_.push_back(second);
  stack_.push_back(first);
}

bool Replay::separates(const std::array<double, 3>& n, VertexId a, VertexId b, double t) const {
  mpq_class sum = 0;
  const mpq_class s = 1 - mpq_class(t);
  for (std::size_t k = 0; k < static_cast<std::size_t>(dimension_); ++k) {
    const mpq_class at_t0 = mpq_class(step_.x_t0[a][k]) - step_.x_t0[b][k];
    const mpq_class at_t1 = mpq_class(step_.x_t1[a][k]) - step_.x_t1[b][k];
    sum += n[k] * (s * at_t0 + t * at_t1);
  }
  return sum > 0;
}

void Replay::direction(const std::array<double, 3>& n) {
  const Obligation top = pop("direction", false);
  bool holds = true;
  for (const VertexId a : vertices_of(top.first)) {
    for (const VertexId b : vertices_of(top.second)) {
      holds = holds && separates(n, a, b, top.begin) && separates(n, a, b, top.end);
    }
  }
  expect(holds, "direction: does not separate");
  cover(top);
}

void Replay::cover(const Obligation& pair) {
  for (const PairKey& key : features_of(pair)) {
    if ((covered_length_[key] += pair.end - pair.begin) >= 1) covered_.insert(key);
  }
}

void Replay::empty() {
  const Obligation top = pop("empty", false);
  expect(vertices_of(top.first).empty() || vertices_of(top.second).empty(), "empty: both parts have vertices");
}

void Replay::cell() { expect(pop("cell", true).first.count == 1, "cell: no leaf"); }

void Replay::decided(FeaturePair pair, const std::array<VertexId, 4>& vertices, bool contact) {
  Decision& decision = decisions_[canonical_key(pair, vertices)];
  ++decision.times;
  decision.contact = contact;
}

void Replay::at_begin(bool meet) {
  expect(!stack_.empty() && !stack_.back().self, "at_begin: no pair on top");
  if (stack_.empty()) return;
  const Obligation& top = stack_.back();
  std::vector<Position> a, b;
  for (const VertexId v : vertices_of(top.first)) a.push_back(step_.x_t0[v]);
  for (const VertexId v : vertices_of(top.second)) b.push_back(step_.x_t0[v]);
  for (auto* part : {&a, &b}) {
    for (Position& x : *part) x[2] = dimension_ == 2 ? 0 : x[2];
  }
  expect(hulls_meet(a, b) == meet, "at_begin: wrong");
  if (meet) meeting_.insert(cells_of(top));
  said_at_begin_ = true;
}

void Replay::features() {
  const Obligation top = pop("features", false);
  expect(top.first.count == 1 && top.second.count == 1, "features: no leaves");
  expect(top.begin == 0 && top.end == 1, "features: not the whole step");
  expect(said_at_begin_ || meeting_.contains(cells_of(top)), "features: nothing was said about the beginning");
  said_at_begin_ = false;
  open_.insert(cells_of(top));
  left_to_kernel_.merge(features_of(top));
}

void Replay::end_step(bool complete) {
  ended_ = true;
  complete_ = complete;
}

std::vector<VertexId> Replay::vertices_of(const Part& part) const {
  std::set<VertexId> vertices;
  for (std::size_t i = part.begin; i < part.begin + part.count; ++i) {
    for (const VertexId v : corners_of(step_.mesh, leaves_[i])) vertices.insert(v);
  }
  for (const VertexId v : part.dropped) vertices.erase(v);
  return {vertices.begin(), vertices.end()};
}

std::set<PairKey> Replay::features_of(const Obligation& pair) const {
  std::set<PairKey> result;
  const auto in = [](const std::vector<VertexId>& part, auto first, auto last) {
    return std::all_of(first, last, [&](VertexId v) { return std::binary_search(part.begin(), part.end(), v); });
  };
  const auto p = vertices_of(pair.first), q = vertices_of(pair.second);
  for (std::size_t i = pair.first.begin; i < pair.first.begin + pair.first.count; ++i) {
    for (std::size_t j = pair.second.begin; j < pair.second.begin + pair.second.count; ++j) {
      for (const PairKey& key : pairs_between(step_.mesh, leaves_[i], leaves_[j], dimension_)) {
        const auto begin = key.second.begin(), middle = begin + static_cast<std::ptrdiff_t>(first_size(key.first));
        const auto end = begin + static_cast<std::ptrdiff_t>(point_count(key.first));
        const bool forward = in(p, begin, middle) && in(q, middle, end);
        if (forward || (in(q, begin, middle) && in(p, middle, end))) result.insert(key);
      }
    }
  }
  return result;
}

std::pair<std::uint32_t, std::uint32_t> Replay::cells_of(const Obligation& pair) const {
  return std::minmax(leaves_[pair.first.begin], leaves_[pair.second.begin]);
}

}  // namespace noli::testing
