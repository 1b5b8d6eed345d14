// SPDX-License-Identifier: Apache-2.0
//
// Families whose motions are special.
#include <algorithm>

#include "audit/fuzz/queries/query_generators.h"

namespace noli::audit {

namespace {

constexpr Answers apart_or_persistent = {true, false, false, true};

Directions independent_in_floor(Random& random) {
  Directions d = any_directions(random, 2);
  while (parallel(d.p, d.q)) d = any_directions(random, 2);
  return d;
}

/// Everything stays in the floor. Both features keep their shape and the first one arrives at the border of the second
/// at that time, having been strictly beyond it before.
WholeQuery arriving(const QueryType& type, Random& random, StepTime when) {
  const Directions d = independent_in_floor(random);
  Whole r = random_direction(random, 2, 1 << 12);
  const Whole border = type.pair == FeaturePair::vertex_face ? d.p : d.q;
  while (parallel(border, r)) r = random_direction(random, 2, 1 << 12);
  // The face comes to lie beyond its edge along p as seen from the vertex; edge a comes to lie beyond edge b.
  const bool wrong = type.pair == FeaturePair::vertex_face ? floor_cross(d.p, r) != floor_cross(d.p, d.q)
                                                           : floor_cross(d.q, r) == floor_cross(d.q, d.p);
  if (wrong) r = Whole{} - r;
  WholePoints v{};
  for (std::size_t i = 0; i < first_size(type.pair); ++i) v[i] = r;
  return passing(type, meeting(type, Place::border, random_ratios(random), d).x, v, when);
}

Meeting random_meeting(const QueryType& type, Place place, Random& random) {
  const Ratios ratios = random_ratios(random);
  return meeting(type, place, ratios, any_directions(random, type.dimension - 1));
}

/// All in the floor, each point with a displacement of its own.
Made flat(const QueryType& type, Random& random) {
  const Directions d = any_directions(random, 2);
  WholePoints v{};
  for (Whole& displacement : v) displacement = random_whole(random, 2, 1 << 14);
  const Place place = random.one_in(2) ? Place::inside : Place::missed;
  const Meeting m = meeting(type, place, random_ratios(random), d);
  return {passing(type, m.x, v, any_time(random)), {}};
}

Made flat_with(ContactKind kind, const QueryType& type, Random& random) {
  const std::int64_t n = random.between(1, 64);
  switch (kind) {
    case ContactKind::apart: return {arriving(type, random, {n + 1, n}), kind};
    case ContactKind::touching: return {arriving(type, random, {n, n}), kind};
    default: break;
  }
  const Ratios ratios = random_ratios(random);
  const Place place = random.one_of(meeting_places);
  return {{type, meeting(type, place, ratios, any_directions(random, 2)).x,
           meeting(type, place, ratios, any_directions(random, 2)).x},
          ContactKind::persistent};
}

/// A motion of vertex and edge in the plane, seen in space.
Made in_a_plane(ContactKind kind, Random& random) {
  Made made =
      recipe(kind == ContactKind::touching ? ContactKind::crossing : kind, vertex_edge_2d, plain_flavour, random);
  made.query.type = vertex_edge_3d;
  if (made.truth == ContactKind::crossing) made.truth = ContactKind::touching;
  return made;
}

Generated coplanar(const QueryType& type, const Answers& declared, Random& random) {
  const ContactKind kind = random_answer(declared, random);
  if (type == vertex_edge_3d) return finish(in_a_plane(kind, random), random);
  Made made = random.one_in(3) ? flat(type, random) : flat_with(kind, type, random);
  carry_anywhere(made.query, random, 3, 1 << 10);
  return finish(made, random);
}

StepTime first_or_last_moment(Random& random) {
  const std::int64_t n = std::int64_t{1} << random.between(6, 24);
  return {random.one_in(2) ? 1 : n - 1, n};
}

/// Contact at exactly 0 or 1, or an n-th of the step inside or outside of it.
Generated at_the_ends(const QueryType& type, const Answers& declared, Random& random) {
  constexpr Flavour flavour = {any_directions, 1 << 8, 1 << 8, first_or_last_moment};
  const ContactKind kind = random_answer(declared, random);
  if (kind != ContactKind::touching && kind != ContactKind::apart) {
    return finish(recipe(kind, type, flavour, random), random);
  }
  const Meeting m = random_meeting(type, random.one_of(meeting_places), random);
  StepTime when = first_or_last_moment(random);
  const bool beyond = kind == ContactKind::apart;
  when.k = when.k == 1 ? (beyond ? -1 : 0) : when.n + (beyond ? 1 : 0);
  return finish({passing(type, m.x, approach(random, type, flavour), when), kind}, random);
}

/// Heights whose weighted sum is zero, so that the orientation has a double root at the contact, or a triple one.
WholePoints tangential(const QueryType& type, const Meeting& m, Random& random) {
  WholePoints v{};
  const auto height = static_cast<std::size_t>(type.dimension - 1);
  const std::size_t size = point_count(type.pair);
  std::size_t last = size - 1;
  while (m.weights[last] == 0) --last;
  std::int64_t sum = 0;
  for (std::size_t i = 0; i < size; ++i) {
    v[i] = random_whole(random, type.dimension - 1, 1 << 8);
    if (i == last) continue;
    const std::int64_t r = random.between(-8, 8);
    v[i][height] = m.weights[last] * r;
    sum += m.weights[i] * r;
  }
  v[last][height] = -sum;
  return v;
}

Generated double_roots(const QueryType& type, const Answers& declared, Random& random) {
  if (random.one_in(3)) return finish(recipe(random_answer(declared, random), type, plain_flavour, random), random);
  const Meeting m = random_meeting(type, random.one_in(4) ? Place::border : Place::inside, random);
  const WholePoints v = tangential(type, m, random);
  return finish({passing(type, m.x, v, any_time(random)), {}}, random);
}

/// In contact at 1/4 and at 3/4, or nearly so; the orientation has the same sign at both ends if its third root is not
/// between.
Generated even_crossings(const QueryType& type, const Answers& declared, Random& random) {
  const ContactKind kind = random_answer(declared, random);
  const Ratios ratios = random_ratios(random);
  const bool again = kind == ContactKind::persistent;
  const Place place = kind == ContactKind::apart      ? Place::outside
                      : kind == ContactKind::touching ? Place::border
                                                      : Place::inside;
  const Directions before = any_directions(random, type.dimension), after = any_directions(random, type.dimension);
  const WholePoints first = meeting(type, place, ratios, before).x;
  const Place place_again = kind == ContactKind::touching ? Place::inside : place;
  const WholePoints second = meeting(type, place_again, again ? ratios : random_ratios(random), after).x;
  WholePoints x{}, v{};
  for (std::size_t i = 0; i < x.size(); ++i) x[i] = 2 * first[i], v[i] = second[i] - first[i];
  return finish({passing(type, x, v, {1, 4}), again ? std::optional(kind) : std::nullopt}, random);
}

/// Features that keep their shape and glide along each other. vertex_edge: along one line.
Made gliding(ContactKind kind, const QueryType& type, Random& random) {
  const std::int64_t n = random.between(1, 64);
  if (type.pair != FeaturePair::vertex_edge) {
    if (kind == ContactKind::persistent) return {arriving(type, random, {random.between(0, n - 1), n}), kind};
    return {arriving(type, random, {kind == ContactKind::touching ? n : n + 1, n}), kind};
  }
  const Directions d = any_directions(random, type.dimension);
  const Meeting m = meeting(type, Place::border, random_ratios(random), d);
  WholePoints v{};
  v[0] = random.between(1, 64) * d.p;
  const std::int64_t k = kind == ContactKind::persistent ? random.between(0, n - 1)
                         : kind == ContactKind::touching ? n
                                                         : n + 1;
  return {passing(type, m.x, v, {k, n}), kind};
}

Generated sliding(const QueryType& type, const Answers& declared, Random& random) {
  const ContactKind kind = random_answer(declared, random);
  if (kind == ContactKind::persistent && random.one_in(3)) {
    return finish(carried(type, random.one_of(meeting_places), plain_flavour, random), random);
  }
  Made made = gliding(kind, type, random);
  carry_anywhere(made.query, random, type.dimension, 1 << 16);
  return finish(made, random);
}

/// Half a turn: in the floor every point goes to the other side of the place of contact, so that all features shrink
/// and turn over.
Generated rotations(const QueryType& type, const Answers& declared, Random& random) {
  const ContactKind kind = random_answer(declared, random);
  if (kind == ContactKind::persistent || random.one_in(3))
    return finish(recipe(kind, type, plain_flavour, random), random);
  const Place place = kind == ContactKind::apart      ? Place::missed
                      : kind == ContactKind::crossing ? Place::inside
                                                      : random.one_of(meeting_places);
  const Meeting m = random_meeting(type, place, random);
  WholePoints v = approach(random, type, {any_directions, 1, 4, any_time});
  const std::int64_t turn = random.between(-3, 3), shrink = random.between(-2, 2);
  for (std::size_t i = 0; i < v.size(); ++i) {
    const Whole& x = m.x[i];
    v[i] = v[i] + shrink * x + turn * (type.dimension == 3 ? Whole{-x[1], x[0], 0} : Whole{});
  }
  return finish({passing(type, m.x, v, {random.between(1, 3), 4}), {}}, random);
}

/// Nothing moves, or everything together: in contact from the first instant, or never.
Generated motionless(const QueryType& type, const Answers& declared, Random& random) {
  const ContactKind kind = random_answer(declared, random);
  const Place place = kind == ContactKind::persistent ? random.one_of(meeting_places)
                      : random.one_in(2)              ? Place::missed
                                                      : Place::outside;
  const Directions d =
      any_directions(random, type.pair == FeaturePair::vertex_vertex ? type.dimension : type.dimension - 1);
  const WholePoints x = meeting(type, place, random_ratios(random), d).x;
  WholeQuery query{type, x, x};
  if (random.one_in(2)) carry(query, {}, random_whole(random, type.dimension, 1 << 16));
  return finish({query, kind}, random);
}

/// The paths are nearly parallel to the plane in which the features meet.
Generated grazing(const QueryType& type, const Answers& declared, Random& random) {
  constexpr Flavour flavour = {any_directions, 1 << 28, 1, any_time};
  return finish(recipe(random_answer(declared, random), type, flavour, random), random);
}

/// A vertex that meets an edge in a plane at a time that is mostly irrational. Then a corner of the face, or the other
/// end of the vertex's edge, is added off the plane: the orientation and the conditions of the border have that root in
/// common.
Generated irrational(const QueryType& type, const Answers& declared, Random& random) {
  const ContactKind kind = random_answer(declared, random);
  Made made = in_a_plane(kind, random);
  WholeQuery& query = made.query;
  if (kind == ContactKind::touching) {
    made.truth.reset();
    query.x_t0[random.below(3)][1] += random.between(-3, 3);
  }
  query.type = type;
  const std::size_t off = type.pair == FeaturePair::vertex_face ? 3 : 1;
  for (WholePoints* x : {&query.x_t0, &query.x_t1}) {
    if (type.pair == FeaturePair::edge_edge) *x = {(*x)[0], Whole{}, (*x)[1], (*x)[2]};
    if (type.pair == FeaturePair::vertex_edge) continue;
    (*x)[off] = random_whole(random, 2, 1 << 16);
    (*x)[off][2] = random.between(1, 1 << 16);
  }
  return finish(made, random);
}

}  // namespace

std::vector<QueryFamily> families_of_motion() {
  return {
      {"coplanar", "an orientation that is zero throughout", types_with_edges_in_space(), no_crossing, coplanar},
      {"at_the_ends", "contact at exactly t = 0 or t = 1, or just inside or outside of the step", every_type(),
       every_answer, at_the_ends},
      {"double_roots", "orientations that touch zero without crossing it, or cross it with a triple root",
       crossing_types(), every_answer, double_roots},
      {"even_crossings", "several contacts in one step, after which all is as before", crossing_types(), every_answer,
       even_crossings},
      {"sliding", "contact that lasts, from a time inside the step on", types_with_edges(), no_crossing, sliding},
      {"rotations", "large turns within one step, features that shrink and turn over", every_type(), every_answer,
       rotations},
      {"motionless", "no motion, or a common one", every_type(), apart_or_persistent, motionless},
      {"grazing", "paths nearly parallel to the plane of the contact", every_type(), every_answer, grazing},
      {"irrational", "conditions that vanish together with the orientation, at an irrational time",
       types_with_edges_in_space(), no_crossing, irrational},
  };
}

}  // namespace noli::audit
