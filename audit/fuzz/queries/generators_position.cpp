// SPDX-License-Identifier: Apache-2.0
//
// Families whose features are in special positions when they meet.
#include <algorithm>

#include "audit/fuzz/queries/query_generators.h"

namespace noli::audit {

namespace {

StepTime coarse_time(Random& random) {
  const std::int64_t n = random.between(2, 4);
  return {random.between(1, n - 1), n};
}

Directions grid_directions(Random& random, int axes) {
  return {random_direction(random, axes, 2), random_whole(random, axes, 2)};
}

/// Anything on a small grid, at both ends.
Made scattered(const QueryType& type, Random& random) {
  WholeQuery query{type, {}, {}};
  for (std::size_t i = 0; i < query.size(); ++i) {
    query.x_t0[i] = random_whole(random, type.dimension, 2);
    query.x_t1[i] = random_whole(random, type.dimension, 2);
  }
  return {query, {}};
}

Generated grid(const QueryType& type, const Answers& declared, Random& random) {
  constexpr Flavour flavour = {grid_directions, 2, 2, coarse_time};
  const Made made =
      random.one_in(3) ? scattered(type, random) : recipe(random_answer(declared, random), type, flavour, random);
  return finish(made, random, {0, 0, 0});
}

/// q is p times a small number, but for a step of 1.
Directions nearly_parallel_directions(Random& random, int axes) {
  const Whole p = random_direction(random, axes, std::int64_t{1} << random.between(8, 30));
  const std::int64_t multiple = random.between(1, 3);
  Whole q = multiple * (random.one_in(2) ? p : Whole{} - p);
  q[random.below(static_cast<std::uint64_t>(axes))] += random.between(-1, 1);
  return {p, q};
}

Generated nearly_parallel(const QueryType& type, const Answers& declared, Random& random) {
  constexpr Flavour flavour = {nearly_parallel_directions, 1 << 12, 1 << 12, any_time};
  return finish(recipe(random_answer(declared, random), type, flavour, random), random);
}

/// One direction up to 2^28 times longer than the other.
Directions sliver_directions(Random& random, int axes) {
  Directions d = {random_direction(random, axes, std::int64_t{1} << random.between(20, 30)),
                  random_direction(random, axes, 2)};
  if (random.one_in(2)) std::swap(d.p, d.q);
  return d;
}

Generated slivers(const QueryType& type, const Answers& declared, Random& random) {
  constexpr Flavour flavour = {sliver_directions, 1 << 10, 4, any_time};
  return finish(recipe(random_answer(declared, random), type, flavour, random), random);
}

/// A point of the line through `from` and `to`, the same at all times: from + m (to - from).
void put_on_line(WholeQuery& query, std::size_t point, std::size_t from, std::size_t to, std::int64_t m) {
  query.x_t0[point] = query.x_t0[from] + m * (query.x_t0[to] - query.x_t0[from]);
  query.x_t1[point] = query.x_t1[from] + m * (query.x_t1[to] - query.x_t1[from]);
}

/// The same queries about simpler features, made into ones about degenerate features of `type`. The truth is kept: new
/// points are in the hulls.
Made lifted(const QueryType& type, ContactKind kind, Random& random) {
  const bool to_point = type.pair == FeaturePair::vertex_edge || random.one_in(4);
  const FeaturePair lower = to_point ? FeaturePair::vertex_vertex : FeaturePair::vertex_edge;
  Made made = recipe(kind, {lower, type.dimension}, plain_flavour, random);
  WholeQuery& query = made.query;
  query.type = type;
  if (type.pair == FeaturePair::vertex_edge) {
    put_on_line(query, 2, 1, 1, 0);
  } else if (type.pair == FeaturePair::vertex_face) {
    if (to_point) put_on_line(query, 2, 1, 1, 0);
    put_on_line(query, 3, 1, 2, random.between(0, 1));
  } else {
    put_on_line(query, 3, to_point ? 1 : 2, 0, 0);
    put_on_line(query, 2, 1, 1, 0);
    put_on_line(query, 1, 0, 0, 0);
  }
  return made;
}

/// Features that are less than they are named all the time.
Generated degenerate(const QueryType& type, const Answers& declared, Random& random) {
  return finish(lifted(type, random_answer(declared, random), random), random);
}

Directions collapsed_directions(Random& random, int axes) {
  Directions d = any_directions(random, axes);
  d.q = random.between(-2, 2) * d.p;
  return d;
}

/// Features that are degenerate, or edges that are parallel, at the very time of contact.
Generated collapsing(const QueryType& type, const Answers& declared, Random& random) {
  constexpr Flavour flavour = {collapsed_directions, 1 << 10, 1 << 10, any_time};
  return finish(recipe(random_answer(declared, random), type, flavour, random), random);
}

/// Edges that stay parallel to each other: a vertex against an edge, the vertex prolonged along the edge.
Generated parallel_edges(const QueryType& type, const Answers& declared, Random& random) {
  constexpr Flavour flavour = {any_directions, 1 << 10, 1 << 10, any_time};
  Made made = recipe(random_answer(declared, random), {FeaturePair::vertex_edge, 3}, flavour, random);
  const std::int64_t m = random.one_in(2) ? random.between(1, 3) : random.between(-3, -1);
  WholeQuery& query = made.query;
  query.type = type;
  for (WholePoints* x : {&query.x_t0, &query.x_t1}) {
    const Whole v = (*x)[0], e0 = (*x)[1], e1 = (*x)[2];
    *x = {v, v + m * (e1 - e0), e0, e1};
  }
  // The longer edge may meet what the vertex missed, or meet it earlier.
  if (made.truth == ContactKind::apart || made.truth == ContactKind::touching) made.truth.reset();
  return finish(made, random);
}

/// Points of different features, or single coordinates, that are equal.
Generated shared(const QueryType& type, const Answers& declared, Random& random) {
  constexpr Flavour flavour = {grid_directions, 8, 8, any_time};
  Made made = recipe(random_answer(declared, random), type, flavour, random);
  if (random.one_in(2)) return finish(made, random, {0, 0, 0});
  made.truth.reset();
  WholeQuery& query = made.query;
  const std::size_t first = first_size(type.pair);
  const std::size_t i = random.below(first), j = first + random.below(query.size() - first);
  const auto axis = static_cast<std::size_t>(random.below(static_cast<std::uint64_t>(type.dimension)));
  switch (random.below(4)) {
    case 0: query.x_t0[i] = query.x_t0[j]; break;
    case 1: query.x_t1[i] = query.x_t1[j]; break;
    case 2: query.x_t0[i][axis] = query.x_t0[j][axis]; break;
    default: query.x_t0[i][axis] = query.x_t0[j][axis], query.x_t1[i][axis] = query.x_t1[j][axis]; break;
  }
  return finish(made, random, {0, 0, 0});
}

}  // namespace

std::vector<QueryFamily> families_of_position() {
  return {
      {"grid", "ties: equal coordinates, vanishing determinants and several contacts at once", every_type(),
       every_answer, grid},
      {"nearly_parallel", "ill-conditioned normals: directions that differ by one unit in up to 2^30", solid_types(),
       every_answer, nearly_parallel},
      {"slivers", "lengths that differ by up to 2^30 within one query", types_with_edges(), every_answer, slivers},
      {"degenerate", "faces that are segments or points, edges that are points, all the time", types_with_edges(),
       no_crossing, degenerate},
      {"collapsing", "features that are degenerate or parallel exactly when they meet", solid_types(), every_answer,
       collapsing},
      {"parallel_edges", "edges that are parallel or collinear all the time", {edge_edge}, no_crossing, parallel_edges},
      {"shared", "points and coordinates in common, hits of corners", every_type(), every_answer, shared},
  };
}

}  // namespace noli::audit
