// SPDX-License-Identifier: Apache-2.0
//
// Families whose numbers are special.
#include <algorithm>
#include <cmath>
#include <limits>

#include "audit/fuzz/queries/query_generators.h"

namespace noli::audit {

namespace {

constexpr Answers generic_answers = {true, false, true, false};

template <class Function>
void for_each_coordinate(AnyQuery& query, const Function& function) {
  for (std::size_t i = 0; i < query.size(); ++i) {
    for (std::size_t axis = 0; axis < static_cast<std::size_t>(query.dimension); ++axis) {
      function(query.x_t0[i][axis]);
      function(query.x_t1[i][axis]);
    }
  }
}

Directions roomy_directions(Random& random, int axes) {
  return {random_direction(random, axes, 1 << 10), random_direction(random, axes, 1 << 10)};
}

/// What nobody constructed: all bits of all coordinates are random, and nothing ever coincides.
Generated generic(const QueryType& type, const Answers& declared, Random& random) {
  constexpr Flavour flavour = {roomy_directions, 1 << 6, 1 << 6, any_time};
  Generated generated = finish(recipe(random_answer(declared, random), type, flavour, random), random, {0, 0, 0});
  for_each_coordinate(generated.query, [&](double& x) { x += 8 * random.unit() - 4; });
  generated.truth.reset();
  return generated;
}

/// Each axis at a scale of its own; a few queries with one even for each point, so that nothing fits a fixed width.
Generated scales(const QueryType& type, const Answers& declared, Random& random) {
  constexpr std::array<int, 6> exponents = {-1074, -1040, -500, 0, 500, 960};
  const int common = random.one_of(exponents);
  AxisExponents scale = {common, common, common};
  if (random.one_in(2)) scale = {random.one_of(exponents), random.one_of(exponents), random.one_of(exponents)};
  Generated generated = finish(recipe(random_answer(declared, random), type, plain_flavour, random), random, scale);
  if (!random.one_in(16)) return generated;
  generated.truth.reset();
  const std::size_t i = random.below(generated.query.size());
  const int exponent = *std::max_element(scale.begin(), scale.end()) > 0 ? -900 : 400;
  for (double& x : generated.query.x_t0[i]) x = std::ldexp(x, exponent);
  return generated;
}

/// Far from the origin, by 2^40 (about 1e12) and more.
Generated far_away(const QueryType& type, const Answers& declared, Random& random) {
  Made made = recipe(random_answer(declared, random), type, plain_flavour, random);
  const Whole offset = random_whole(random, type.dimension, std::int64_t{1} << random.between(40, 44));
  carry(made.query, offset, random.one_in(2) ? offset : random_whole(random, type.dimension, std::int64_t{1} << 40));
  return finish(made, random);
}

void nudge(AnyQuery& query, Random& random) {
  Point3& x = (random.one_in(2) ? query.x_t0 : query.x_t1)[random.below(query.size())];
  double& coordinate = x[random.below(static_cast<std::uint64_t>(query.dimension))];
  const double limit = std::numeric_limits<double>::max();
  coordinate = std::nextafter(coordinate, random.one_in(2) ? limit : -limit);
}

/// An exact contact, or a near miss, of which one coordinate is moved to the next double.
Generated one_ulp(const QueryType& type, const Answers& declared, Random& random) {
  Generated generated = finish(recipe(random_answer(declared, random), type, plain_flavour, random), random);
  if (random.one_in(3)) return generated;
  generated.truth.reset();
  nudge(generated.query, random);
  return generated;
}

/// All coordinates rounded to few bits after a contact was made exactly: what a file in single precision holds.
Generated rounded(const QueryType& type, const Answers& declared, Random& random) {
  Generated generated = finish(recipe(random_answer(declared, random), type, plain_flavour, random), random);
  if (random.one_in(2)) return generated;
  generated.truth.reset();
  for_each_coordinate(generated.query, [](double& x) { x = static_cast<double>(static_cast<float>(x)); });
  return generated;
}

}  // namespace

std::vector<QueryFamily> families_of_number() {
  return {
      {"generic", "nothing in particular: coordinates with all their bits", every_type(), generic_answers, generic},
      {"scales", "exponents: 1e-323 to 1e300, other ones on each axis, subnormal coordinates", every_type(),
       every_answer, scales},
      {"far_away", "cancellation: offsets of 1e12 to 1e13", every_type(), every_answer, far_away},
      {"one_ulp", "answers that depend on the last bit: the double next to an exact contact", every_type(),
       every_answer, one_ulp},
      {"rounded", "contacts lost or kept by rounding to single precision", every_type(), every_answer, rounded},
  };
}

}  // namespace noli::audit
