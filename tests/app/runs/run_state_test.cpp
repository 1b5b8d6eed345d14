// SPDX-License-Identifier: Apache-2.0
//
// Tests runs whose states (certify/runs/run_series.h) contain impossible numbers, with correct checksums: every command
// that reads a run refuses them and names the window.
#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <vector>

#include "certify/runs/run_series.h"
#include "tests/app/runs/simulate_fixture.h"
#include "tests/trajectory/run_samples.h"
#include "trajectory/write_file.h"

namespace noli::app_tests {
namespace {

using FrictionAnchors = std::vector<integrator::Anchor<double>>;

/// Changes the state of one window of a run, counted from 1.
void change_state(const std::string& run, std::uint64_t window,
                  const std::function<void(SeriesRow&, FrictionAnchors&)>& change) {
  const fs::path file = trajectory_path(run);
  std::uint64_t states = 0;
  write_file(file, testing::changed(bytes_of(file), [&](std::vector<Block>& blocks) {
               for (Block& block : blocks) {
                 if (block.kind != run_kind::state || ++states != window) continue;
                 WindowState state = decode_state(block.payload);
                 change(state.row, state.anchors);
                 block.payload = encode(state.row, state.anchors);
               }
             }));
}

void change_row(const std::string& run, std::uint64_t window, const std::function<void(SeriesRow&)>& change) {
  change_state(run, window, [&](SeriesRow& row, FrictionAnchors&) { change(row); });
}

struct BadNumber {
  const char* name;
  void (*change)(SeriesRow&);
  std::string message;
  friend void PrintTo(const BadNumber& bad, std::ostream* out) { *out << bad.name; }
};

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

const BadNumber bad_numbers[] = {
    {"time", [](SeriesRow& r) { r.time *= 2; }, "ends at 0.625 s; expected 0.3125 s"},
    {"time_nan", [](SeriesRow& r) { r.time = not_a_number; }, "ends at nan s; expected 0.3125 s"},
    {"vertex", [](SeriesRow& r) { r.nearest.vertices[1] = 0xffffffff; }, "vertex 4294967295; expected one below 3"},
    {"vertex_by_one", [](SeriesRow& r) { r.deepest.vertices[0] = 3; }, "vertex 3; expected one below 3"},
    {"vertex_twice", [](SeriesRow& r) { r.nearest.vertices[0] = r.nearest.vertices[1]; }, "names a vertex twice"},
    {"pair", [](SeriesRow& r) { r.nearest.pair = FeaturePair::edge_edge; }, "a pair of features that 2D does not have"},
    {"layer", [](SeriesRow& r) { r.deepest.layer = std::uint64_t{1} << 32; }, "layer 4294967296; expected"},
    {"layer_nearer", [](SeriesRow& r) { r.nearest.layer = r.deepest.layer + 1; }, "deeper than the deepest"},
    {"layer_none", [](SeriesRow& r) { r.nearest = {}; }, "a deepest layer or a nearest one, not both"},
    {"layer_zero", [](SeriesRow& r) { r.deepest.layer = r.nearest.layer = 0; }, "numbers of a layer that did not act"},
    {"material", [](SeriesRow& r) { r.nearest.material = 1 << 16; }, "material 65536; expected"},
    {"distance", [](SeriesRow& r) { r.nearest.distance = -1; }, "distance -1 m; expected"},
    {"distance_nan", [](SeriesRow& r) { r.nearest.distance = not_a_number; }, "distance nan m; expected"},
    {"distance_farther", [](SeriesRow& r) { r.nearest.distance = 1; }, "farther than the deepest"},
    {"layer_time", [](SeriesRow& r) { r.deepest.time = 0; }, "acts at 0 s; expected"},
    {"layer_time_infinite", [](SeriesRow& r) { r.deepest.time = infinity; }, "acts at inf s; expected"},
    {"halvings", [](SeriesRow& r) { r.halvings = 36; }, "36 halvings; expected at most 35"},
    {"halvings_overflow", [](SeriesRow& r) { r.halvings = std::uint64_t{1} << 31; }, "halvings; expected at most"},
    {"integration", [](SeriesRow& r) { r.integration += 1; }, "J, which is what is left"},
    {"friction", [](SeriesRow& r) { r.damping_work.back() += 1; }, "J, which is what is left"},
    {"materials", [](SeriesRow& r) { r.contact_work.emplace_back(); }, "2 materials; expected the 1 of the window"},
    {"no_materials", [](SeriesRow& r) { r.contact_work.clear(); }, "0 materials; expected the 1 of the window"},
    {"scripts", [](SeriesRow& r) { r.script_work.push_back(0); }, "1 scripts; expected the 0 of the window"},
    {"breakpoints", [](SeriesRow& r) { ++r.breakpoints; }, "breakpoints; expected"},
    {"events", [](SeriesRow& r) { r.events[0] = (std::uint64_t{1} << 53) + 1; }, "events; expected at most"},
    {"bin_above", [](SeriesRow& r) { r.steps.bins.back().number = std::numeric_limits<std::int64_t>::max(); },
     "the bin 9223372036854775807; expected"},
    {"bin_by_one", [](SeriesRow& r) { r.steps.bins.back().number = step_bin(0.0625) + 1; },
     "expected bins of steps from"},
    {"bin_below", [](SeriesRow& r) { r.steps.bins.front().number = -4093; }, "the bin -4093; expected"},
    {"bin_far_below", [](SeriesRow& r) { r.steps.bins.front().number = std::numeric_limits<std::int64_t>::min(); },
     "the bin -9223372036854775808; expected"},
    {"ticks", [](SeriesRow& r) { ++r.steps.bins.back().ticks; }, "more than 4294967296 ticks in its bins"},
    {"ticks_overflow", [](SeriesRow& r) { r.steps.bins.back().ticks = ~std::uint64_t{0}; },
     "more than 4294967296 ticks in its bins"},
    {"ticks_zero",
     [](SeriesRow& r) {
       r.steps.bins.insert(r.steps.bins.begin(), {-4092, 0});
     },
     "an empty bin"},
    {"no_bins", [](SeriesRow& r) { r.steps.bins.clear(); }, "0 ticks in its bins; expected 4294967296"},
    {"smallest", [](SeriesRow& r) { r.steps.smallest = infinity; }, "a smallest step of inf s; expected"},
    {"smallest_zero", [](SeriesRow& r) { r.steps.smallest = 0; }, "a smallest step of 0 s; expected"},
    {"smallest_long", [](SeriesRow& r) { r.steps.smallest = 1; }, "a smallest step of 1 s; expected"},
};

class RunState : public Simulate {
 protected:
  void SetUp() override {
    file_ = scene(bouncing_point());
    ASSERT_EQ(run_noli({"simulate", file_, "-o", run_path("run")}).exit_code, 0);
    fs::remove(run_path("run/log.jsonl"));
    fs::remove(run_path("run/proof.blocks"));
  }

