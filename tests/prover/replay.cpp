// SPDX-License-Identifier: Apache-2.0
#include "replay.h"

#include <gmpxx.h>

#include <algorithm>
#include <cmath>

#include "proofs/prover/tokens/tokens.h"

namespace noli::testing {

namespace {

std::vector<VertexId> corners_of(const Mesh& mesh, std::uint32_t cell) {
  if (cell < mesh.faces.size()) return {mesh.faces[cell].begin(), mesh.faces[cell].end()};
  cell -= static_cast<std::uint32_t>(mesh.faces.size());
  if (cell < mesh.edges.size()) return {mesh.edges[cell].begin(), mesh.edges[cell].end()};
  return {mesh.points[cell - mesh.edges.size()]};
}

std::uint8_t take_byte(std::string_view& bytes) {
  const auto byte = static_cast<std::uint8_t>(bytes.at(0));
  bytes.remove_prefix(1);
  return byte;
}

/// The distance of a code from the first one of its range.
std::size_t past(TokenCode first, TokenCode code) {
  return static_cast<std::size_t>(code) - static_cast<std::size_t>(first);
}

double take_sint(std::string_view& bytes) {
  mpz_class coded = 0;
  for (unsigned shift = 0;; shift += 7) {
    const std::uint8_t byte = take_byte(bytes);
    coded += mpz_class(byte & 0x7f) << shift;
    if ((byte & 0x80) == 0) break;
  }
  const mpz_class value = coded % 2 == 0 ? mpz_class(coded / 2) : mpz_class(-(coded + 1) / 2);
  return value.get_d();  // the direction was found in doubles
}

}  // namespace

Replay::Replay(const Step& step, int dimension, bool strict, const StepProof& proof)
    : step_(step), dimension_(dimension), strict_(strict), leaves_(proof.leaf_cells) {
  std::vector<std::uint32_t> sorted = leaves_;
  std::sort(sorted.begin(), sorted.end());
  expect(sorted.size() == step_.mesh.cell_count(), "not all cells are leaves");
  for (std::uint32_t i = 0; i < sorted.size(); ++i) expect(sorted[i] == i, "a cell is no leaf, or twice");
  const Part root = {0, leaves_.size(), {}};
  stack_.push_back({true, root, root});
  proof.tokens.give([this](std::string_view bytes) { read(bytes); });
}

void Replay::read(std::string_view bytes) {
  while (!bytes.empty()) {
    const auto code = static_cast<TokenCode>(take_byte(bytes));
    switch (code) {
      case TokenCode::halve: halve(); break;
      case TokenCode::left: split("left", &Obligation::first); break;
      case TokenCode::right: split("right", &Obligation::second); break;
      case TokenCode::parts: parts(); break;
      case TokenCode::one: expect(pop("one", true).first.count == 1 && !strict_, "one: no leaf, or strict"); break;
      case TokenCode::both: both(); break;
      case TokenCode::empty: {
        const Obligation top = pop("empty", false);
        expect(vertices_of(top.first).empty() || vertices_of(top.second).empty(), "empty: both have vertices");
        break;
      }
      case TokenCode::short_direction:
      case TokenCode::direction: read_direction(bytes, code == TokenCode::short_direction); break;
      default: {
        if (TokenCode::drop <= code && code <= TokenCode::last_drop) {
          drop(past(TokenCode::drop, code));
          break;
        }
        std::array<double, 3> n{};
        expect(TokenCode::axis <= code && code <= TokenCode::last_axis, "a token that is not expected");
        const std::size_t k = past(TokenCode::axis, code);
        n[k / 2 % 3] = k % 2 == 0 ? 1 : -1;
        direction(n, "axis");
      }
    }
  }
}

void Replay::read_direction(std::string_view& bytes, bool is_short) {
  std::array<double, 3> n{};
  if (is_short) {
    std::uint32_t word = 0;
    for (unsigned i = 0; i < 4; ++i) word |= std::uint32_t{take_byte(bytes)} << (8 * i);
    expect(word >> 30 == 0, "bits 30 and 31 of a short direction");
    for (unsigned k = 0; k < 3; ++k) {
      const auto part = static_cast<int>(word >> (10 * k) & 0x3ff);
      n[k] = part < 512 ? part : part - 1024;
    }
  } else {
    for (double& part : n) part = take_sint(bytes);
  }
  direction(n, is_short ? "short" : "long");
}

void Replay::expect(bool condition, const std::string& fault) {
  if (!condition) faults_.push_back(fault);
}

Replay::Obligation Replay::pop(const std::string& token, bool self) {
  ++counts_[token];
  if (stack_.empty() || stack_.back().self != self) {
    faults_.push_back(token + ": no such obligation on top");
    return {self, {0, 1, {}}, {0, 1, {}}};
  }
  Obligation top = std::move(stack_.back());
  stack_.pop_back();
  return top;
}

void Replay::split(const std::string& token, Part Obligation::*which) {
  const Obligation top = pop(token, false);
  expect((top.*which).count > 1, token + " of a leaf");
  Obligation first = top, second = top;
  first.*which = left(top.*which);
  second.*which = right(top.*which);
  stack_.push_back(second);
  stack_.push_back(first);
}

void Replay::parts() {
  const Obligation top = pop("parts", true);
  const Part l = left(top.first), r = right(top.first);
  expect(l.count > 0, "parts of a leaf");
  stack_.push_back({true, r, r});
  stack_.push_back({false, l, r});
  stack_.push_back({true, l, l});
}

void Replay::both() {
  const Obligation top = pop("both", true);
  stack_.push_back({false, top.first, top.first});
}

void Replay::drop(std::size_t k) {
  const Obligation top = pop("drop", false);
  expect(top.first.count == 1 && top.second.count == 1, "drop: no leaves");
  const auto p = vertices_of(top.first), q = vertices_of(top.second);
  std::vector<VertexId> common;
  std::set_intersection(p.begin(), p.end(), q.begin(), q.end(), std::back_inserter(common));
  expect(k < common.size(), "drop of a vertex that is not there");
  if (k >= common.size()) return;
  Obligation without_first = top, without_second = top;
  without_first.first.dropped.insert(common[k]);
  without_second.second.dropped.insert(common[k]);
  stack_.push_back(without_second);
  stack_.push_back(without_first);
}

void Replay::halve() {
  const Obligation top = pop("halve", false);
  Obligation first = top, second = top;
  first.end = second.begin = (top.begin + top.end) / 2;
  expect(first.begin < first.end && second.begin < second.end, "halve: more than doubles can tell");
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

void Replay::direction(const std::array<double, 3>& n, const std::string& token) {
  const Obligation top = pop(token, false);
  bool holds = true;
  for (const VertexId a : vertices_of(top.first)) {
    for (const VertexId b : vertices_of(top.second)) {
      holds = holds && separates(n, a, b, top.begin) && separates(n, a, b, top.end);
    }
  }
  expect(holds, token + ": does not separate");
}

std::vector<VertexId> Replay::vertices_of(const Part& part) const {
  std::set<VertexId> vertices;
  for (std::size_t i = part.begin; i < part.begin + part.count; ++i) {
    for (const VertexId v : corners_of(step_.mesh, leaves_[i])) vertices.insert(v);
  }
  for (const VertexId v : part.dropped) vertices.erase(v);
  return {vertices.begin(), vertices.end()};
}

}  // namespace noli::testing
