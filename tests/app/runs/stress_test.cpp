// SPDX-License-Identifier: Apache-2.0
//
// Tests scenes that need much memory and time (scenes/stress). Each ends with a verdict within two gigabytes of address
// space and its --time-limit, and each except one runs to its end. Tests read the effect of a scene from its result.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <numeric>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tests/app/runs/knots.h"
#include "tests/app/runs/simulate_fixture.h"
#include "trajectory/blocks/run_file.h"

namespace noli::app_tests {
namespace {

double mean_height(std::span<const Position> x) {
  double sum = 0;
  for (const Position& p : x) sum += p[2];
  return sum / static_cast<double>(x.size());
}

class StressSlow : public Simulate {
 protected:
  Process simulate_file(const std::string& file, const std::string& limit) const {
    ProcessOptions options;
    options.address_space = 2'000'000'000;
    return run_noli({"simulate", file, "-o", run_path("run"), "--time-limit", sanitized ? "600s" : limit}, options);
  }
  Process simulate(const std::string& name, const std::string& limit) const {
    return simulate_file((fs::path(NOLI_SOURCE_DIR) / "scenes/stress" / (name + ".json")).string(), limit);
  }

  /// Expects a run that reached its end.
  void expect_whole(const Process& process) const {
    ASSERT_EQ(process.exit_code, 0) << process.out << process.err;
    ASSERT_NE(process.out.find("NO CONTACT"), std::string::npos) << process.out;
    std::printf("at most %.0f MB\n", static_cast<double>(process.peak_bytes) * 1e-6);
  }

  Json explained() const { return json_of({"explain", run_path("run")}, 0); }

