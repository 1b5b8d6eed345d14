// SPDX-License-Identifier: Apache-2.0
#include "oracle/features.h"

#include <array>
#include <utility>

namespace noli::oracle {

namespace {

/// The closest points of two sub-features, as determinants.
struct Closest {
  Polynomial gram;                  ///< G; positive iff the closest points of the affine hulls are unique
  std::vector<Polynomial> weights;  ///< G times the weights of the points
};

Closest vertex_face(const Vector& v, const Vector& f0, const Vector& f1, const Vector& f2) {
  const Vector p = v - f0, e1 = f1 - f0, e2 = f2 - f0;
  const Polynomial g11 = dot(e1, e1), g12 = dot(e1, e2), g22 = dot(e2, e2), b1 = dot(p, e1), b2 = dot(p, e2);
  const Polynomial gram = g11 * g22 - g12 * g12, w1 = g22 * b1 - g12 * b2, w2 = g11 * b2 - g12 * b1;
  return {gram, {gram - w1 - w2, w1, w2}};
}

Closest edge_edge(const Vector& a0, const Vector& a1, const Vector& b0, const Vector& b1) {
  const Vector u = a1 - a0, v = b1 - b0, w = b0 - a0;
  const Polynomial uu = dot(u, u), uv = dot(u, v), vv = dot(v, v), uw = dot(u, w), vw = dot(v, w);
  const Polynomial gram = uu * vv - uv * uv, s = uw * vv - uv * vw, r = uv * uw - uu * vw;
  return {gram, {gram - s, s, gram - r, r}};
}

Closest vertex_edge(const Vector& v, const Vector& e0, const Vector& e1) {
  const Vector p = v - e0, e = e1 - e0;
  const Polynomial ee = dot(e, e), pe = dot(p, e);
  return {ee, {ee - pe, pe}};
}

/// |e|^2 times the squared distance of v from the line of the edge.
Polynomial squared_area(const Vector& v, const Vector& e0, const Vector& e1) {
  const Vector p = v - e0, e = e1 - e0;
  const Polynomial pe = dot(p, e);
  return dot(e, e) * dot(p, p) - pe * pe;
}

/// The pairs of sub-features of the two features that have `n` points together, as indices of points: those of the
/// first, then of the second.
using Points = std::array<std::size_t, 3>;

std::vector<Points> vertex_edges(Pair pair) {
  switch (pair) {
    case Pair::vertex_face: return {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}};
    case Pair::edge_edge: return {{0, 2, 3}, {1, 2, 3}, {2, 0, 1}, {3, 0, 1}};
    case Pair::vertex_edge: return {{0, 1, 2}};
    case Pair::vertex_vertex: break;
  }
  return {};
}

std::vector<std::pair<std::size_t, std::size_t>> vertex_vertices(Pair pair) {
  std::vector<std::pair<std::size_t, std::size_t>> result;
  for (std::size_t i = 0; i < first_count(pair); ++i) {
    for (std::size_t j = first_count(pair); j < point_count(pair); ++j) result.emplace_back(i, j);
  }
  return result;
}

bool is_solid(Pair pair) { return pair == Pair::vertex_face || pair == Pair::edge_edge; }

Closest whole(Pair pair, const std::vector<Vector>& x) {
  return pair == Pair::vertex_face ? vertex_face(x[0], x[1], x[2], x[3]) : edge_edge(x[0], x[1], x[2], x[3]);
}

/// A vertex on an edge, degenerate or not: 0 lies between p and q iff they are parallel and do not point the same way.
Clause vertex_on_edge(const Vector& v, const Vector& e0, const Vector& e1) {
  const Vector p = e0 - v, q = e1 - v;
  const Vector c = cross(p, q);
  return {{c[0], c[1], c[2]}, {}, {Polynomial() - dot(p, q)}};
}

Clause vertex_on_vertex(const Vector& v, const Vector& w) {
  const Vector d = v - w;
  return {{d[0], d[1], d[2]}, {}, {}};
}

/// The clause "within the distance". The squared distance of the affine hulls is `squared` over G.
Clause near(const Closest& closest, const Polynomial& squared, const Polynomial& squared_distance) {
  Clause clause{{}, {closest.gram}, closest.weights};
  clause.not_negative.push_back(closest.gram * squared_distance - squared);
  return clause;
}

}  // namespace

std::optional<Polynomial> orientation(const Motion& motion, const std::vector<Vector>& x) {
  switch (motion.pair) {
    case Pair::vertex_face: return dot(x[0] - x[1], cross(x[2] - x[1], x[3] - x[1]));
    case Pair::edge_edge: return dot(x[2] - x[0], cross(x[1] - x[0], x[3] - x[2]));
    case Pair::vertex_edge: break;
    case Pair::vertex_vertex: return std::nullopt;
  }
  if (motion.dimension == 2) return cross(x[1] - x[0], x[2] - x[0])[2];
  return std::nullopt;
}

ContactCondition contact_condition(const Motion& motion, const std::vector<Vector>& x,
                                   const std::optional<Polynomial>& orientation) {
  ContactCondition result;
  if (is_solid(motion.pair)) {
    const Closest closest = whole(motion.pair, x);
    result.condition.push_back({{orientation.value()}, {closest.gram}, closest.weights});
    result.interior = closest.weights;
    result.interior.push_back(closest.gram);
  }
  for (const auto& [v, e0, e1] : vertex_edges(motion.pair)) {
    result.condition.push_back(vertex_on_edge(x[v], x[e0], x[e1]));
  }
  if (motion.pair == Pair::vertex_edge) result.interior = vertex_edge(x[0], x[1], x[2]).weights;
  if (motion.pair == Pair::vertex_vertex) result.condition.push_back(vertex_on_vertex(x[0], x[1]));
  return result;
}

Condition nearness_condition(const Motion& motion, const std::vector<Vector>& x, const Integer& distance) {
  const Polynomial limit = Polynomial::constant(distance * distance);
  Condition condition;
  if (is_solid(motion.pair)) {
    const Polynomial volume = orientation(motion, x).value();
    condition.push_back(near(whole(motion.pair, x), volume * volume, limit));
  }
  for (const auto& [v, e0, e1] : vertex_edges(motion.pair)) {
    condition.push_back(near(vertex_edge(x[v], x[e0], x[e1]), squared_area(x[v], x[e0], x[e1]), limit));
  }
  for (const auto& [v, w] : vertex_vertices(motion.pair)) {
    condition.push_back({{}, {}, {limit - dot(x[v] - x[w], x[v] - x[w])}});
  }
  return condition;
}

}  // namespace noli::oracle
