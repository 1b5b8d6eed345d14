// SPDX-License-Identifier: Apache-2.0
#include "audit/fuzz/queries/query_generators.h"

#include <utility>

namespace noli::audit {

namespace {

void append(std::vector<QueryGenerator>& generators, const QueryFamily& family) {
  for (const QueryType& type : family.types) {
    QueryGenerator generator{family.name, family.attacks, type, family.declared, family.make};
    for (std::size_t i = 0; i < generator.declared.size(); ++i) {
      generator.declared[i] = generator.declared[i] && exists(static_cast<ContactKind>(i), type);
    }
    generators.push_back(generator);
  }
}

std::vector<QueryGenerator> all_generators() {
  std::vector<QueryGenerator> generators;
  for (const auto& families : {families_of_position(), families_of_motion(), families_of_number()}) {
    for (const QueryFamily& family : families) append(generators, family);
  }
  return generators;
}

void swap_points(WholeQuery& query, std::size_t i, std::size_t j) {
  std::swap(query.x_t0[i], query.x_t0[j]);
  std::swap(query.x_t1[i], query.x_t1[j]);
}

void rename(WholeQuery& query, Random& random) {
  const std::size_t first = first_size(query.type.pair), size = query.size();
  for (std::size_t i = first; i < size; ++i) swap_points(query, i, i + random.below(size - i));
  if (first == 2 && random.one_in(2)) swap_points(query, 0, 1);
  if (2 * first == size && random.one_in(2)) {
    for (std::size_t i = 0; i < first; ++i) swap_points(query, i, first + i);
  }
}

void disguise(WholeQuery& query, Random& random) {
  std::vector<Whole*> points;
  for (std::size_t i = 0; i < query.size(); ++i) points.insert(points.end(), {&query.x_t0[i], &query.x_t1[i]});
  shear_and_turn(points, query.type.dimension, random);
  rename(query, random);
}

}  // namespace

std::string QueryGenerator::name() const {
  return std::string(family) + "/" + std::string(noli::name(type.pair)) + (type.dimension == 2 ? "_2d" : "");
}

std::span<const QueryGenerator> query_generators() {
  static const std::vector<QueryGenerator> generators = all_generators();
  return generators;
}

ContactKind random_answer(const Answers& declared, Random& random) {
  for (;;) {
    const std::size_t i = random.below(declared.size());
    if (declared[i]) return static_cast<ContactKind>(i);
  }
}

Generated finish(Made made, Random& random, const AxisExponents& exponents) {
  disguise(made.query, random);
  AnyQuery query{made.query.type.pair, made.query.type.dimension, {}, {}};
  for (std::size_t i = 0; i < made.query.size(); ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      query.x_t0[i][axis] = as_double(made.query.x_t0[i][axis], exponents[axis]);
      query.x_t1[i][axis] = as_double(made.query.x_t1[i][axis], exponents[axis]);
    }
  }
  return {query, made.truth};
}

Generated finish(Made made, Random& random) {
  const int exponent = -static_cast<int>(random.below(41));
  return finish(made, random, {exponent, exponent, exponent});
}

}  // namespace noli::audit
