// SPDX-License-Identifier: Apache-2.0
//
// Compares random meshes whose vertices have individual breakpoints with the definitions.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "window_scenes.h"

namespace noli::testing {
namespace {

struct Case {
  const char* name;
  SoupSize size;
  int dimension;
  bool strict;
  int steps;
  std::uint64_t seeds;
  friend void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }
};

constexpr Case cases[] = {
    {"faces", {9, 4, 0, 0, 6}, 3, false, 6, 12},        {"faces_strict", {8, 4, 0, 0, 3}, 3, true, 3, 8},
    {"everything", {9, 3, 3, 3, 2}, 3, false, 4, 12},   {"everything_strict", {6, 3, 4, 4, 2}, 3, true, 3, 12},
    {"lines", {8, 0, 5, 5, 2}, 3, false, 6, 12},        {"plane", {9, 4, 3, 3, 4}, 2, false, 6, 25},
    {"plane_strict", {7, 4, 3, 3, 2}, 2, true, 3, 25},  {"crowded_plane", {5, 4, 4, 4, 1}, 2, false, 5, 25},
    {"two_edges", {3, 0, 2, 0, 1}, 3, false, 4, 300},   {"few_edges", {4, 0, 3, 1, 2}, 3, false, 4, 40},
    {"few_cells", {3, 2, 2, 1, 2}, 3, false, 4, 40},    {"few_cells_strict", {3, 2, 2, 1, 2}, 3, true, 3, 40},
    {"few_in_plane", {3, 1, 2, 1, 2}, 2, false, 4, 40},
};

class WindowSoup : public ::testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(All, WindowSoup, ::testing::ValuesIn(cases),
                         [](const auto& c) { return std::string(c.param.name); });

WindowOptions options_of(const Case& c) {
  WindowOptions options;
  options.dimension = c.dimension;
  options.strict = c.strict;
  options.max_reports = 1000000;
  options.threads = 2;
  return options;
}

template <class Result>
std::map<PairKey, int> reported(const Result& result) {
  std::map<PairKey, int> contacts;
  for (const FeatureContact& contact : result.reports) ++contacts[key_of(contact)];
  return contacts;
}

void expect_first(const WindowResult& result, const WindowTruth& truth, const LineScene& scene, const Case& c) {
  ASSERT_EQ(result.first.has_value(), !truth.first.empty());
  if (!result.first) return;
  const PairKey key = key_of(result.first->contact);
  EXPECT_EQ(key, *truth.first.begin());
  const int step = truth.first_answer.step;
  const oracle::Time& time = *truth.first_answer.answer.time;
  const double lower = result.first->lower() - step, upper = result.first->contact.first.end - step;
  EXPECT_GE(time.compare(lower), 0);
  EXPECT_LE(time.compare(upper), 0);
  const double next = std::nextafter(result.first->lower(), 100) - step;
  EXPECT_LT(time.compare(next), 0);
  EXPECT_EQ(name(result.first->kind), name(kind_of(key, scene, c.dimension, c.steps, truth.first_answer)));
}

TEST_P(WindowSoup, IsAnsweredByTheDefinitions) {
  std::size_t with_contact = 0, with_intersection = 0, pairs_apart = 0;
  for (std::uint64_t seed = 0; seed < GetParam().seeds; ++seed) {
    SCOPED_TRACE(seed);
    const Case& c = GetParam();
    const LineScene scene = random_line_scene(seed, c.size, c.dimension, c.steps);
    const WorldLines lines = scene.lines();
    const WindowResult result = verify_window(scene.mesh, lines, options_of(c));
    const WindowTruth truth = window_truth(scene, c.dimension, c.steps, c.strict);
    EXPECT_TRUE(result.complete);
    EXPECT_EQ(reported(result), truth.contacts);
    EXPECT_EQ(result.contact_count(), result.reports.size());
    expect_first(result, truth, scene, c);
    std::set<std::pair<std::uint32_t, std::uint32_t>> initial;
    for (const auto& i : result.initial_reports) initial.insert({i.first_cell, i.second_cell});
    EXPECT_EQ(initial, truth.initial);
    with_contact += truth.contacts.empty() ? 0 : 1;
    with_intersection += truth.initial.empty() ? 0 : 1;
    pairs_apart += all_pairs(scene.mesh, c.dimension, c.strict).size() - truth.contacts.size();
  }
  EXPECT_GT(with_contact, 0u);
  EXPECT_GT(with_intersection, 0u);
  EXPECT_GT(pairs_apart, 0u);
}

/// With a window before, a pair that meets as this one begins was counted there.
TEST_P(WindowSoup, LeavesOutWhatGoesOnByTheDefinitions) {
  std::size_t go_on = 0, begin = 0;
  for (std::uint64_t seed = 0; seed < GetParam().seeds; ++seed) {
    SCOPED_TRACE(seed);
    const Case& c = GetParam();
    const LineScene scene = random_line_scene(seed, c.size, c.dimension, c.steps);
    WindowOptions options = options_of(c);
    options.initial = false;
    options.after_step = true;
    const WindowResult result = verify_window(scene.mesh, scene.lines(), options);
    std::map<PairKey, int> expected = window_truth(scene, c.dimension, c.steps, c.strict).contacts;
    std::uint64_t met_before = 0;
    std::erase_if(expected, [&](const auto& counted) {
      const auto answer = decide(counted.first, unit_step(scene, 0), c.dimension);
      const bool before = answer.time && answer.time->compare(0) == 0;
      if (before) met_before += static_cast<std::uint64_t>(counted.second);
      return before;
    });
    EXPECT_TRUE(result.complete);
    EXPECT_EQ(reported(result), expected);
    EXPECT_EQ(result.contact_count(), result.reports.size());
    EXPECT_EQ(result.going_on, met_before);
    EXPECT_EQ(result.first.has_value(), !expected.empty());
    go_on += met_before;
    begin += expected.size();
  }
  EXPECT_GT(go_on + begin, 0U);
  if (GetParam().name == std::string("everything")) {
    EXPECT_GT(go_on, 0U);
    EXPECT_GT(begin, 0U);
  }
}

TEST_P(WindowSoup, WithTwoBreakpointsIsAStep) {
  std::size_t contacts = 0;
  for (std::uint64_t seed = 500; seed < 540; ++seed) {
    SCOPED_TRACE(seed);
    const Step step = random_soup(seed, GetParam().size, GetParam().dimension);
    VerifyOptions step_options;
    step_options.dimension = GetParam().dimension;
    step_options.strict = GetParam().strict;
    step_options.max_reports = 1000000;
    const VerifyResult expected = verify_step(step.mesh, step.x_t0, step.x_t1, step_options);
    const LineScene scene = line_scene_of(step);
    const WindowResult result = verify_window(scene.mesh, scene.lines(), options_of(GetParam()));
    EXPECT_EQ(result.contacts, expected.contacts);
    EXPECT_EQ(reported(result), reported(expected));
    EXPECT_EQ(result.initial_reports, expected.initial_reports);
    ASSERT_EQ(result.first.has_value(), expected.first.has_value());
    if (result.first) {
      EXPECT_EQ(result.first->contact, *expected.first);
      EXPECT_EQ(result.first->lower(), expected.first->first.begin);
      EXPECT_EQ(result.first->contact.first.end, expected.first->first.end);
    }
    contacts += expected.contact_count();
  }
  EXPECT_GT(contacts, 0u);
}

}  // namespace
}  // namespace noli::testing
