// SPDX-License-Identifier: Apache-2.0
#include "audit/fuzz/queries/recipes.h"

#include <algorithm>

namespace noli::audit {

namespace {

bool solid(const QueryType& type) {
  return type.pair == FeaturePair::vertex_face || type.pair == FeaturePair::edge_edge;
}

/// Directions in the floor; not parallel, where that can be had and is asked for.
Directions floor_directions(Random& random, const QueryType& type, const Flavour& flavour, bool independent) {
  Directions d = flavour.directions(random, type.dimension - 1);
  for (int attempt = 0; attempt < 20 && independent && solid(type) && parallel(d.p, d.q); ++attempt) {
    d = flavour.directions(random, type.dimension - 1);
  }
  if (independent && solid(type) && parallel(d.p, d.q)) d.q = Whole{-d.p[1], d.p[0], 0};
  return d;
}

Made approaching(Random& random, const QueryType& type, const Flavour& flavour, Place place, StepTime when,
                 ContactKind truth, bool independent = false) {
  const Directions d = floor_directions(random, type, flavour, independent);
  const Meeting m = meeting(type, place, random_ratios(random), d);
  return {passing(type, m.x, approach(random, type, flavour), when), truth};
}

Made crossing(const QueryType& type, const Flavour& flavour, Random& random) {
  return approaching(random, type, flavour, Place::inside, flavour.when(random), ContactKind::crossing, true);
}

/// Not inside of both features, or at an end of the step.
Made touching(const QueryType& type, const Flavour& flavour, Random& random) {
  StepTime when = flavour.when(random);
  if (random.one_in(4)) when.k = random.one_in(2) ? 0 : when.n;
  const bool may_cross = when.k != 0 && when.k != when.n && exists(ContactKind::crossing, type);
  const Place place = may_cross ? (random.one_in(2) ? Place::border : Place::corner) : random.one_of(meeting_places);
  return approaching(random, type, flavour, place, when, ContactKind::touching);
}

/// Too late for the step, or beside each other when they pass.
Made apart(const QueryType& type, const Flavour& flavour, Random& random) {
  StepTime when = flavour.when(random);
  if (random.one_in(3)) {
    when.k = when.n + 1;
    return approaching(random, type, flavour, random.one_of(meeting_places), when, ContactKind::apart);
  }
  const Place place = random.one_in(3) ? Place::outside : Place::missed;
  return approaching(random, type, flavour, place, when, ContactKind::apart);
}

}  // namespace

bool exists(ContactKind kind, const QueryType& type) {
  if (kind != ContactKind::crossing) return true;
  return solid(type) || (type.pair == FeaturePair::vertex_edge && type.dimension == 2);
}

WholePoints approach(Random& random, const QueryType& type, const Flavour& flavour) {
  WholePoints v{};
  const auto height = static_cast<std::size_t>(type.dimension - 1);
  const std::int64_t side = random.one_in(2) ? 1 : -1;
  for (std::size_t i = 0; i < point_count(type.pair); ++i) {
    v[i] = random_whole(random, type.dimension - 1, flavour.speed);
    const bool first = i < first_size(type.pair);
    v[i][height] =
        first ? -side * random.between(1, flavour.height_speed) : side * random.between(0, flavour.height_speed);
  }
  return v;
}

Made carried(const QueryType& type, Place place, const Flavour& flavour, Random& random) {
  const Ratios ratios = random_ratios(random);
  const Directions before = flavour.directions(random, type.dimension),
                   after = flavour.directions(random, type.dimension);
  WholeQuery query{type, meeting(type, place, ratios, before).x, meeting(type, place, ratios, after).x};
  carry_anywhere(query, random, type.dimension, flavour.speed);
  return {query, ContactKind::persistent};
}

Made recipe(ContactKind kind, const QueryType& type, const Flavour& flavour, Random& random) {
  switch (kind) {
    case ContactKind::apart: return apart(type, flavour, random);
    case ContactKind::touching: return touching(type, flavour, random);
    case ContactKind::crossing: return crossing(type, flavour, random);
    case ContactKind::persistent: break;
  }
  return carried(type, random.one_of(meeting_places), flavour, random);
}

StepTime any_time(Random& random) {
  const std::int64_t n = random.between(2, 64);
  return {random.between(1, n - 1), n};
}

Directions any_directions(Random& random, int axes) {
  constexpr std::array<int, 4> exponents = {4, 10, 20, 30};
  const std::int64_t size = std::int64_t{1} << random.one_of(exponents);
  return {random_direction(random, axes, size), random_direction(random, axes, size)};
}

}  // namespace noli::audit
