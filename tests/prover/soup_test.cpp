// SPDX-License-Identifier: Apache-2.0
//
// Random meshes of every degeneracy, against the definitions; and every step by which the verifier got there, replayed.
#include <gtest/gtest.h>

#include "brute_force.h"
#include "replay.h"

namespace noli::testing {
namespace {

struct Case {
  const char* name;
  SoupSize size;
  int dimension;
  bool strict;
  std::uint64_t seeds;
  friend void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }
};

constexpr Case cases[] = {
    {"faces", {14, 7, 0, 0, 6}, 3, false, 25},
    {"faces_strict", {14, 7, 0, 0, 3}, 3, true, 12},
    {"crowded_faces", {8, 6, 0, 0, 2}, 3, false, 20},
    {"everything", {10, 3, 3, 3, 2}, 3, false, 25},
    {"everything_strict", {6, 3, 4, 4, 2}, 3, true, 25},
    {"edges_and_points", {8, 0, 5, 5, 2}, 3, false, 20},
    {"plane", {10, 5, 3, 3, 4}, 2, false, 40},
    {"plane_strict", {7, 4, 3, 3, 2}, 2, true, 40},
    {"crowded_plane", {5, 4, 4, 4, 1}, 2, false, 40},
    {"two_edges", {3, 0, 2, 0, 2}, 3, false, 300},
    {"few_edges", {4, 0, 3, 1, 2}, 3, false, 200},
    {"few_cells", {3, 2, 2, 1, 2}, 3, false, 200},
    {"few_cells_strict", {3, 2, 2, 1, 2}, 3, true, 200},
    {"two_faces", {4, 2, 0, 1, 3}, 3, false, 200},
    {"few_in_plane", {3, 1, 2, 1, 2}, 2, false, 200},
    {"edge_in_plane", {2, 1, 1, 1, 2}, 2, false, 200},
    {"edge_in_plane_strict", {2, 1, 1, 1, 2}, 2, true, 200},
};

class Soup : public ::testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(All, Soup, ::testing::ValuesIn(cases),
                         [](const auto& c) { return std::string(c.param.name); });

VerifyResult verify(const Step& step, const Case& c, StepSink* sink = nullptr) {
  VerifyOptions options;
  options.dimension = c.dimension;
  options.strict = c.strict;
  options.max_reports = 1000000;
  options.threads = 2;
  options.sink = sink;
  return verify_step(step.mesh, step.x_t0, step.x_t1, options);
}

std::map<PairKey, int> reported(const VerifyResult& result) {
  std::map<PairKey, int> contacts;
  for (const FeatureContact& contact : result.reports) ++contacts[key_of(contact)];
  return contacts;
}

void expect_first(const VerifyResult& result, const BruteForce& truth) {
  ASSERT_EQ(result.first.has_value(), truth.first_time.has_value());
  if (!result.first) return;
  EXPECT_EQ(key_of(*result.first), *truth.first.begin());
  EXPECT_GE(truth.first_time->compare(result.first->first.begin), 0);
  EXPECT_LE(truth.first_time->compare(result.first->first.end), 0);
  EXPECT_EQ(result.first->first.begin, truth.first_time->lower());
}

TEST_P(Soup, IsAnsweredByTheDefinitions) {
  std::size_t with_contact = 0, with_intersection = 0, pairs_apart = 0;
  for (std::uint64_t seed = 0; seed < GetParam().seeds; ++seed) {
    SCOPED_TRACE(seed);
    const Step step = random_soup(seed, GetParam().size, GetParam().dimension);
    const VerifyResult result = verify(step, GetParam());
    const BruteForce truth = brute_force(step, GetParam().dimension, GetParam().strict);
    EXPECT_TRUE(result.complete);
    EXPECT_EQ(reported(result), truth.contacts);
    EXPECT_EQ(result.contact_count(), result.reports.size());
    expect_first(result, truth);
    std::set<std::pair<std::uint32_t, std::uint32_t>> initial;
    for (const auto& i : result.initial_reports) initial.insert({i.first_cell, i.second_cell});
    EXPECT_EQ(initial, truth.initial);
    EXPECT_EQ(result.initial_intersections, truth.initial.size());
    if (!GetParam().strict) {
      EXPECT_EQ(result.contact_count() + result.initial_intersections > 0, ever_meet(step, GetParam().dimension));
    }
    with_contact += truth.contacts.empty() ? 0 : 1;
    with_intersection += truth.initial.empty() ? 0 : 1;
    pairs_apart += all_pairs(step.mesh, GetParam().dimension, GetParam().strict).size() - truth.contacts.size();
  }
  EXPECT_GT(with_contact, 0u);
  EXPECT_GT(with_intersection, 0u);
  EXPECT_GT(pairs_apart, 0u);
}

/// Every pair of features is covered by directions or decided once; the cells' pairs are all there, as the empty stack
/// says.
void expect_covered(const Step& step, const Case& c, const Replay& replay) {
  for (const auto& [key, count] : all_pairs(step.mesh, c.dimension, c.strict)) {
    const auto found = replay.decisions().find(key);
    const bool decided = found != replay.decisions().end();
    EXPECT_TRUE(decided || replay.covered().contains(key));
    EXPECT_LE(decided ? found->second.times : 0, count);
    if (replay.left_to_kernel().contains(key)) {
      EXPECT_TRUE(decided || replay.covered().contains(key));
    }
    const bool contact = decide(key, step, c.dimension).time.has_value();
    if (decided) {
      EXPECT_EQ(found->second.contact, contact);
    }
    if (replay.covered().contains(key)) {
      EXPECT_FALSE(contact);
    }
  }
}

TEST_P(Soup, IsAnsweredByStepsThatHold) {
  std::size_t directions = 0, taken_apart = 0;
  for (std::uint64_t seed = 100; seed < 100 + GetParam().seeds; ++seed) {
    SCOPED_TRACE(seed);
    const Step step = random_soup(seed, GetParam().size, GetParam().dimension);
    Replay replay(step, GetParam().dimension);
    const VerifyResult result = verify(step, GetParam(), &replay);
    EXPECT_EQ(replay.faults(), std::vector<std::string>());
    EXPECT_TRUE(replay.ended() && replay.complete());
    EXPECT_EQ(replay.obligations_left(), 0u);
    EXPECT_EQ(replay.count("direction"), result.obligations);
    EXPECT_EQ(replay.open().size(), result.cell_pairs);
    EXPECT_EQ(replay.meeting().size(), result.initial_intersections);
    expect_covered(step, GetParam(), replay);
    directions += replay.count("direction");
    taken_apart += replay.count("features");
  }
  EXPECT_GT(directions, 0u);
  EXPECT_GT(taken_apart, 0u);
}

}  // namespace
}  // namespace noli::testing
