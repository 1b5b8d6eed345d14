// SPDX-License-Identifier: Apache-2.0
//
// Compares random meshes of every degeneracy with the definitions, and judges the proofs of those where nothing
// touches.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>

#include "brute_force.h"
#include "proofs/prover/cells/baseline.h"
#include "replay.h"
#include "trajectory/cell_features.h"

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

VerifyOptions options_of(const Case& c) {
  VerifyOptions options;
  options.dimension = c.dimension;
  options.strict = c.strict;
  options.max_reports = 1000000;
  options.threads = 2;
  return options;
}

VerifyResult verify(const Step& step, const Case& c, bool prove = false) {
  VerifyOptions options = options_of(c);
  options.prove = prove;
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

/// With a step before, a pair that meets at t = 0 was counted there.
TEST_P(Soup, LeavesOutWhatGoesOnByTheDefinitions) {
  std::size_t go_on = 0, begin = 0;
  for (std::uint64_t seed = 0; seed < GetParam().seeds; ++seed) {
    SCOPED_TRACE(seed);
    const Step step = random_soup(seed, GetParam().size, GetParam().dimension);
    VerifyOptions options = options_of(GetParam());
    options.initial = false;
    options.after_step = true;
    const VerifyResult result = verify_step(step.mesh, step.x_t0, step.x_t1, options);
    std::map<PairKey, int> expected;
    std::uint64_t met_before = 0;
    for (const auto& [key, times] : brute_force(step, GetParam().dimension, GetParam().strict).contacts) {
      if (decide(key, step, GetParam().dimension).time->compare(0) == 0) {
        met_before += static_cast<std::uint64_t>(times);
      } else {
        expected[key] = times;
      }
    }
    EXPECT_TRUE(result.complete);
    EXPECT_EQ(reported(result), expected);
    EXPECT_EQ(result.contact_count(), result.reports.size());
    EXPECT_EQ(result.going_on, met_before);
    EXPECT_EQ(result.first.has_value(), !expected.empty());
    options.prove = true;
    const VerifyResult proved = verify_step(step.mesh, step.x_t0, step.x_t1, options);
    EXPECT_EQ(reported(proved), expected);
    EXPECT_EQ(proved.going_on, met_before);
    EXPECT_EQ(proved.proof != nullptr, expected.empty() && met_before == 0);
    go_on += met_before;
    begin += expected.size();
  }
  EXPECT_GT(go_on, 0U);
  EXPECT_GT(begin, 0U);
}

/// Whether some pair of cells that is compared has both features, by looking at all of them.
bool is_compared(const PairKey& key, const Mesh& mesh, bool strict, const std::vector<InitialIntersection>& baseline) {
  const auto has = [&](std::uint32_t cell, std::size_t from, std::size_t to) {
    const auto v = corners(mesh, cell);
    return std::all_of(key.second.begin() + static_cast<std::ptrdiff_t>(from),
                       key.second.begin() + static_cast<std::ptrdiff_t>(to),
                       [&](VertexId w) { return std::ranges::count(v, w) > 0; });
  };
  for (std::uint32_t i = 0; i < mesh.cell_count(); ++i) {
    for (std::uint32_t j = 0; j < mesh.cell_count(); ++j) {
      if (!has(i, 0, first_size(key.first)) || !has(j, first_size(key.first), point_count(key.first))) continue;
      const InitialIntersection pair = {std::min(i, j), std::max(i, j)};
      if (i == j ? strict : std::ranges::count(baseline, pair) == 0) return true;
    }
  }
  return false;
}

TEST_P(Soup, LeavesOutABaselineByTheDefinitions) {
  std::size_t left_out = 0, counted = 0;
  for (std::uint64_t seed = 0; seed < GetParam().seeds; ++seed) {
    SCOPED_TRACE(seed);
    const Step step = random_soup(seed, GetParam().size, GetParam().dimension);
    const VerifyResult all = verify(step, GetParam());
    const Baseline baseline(step.mesh, all.initial_reports);
    VerifyOptions options = options_of(GetParam());
    options.baseline = &baseline;
    const VerifyResult result = verify_step(step.mesh, step.x_t0, step.x_t1, options);
    std::map<PairKey, int> expected = reported(all);
    std::erase_if(expected, [&](const auto& counts) {
      return !is_compared(counts.first, step.mesh, GetParam().strict, all.initial_reports);
    });
    EXPECT_EQ(reported(result), expected);
    EXPECT_EQ(result.initial_intersections, 0U);
    EXPECT_EQ(result.first.has_value(), !expected.empty());
    counted += expected.size();
    left_out += reported(all).size() - expected.size();
  }
  EXPECT_GT(left_out, 0U);
  EXPECT_GT(counted, 0U);
}

/// Expects equal results: asking for a proof must not change them.
void expect_same(const VerifyResult& a, const VerifyResult& b) {
  EXPECT_EQ(a.complete, b.complete);
  EXPECT_EQ(a.contacts, b.contacts);
  EXPECT_EQ(a.initial_intersections, b.initial_intersections);
  EXPECT_EQ(a.reports, b.reports);
  EXPECT_EQ(a.initial_reports, b.initial_reports);
  EXPECT_EQ(a.first, b.first);
}

TEST_P(Soup, HasAProofThatHoldsIfNothingTouches) {
  std::size_t proved = 0, touching = 0, directions = 0;
  for (std::uint64_t seed = 100; seed < 100 + 4 * GetParam().seeds; ++seed) {
    SCOPED_TRACE(seed);
    SoupSize size = GetParam().size;
    if (seed % 2 == 0) size = {size.vertices, (size.faces + 2) / 3, (size.edges + 1) / 2, size.points, 40 * size.span};
    const Step step = random_soup(seed, size, GetParam().dimension);
    const VerifyResult result = verify(step, GetParam(), true);
    expect_same(result, verify(step, GetParam()));
    const bool touches = result.contact_count() + result.initial_intersections > 0;
    ASSERT_EQ(result.proof == nullptr, touches);
    touching += touches ? 1 : 0;
    if (touches) continue;
    ++proved;
    const Replay replay(step, GetParam().dimension, GetParam().strict, *result.proof);
    EXPECT_EQ(replay.faults(), std::vector<std::string>());
    EXPECT_EQ(replay.obligations_left(), 0u);
    directions += replay.count("axis") + replay.count("short") + replay.count("long");
  }
  RecordProperty("proved", static_cast<int>(proved));
  EXPECT_GT(proved, 0u);
  EXPECT_GT(touching, 0u);
  EXPECT_GT(directions, 0u);
}

TEST(SheetsInAStep, HaveAProofThatHolds) {
  std::size_t axes = 0, directions = 0, drops = 0;
  for (const double fall : {0.0, 0.1, 0.2}) {
    SCOPED_TRACE(fall);
    const Step step = two_sheets(7, 10, fall);
    VerifyOptions options;
    options.prove = true;
    const VerifyResult result = verify_step(step.mesh, step.x_t0, step.x_t1, options);
    ASSERT_TRUE(result.proof);
    const Replay replay(step, 3, false, *result.proof);
    EXPECT_EQ(replay.faults(), std::vector<std::string>());
    EXPECT_EQ(replay.obligations_left(), 0u);
    EXPECT_EQ(replay.count("one"), step.mesh.faces.size());
    axes += replay.count("axis");
    directions += replay.count("short");
    drops += replay.count("drop");
  }
  EXPECT_GT(axes, 0u);
  EXPECT_GT(directions, 0u);
  EXPECT_GT(drops, 0u);
}

/// An edge turns a quarter around another one, always very close to it, so each direction holds only for a short time.
TEST(PartsThatNoDirectionSeparates, HaveAProofThatHolds) {
  Step step;
  step.mesh.vertex_count = 4;
  step.mesh.edges = {{0, 1}, {2, 3}};
  const double hair = 0x1p-5;
  step.x_t0 = {{-1, 0, 0}, {1, 0, 0}, {0, -1, hair}, {0, 1, hair}};
  step.x_t1 = {{-1, 0, 0}, {1, 0, 0}, {0, -hair, -1}, {0, -hair, 1}};
  VerifyOptions options;
  options.prove = true;
  const VerifyResult result = verify_step(step.mesh, step.x_t0, step.x_t1, options);
  ASSERT_EQ(result.contact_count() + result.initial_intersections, 0u);
  EXPECT_GT(result.cell_pairs, 0u) << "the walk finds no direction";
  ASSERT_TRUE(result.proof);
  const Replay replay(step, 3, false, *result.proof);
  EXPECT_EQ(replay.faults(), std::vector<std::string>());
  EXPECT_EQ(replay.obligations_left(), 0u);
  EXPECT_GT(replay.count("halve"), 10u);

  std::atomic<bool> stop = true;
  options.stop = &stop;
  const VerifyResult stopped = verify_step(step.mesh, step.x_t0, step.x_t1, options);
  EXPECT_FALSE(stopped.complete || stopped.proof);
}

}  // namespace
}  // namespace noli::testing