  /// All commands that read a run.
  std::vector<std::vector<std::string>> commands() const {
    const std::string run = run_path("run");
    return {{"verify", run},
            {"verify", run, "--reproduce"},
            {"explain", run},
            {"report", run, "-o", run_path("page.html"), "--force"},
            {"export", run, "-o", run_path("frames/%d.ply"), "--force"},
            {"export", run, "--figure", "step-histogram", "-o", run_path("steps.svg"), "--force"},
            {"export", run, "--figure", "energy", "-o", run_path("energy.csv"), "--force"},
            {"info", run},
            {"simulate", file_, "-o", run, "--resume"},
            {"simulate", file_, "--reproduce", run, "--window", "12", "-o", run_path("block")}};
  }

  std::string file_;
};

bool is_missing(const Process& process) { return process.err.find("built without") != std::string::npos; }

std::string joined(const std::vector<std::string>& words) {
  std::string all;
  for (const std::string& word : words) all += word + " ";
  return all;
}

class BadState : public RunState, public ::testing::WithParamInterface<BadNumber> {};
INSTANTIATE_TEST_SUITE_P(All, BadState, ::testing::ValuesIn(bad_numbers),
                         [](const auto& bad) { return bad.param.name; });

TEST_P(BadState, IsRefusedByEveryCommand) {
  change_row(run_path("run"), 5, GetParam().change);  // the point is in contact
  ProcessOptions options;
  options.address_space = 4'000'000'000;
  for (const auto& command : commands()) {
    const Process process = run_noli(command, options);
    EXPECT_EQ(process.exit_code, 3) << joined(command) << process.out << process.err;
    if (is_missing(process)) continue;
    EXPECT_NE(process.err.find("trajectory.blocks: the state of window 5: "), std::string::npos)
        << joined(command) << process.err;
    EXPECT_NE(process.err.find(GetParam().message), std::string::npos) << joined(command) << process.err;
  }
}

TEST_F(RunState, WhatIsNotChangedIsAccepted) {
  change_row(run_path("run"), 5, [](SeriesRow&) {});
  for (const auto& command : commands()) {
    const Process process = run_noli(command);
    EXPECT_EQ(process.exit_code, is_missing(process) ? 3 : 0) << joined(command) << process.err;
  }
}

TEST_F(RunState, EnergiesMayBeBeyondAllDoubles) {
  change_row(run_path("run"), 5, [](SeriesRow& row) {
    row.kinetic = row.kinetic_mean = infinity;
    row.potential.fill(not_a_number);
    row.work[0] = -infinity;
    row.momentum = {infinity, -infinity, not_a_number};
  });
  for (const auto& command : commands()) {
    const Process process = run_noli(command);
    EXPECT_EQ(process.exit_code, is_missing(process) ? 3 : 0) << joined(command) << process.err;
  }
}

TEST_F(RunState, AnchorsAreThoseOfTheWindow) {
  using Anchor = integrator::Anchor<double>;
  const Anchor good{{0, 1, FeaturePair::vertex_edge, {0, 1, 2, 0}}, {1, -0.5, -0.5, 0}, 0.3125};
  struct Bad {
    void (*change)(Anchor&);
    std::string message;
  };
  const std::vector<Bad> all{
      {[](Anchor& a) { a.of.material = 1; }, "an anchor of material 1; expected one below 1"},
      {[](Anchor& a) { a.of.layer = 0; }, "an anchor of layer 0; expected one from 1 on"},
      {[](Anchor& a) { a.of.kind = FeaturePair::vertex_face; },
       "an anchor between a pair of features that 2D does not have"},
      {[](Anchor& a) { a.of.vertices[2] = 3; }, "an anchor at vertex 3; expected one below 3"},
      {[](Anchor& a) { a.of.vertices[2] = 0; }, "an anchor that names a vertex twice"},
      {[](Anchor& a) { a.weights[1] = not_a_number; }, "an anchor with the weight nan; expected one from -1 to 1"},
      {[](Anchor& a) { a.until = 0.3; }, "an anchor that ends at 0.3 s; expected a time from 0.3125 s to"},
      {[](Anchor& a) { a.until = infinity; }, "an anchor that ends at inf s"}};
  for (const Bad& bad : all) {
    Anchor anchor = good;
    bad.change(anchor);
    change_state(run_path("run"), 5, [&](SeriesRow&, FrictionAnchors& anchors) { anchors = {anchor}; });
    const Process process = run_noli({"info", run_path("run")});
    EXPECT_EQ(process.exit_code, 3) << bad.message;
    EXPECT_NE(process.err.find("the state of window 5: " + bad.message), std::string::npos) << process.err;
  }
  Anchor deeper = good;
  deeper.of.layer = 2;
  for (const FrictionAnchors& unsorted : {FrictionAnchors{good, good}, FrictionAnchors{deeper, good}}) {
    change_state(run_path("run"), 5, [&](SeriesRow&, FrictionAnchors& anchors) { anchors = unsorted; });
    const Process process = run_noli({"info", run_path("run")});
    EXPECT_EQ(process.exit_code, 3);
    EXPECT_NE(process.err.find("the state of window 5: anchors that do not ascend"), std::string::npos) << process.err;
  }
  change_state(run_path("run"), 5, [&](SeriesRow&, FrictionAnchors& anchors) { anchors = {good, deeper}; });
  EXPECT_EQ(run_noli({"info", run_path("run")}).exit_code, 0);
}

TEST_F(RunState, HalvingsDoNotGetFewer) {
  change_row(run_path("run"), 3, [](SeriesRow& row) { row.halvings = 1; });
  const Process process = run_noli({"info", run_path("run")});
  EXPECT_EQ(process.exit_code, 3);
  EXPECT_NE(process.err.find("the state of window 4: 0 halvings; expected at least 1"), std::string::npos)
      << process.err;
}

TEST_F(RunState, StatesOfOtherProgramsAreTheirs) {
  const fs::path file = trajectory_path(run_path("run"));
  write_file(file, testing::changed(bytes_of(file), [](std::vector<Block>& blocks) {
               for (Block& block : blocks) {
                 if (block.kind == run_kind::state) block.payload = "theirs";
               }
             }));
  for (const std::string command : {"verify", "info"}) {
    EXPECT_EQ(run_noli({command, run_path("run")}).exit_code, 0) << command;
  }
  EXPECT_EQ(run_noli({"explain", run_path("run")}).exit_code, 3);
}

}  // namespace
}  // namespace noli::app_tests