  /// The positions of all vertices at the end.
  std::vector<Position> end() const {
    RunReader reader(run_path("run"));
    std::vector<Position> last;
    while (const auto window = reader.next_window()) last = window->positions;
    return last;
  }
  /// Mean heights of `count` bodies of equally many vertices, from vertex `first` on.
  static std::vector<double> heights(const std::vector<Position>& x, std::size_t first, std::size_t count,
                                     std::size_t vertices) {
    std::vector<double> result;
    for (std::size_t i = 0; i < count; ++i) {
      result.push_back(mean_height(std::span(x).subspan(first + i * vertices, vertices)));
    }
    return result;
  }
};

TEST_F(StressSlow, BeadsIntoEightSheets) {
  expect_whole(simulate("beads", "200s"));
  const Json run = explained();
  EXPECT_GT(run["events"]["contact"], 1'000'000);
  const double plans = run["timing"]["certificates"]["plans"], impulses = run["events"]["contact"];
  EXPECT_LT(10 * plans, impulses);
  const std::vector<double> sheets = heights(end(), 0, 8, 81);
  EXPECT_TRUE(std::ranges::is_sorted(sheets)) << "none goes through another";
  EXPECT_LT(sheets.front(), -0.5) << "the momentum goes through all";
}

TEST_F(StressSlow, ABulletAgainstASheetsEdge) {
  expect_whole(simulate("bullet", "60s"));
  const std::string deepest = explained()["deepest"]["names"];
  EXPECT_NE(deepest.find("sheet["), std::string::npos) << deepest;
  EXPECT_NE(deepest.find("bullet["), std::string::npos) << deepest;
  const std::vector<Position> x = end();
  EXPECT_LT(mean_height(std::span(x).subspan(441)), -0.5);
  double lowest = 0;
  for (const Position& p : std::span(x).first(441)) lowest = std::min(lowest, p[2]);
  EXPECT_LT(lowest, -0.02) << "the edge is bent down";
}

TEST_F(StressSlow, SheetsAMicrometreApart) {
  expect_whole(simulate("micrometre", "60s"));
  const Json run = explained();
  EXPECT_LT(run["nearest"]["distance"], 0.7e-6);
  EXPECT_GT(run["deepest"]["layer"], 50);
  EXPECT_TRUE(std::ranges::is_sorted(heights(end(), 0, 3, 49)));
}

TEST_F(StressSlow, TwentySheetsFallOnEachOther) {
  expect_whole(simulate("twenty_sheets", "400s"));
  const std::vector<double> sheets = heights(end(), 0, 20, 81);
  EXPECT_TRUE(std::ranges::is_sorted(sheets));
  EXPECT_GT(sheets.front(), 0);
  EXPECT_LT(sheets.back(), 0.1) << "it began at 0.21 m";
}

TEST_F(StressSlow, APressGoesToFourTenthsOfAMillimetre) {
  expect_whole(simulate("press", "200s"));
  const std::vector<Position> x = end();
  for (const Position& p : std::span(x).first(75)) {
    ASSERT_GT(p[2], 0);
    ASSERT_LT(p[2], 0.0004);
  }
  EXPECT_TRUE(std::ranges::is_sorted(heights(x, 0, 3, 25)));
}

TEST_F(StressSlow, SixWallsCrushASheetToATenth) {
  expect_whole(simulate("crush", "400s"));
  EXPECT_GT(explained()["deepest"]["layer"], 5);
  const std::vector<Position> x = end();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto [low, high] =
        std::ranges::minmax(std::span(x).first(289), {}, [axis](const Position& p) { return p[axis]; });
    EXPECT_LT(high[axis] - low[axis], 0.012) << "walls that began 0.12 m apart";
    EXPECT_GT(high[axis] - low[axis], 0.0115);
  }
}

TEST_F(StressSlow, InterlockedRingsArePulled) {
  expect_whole(simulate("rings", "100s"));
  const std::vector<Position> x = end();
  constexpr std::size_t segments = 36, sides = 8;
  std::vector<Curve> rings(3);
  for (std::size_t ring = 0; ring < 3; ++ring) {
    for (std::size_t i = 0; i < segments; ++i) {
      Position mean{};
      for (std::size_t j = 0; j < sides; ++j) {
        for (std::size_t d = 0; d < 3; ++d) mean[d] += x[(ring * segments + i) * sides + j][d] / sides;
      }
      rings[ring].push_back(mean);
    }
    const auto [low, high] = std::ranges::minmax(rings[ring], {}, [](const Position& p) { return p[0]; });
    EXPECT_GT(high[0] - low[0], 0.105) << "of 0.1 m: ring " << ring + 1 << " is stretched";
  }
  EXPECT_EQ(std::abs(linking_number(rings[0], rings[1])), 1);
  EXPECT_EQ(std::abs(linking_number(rings[1], rings[2])), 1);
  EXPECT_EQ(linking_number(rings[0], rings[2]), 0);
}

TEST_F(StressSlow, AnObstacleSwellsUnderACloth) {
  expect_whole(simulate("swell", "100s"));
  const std::vector<Position> x = end();
  const auto height = [](const Position& p) { return p[2]; };
  const double hill = std::ranges::max(std::span(x).subspan(289), {}, height)[2];
  EXPECT_NEAR(hill, 0.05, 1e-6) << "the last of the OBJ files";
  EXPECT_GT(std::ranges::max(std::span(x).first(289), {}, height)[2], hill);
  EXPECT_GT(mean_height(std::span(x).first(289)), 0.02) << "it lies on the hill, and began at 4 mm";
}

/// The box is lifted by 0.1 m until 1.4 s, then held for ten seconds.
TEST_F(StressSlow, ABoxIsGrippedLiftedAndHeld) {
  expect_whole(simulate("grip", "200s"));
  RunReader reader(run_path("run"));
  std::vector<double> heights;  // at the ends of windows of 0.01 s, from the end of the lift on
  while (const auto window = reader.next_window()) {
    if (window->end > 1.495) heights.push_back(mean_height(std::span(window->positions).first(26)));
  }
  ASSERT_GT(heights.size(), 1000U);
  const auto mean = [](std::span<const double> all) {
    return std::accumulate(all.begin(), all.end(), 0.0) / static_cast<double>(all.size());
  };
  const double lifted = mean(std::span(heights).first(100)), held = mean(std::span(heights).last(100));
  const auto [lowest, highest] = std::ranges::minmax(heights);
  std::printf("held at %.7f m on average in the first second, at %.7f m in the last, from %.7f to %.7f m\n", lifted,
              held, lowest, highest);
  EXPECT_GT(lifted, 0.145);
  EXPECT_NEAR(held, lifted, 2e-7) << "a fiftieth of a micrometre a second";
  EXPECT_LT(highest - lowest, 5e-6) << "it trembles";
}

/// The deeper the layers, the more work: this scene never reaches its end. Its windows end early, so that it stops at
/// the time limit and can be resumed.
TEST_F(StressSlow, APinchEndsWithItsTime) {
  const Process process = simulate("pinch", "20s");
  EXPECT_EQ(process.exit_code, 2) << process.out << process.err;
  EXPECT_NE(process.out.find("UNDECIDED"), std::string::npos) << process.out;
  EXPECT_NE(process.out.find("Out of time"), std::string::npos) << process.out;
  std::printf("at most %.0f MB\n", static_cast<double>(process.peak_bytes) * 1e-6);
  const Json run = explained();
  EXPECT_GT(run["time"], 0.02);
  EXPECT_GT(run["windows"].get<double>(), run["time"].get<double>() / 0.002 + 1) << "windows end early";
}

/// Ten thousand layers act from the start, with steps up to a million times shorter than the first layer's: the window
/// would have about a billion breakpoints.
TEST_F(StressSlow, APointTenThousandLayersDeepOnBothSides) {
  Json json = {{"noli_scene", 1}, {"dimension", 2}, {"duration", 1}, {"window", 0.01}};
  json["bodies"] = Json::parse(R"([
      {"name": "floor", "mesh": {"chain": {"points": [[-1, 0], [1, 0]], "segments": 1}}, "pin": ["all"],
       "material": {"edge_stiffness": 0, "mass_per_length": 1}},
      {"name": "ceiling", "mesh": {"chain": {"points": [[-1, 0.02], [1, 0.02]], "segments": 1}}, "pin": ["all"],
       "material": {"edge_stiffness": 0, "mass_per_length": 1}},
      {"name": "point", "mesh": {"points": {"at": [[0.1, 0.01]]}}, "velocity": [0, -1],
       "material": {"edge_stiffness": 0, "mass_per_vertex": 1}}])");
  json["contact"] = {{"thickness", 0.1}, {"stiffness", 100}, {"most_layers", 100000}};
  const Process process = simulate_file(scene(json), "10s");
  std::printf("at most %.0f MB\n", static_cast<double>(process.peak_bytes) * 1e-6);
  EXPECT_EQ(process.exit_code, 2) << process.out << process.err;
  EXPECT_NE(process.out.find("Out of time"), std::string::npos) << process.out;
  EXPECT_LT(process.peak_bytes, 1'500'000'000U);
}

}  // namespace
}  // namespace noli::app_tests
