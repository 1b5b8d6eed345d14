// SPDX-License-Identifier: Apache-2.0
#include "audit/fuzz/queries/query_generators.h"

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

}  // namespace noli::audit
