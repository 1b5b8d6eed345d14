// SPDX-License-Identifier: Apache-2.0
#include "audit/fuzz/queries/query_generators.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <set>
#include <string>

#include "audit/fuzz/queries/oracle_bridge.h"

namespace noli::audit {
namespace {

constexpr std::uint64_t samples = 2000;

bool is_finite(const AnyQuery& query) {
  for (std::size_t i = 0; i < query.size(); ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (!std::isfinite(query.x_t0[i][axis]) || !std::isfinite(query.x_t1[i][axis])) return false;
    }
  }
  return true;
}

class EachGenerator : public testing::TestWithParam<std::size_t> {};

TEST_P(EachGenerator, GivesWhatItDeclares) {
  const QueryGenerator& generator = query_generators()[GetParam()];
  Random random(7, GetParam());
  std::array<std::uint64_t, 4> answers{};
  std::uint64_t untrue = 0;
  for (std::uint64_t i = 0; i < samples; ++i) {
    const Generated generated = generator(random);
    ASSERT_TRUE(is_finite(generated.query)) << generator.name();
    ASSERT_EQ((QueryType{generated.query.pair, generated.query.dimension}), generator.type);
    const ContactKind kind = contact_kind(oracle::first_contact(oracle_motion(generated.query)).kind);
    ++answers[static_cast<std::size_t>(kind)];
    untrue += generated.truth && *generated.truth != kind;
  }
  EXPECT_EQ(untrue, 0U) << generator.name() << " constructs something else than it believes";
  for (std::size_t kind = 0; kind < 4; ++kind) {
    const auto word = name(static_cast<ContactKind>(kind));
    if (generator.declared[kind]) {
      EXPECT_GE(answers[kind] * 20, samples) << generator.name() << " " << word;
    } else {
      EXPECT_EQ(answers[kind], 0U) << generator.name() << " " << word;
    }
  }
}

std::string test_name(const testing::TestParamInfo<std::size_t>& info) {
  std::string result = query_generators()[info.param].name();
  result[result.find('/')] = '_';
  return result;
}

INSTANTIATE_TEST_SUITE_P(All, EachGenerator, testing::Range<std::size_t>(0, query_generators().size()), test_name);

TEST(QueryGenerators, TogetherCoverEveryTypeAndAnswerThatExists) {
  for (const QueryType& type : all_query_types) {
    Answers covered{};
    for (const QueryGenerator& generator : query_generators()) {
      for (std::size_t kind = 0; kind < 4 && generator.type == type; ++kind) covered[kind] |= generator.declared[kind];
    }
    for (std::size_t kind = 0; kind < 4; ++kind) {
      EXPECT_EQ(covered[kind], exists(static_cast<ContactKind>(kind), type)) << name(type.pair) << type.dimension;
    }
  }
}

TEST(QueryGenerators, HaveNamesOfTheirOwn) {
  std::set<std::string> names;
  for (const QueryGenerator& generator : query_generators()) names.insert(generator.name());
  EXPECT_EQ(names.size(), query_generators().size());
}

TEST(QueryGenerators, GiveTheSameQueriesForTheSameSeed) {
  for (const QueryGenerator& generator : query_generators()) {
    Random one(3, 5), same(3, 5), other(4, 5);
    const AnyQuery first = generator(one).query;
    EXPECT_EQ(first, generator(same).query) << generator.name();
    bool differs = false;
    for (int i = 0; i < 20; ++i) differs |= !(first == generator(other).query);
    EXPECT_TRUE(differs) << generator.name();
  }
}

TEST(RandomNumbers, AreTheSameEverywhere) {
  Random random(1, 2);
  for (const std::uint64_t expected : {0x1cdf17f715df5037U, 0xba593eb8ed156debU, 0xd6ee6286c1f51517U})
    EXPECT_EQ(random.next(), expected);
}

TEST(RandomNumbers, StayInTheirRangeAndReachItsEnds) {
  Random random(1);
  std::set<std::int64_t> seen;
  for (int i = 0; i < 1000; ++i) seen.insert(random.between(-3, 3));
  EXPECT_EQ(seen, (std::set<std::int64_t>{-3, -2, -1, 0, 1, 2, 3}));
  for (int i = 0; i < 1000; ++i) {
    const double u = random.unit();
    EXPECT_TRUE(0 <= u && u < 1);
  }
}

}  // namespace
}  // namespace noli::audit
