// SPDX-License-Identifier: Apache-2.0
//
// Tests `noli repair --spread`: what contact moves takes its surroundings along, and nothing beyond them.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

#include "tests/app/repair/repair_fixture.h"

namespace noli::app_tests {
namespace {

/// A sheet of 16 by 16 squares of side 1 sinks, as it is, over a triangle that rests below its middle.
class RepairSpread : public Repair {
 protected:
  static constexpr int n = 16, frames = 7;

  void SetUp() override { write_frames(frames); }

  void write_frames(int count) {
    written_.clear();
    for (int k = 0; k < count; ++k) {
      written_.push_back(folder.write(fmt::format("sheet_{}.ply", k), sheet(0.25 - 0.5 * k)));
    }
  }

  std::string sheet(double z) const {
    std::vector<Position> points = {{5.2, 5.1, 0}, {11.1, 5.3, 0}, {8.2, 11.2, 0}};
    if (corner_) points = {{0.2, 0.1, 0}, {3.1, 0.3, 0}, {0.4, 3.2, 0}};
    std::vector<std::array<VertexId, 3>> faces = {{0, 1, 2}};
    for (int i = 0; i <= n; ++i) {
      for (int j = 0; j <= n; ++j) points.push_back({1.0 * i, 1.0 * j, z});
    }
    for (VertexId i = 0; i < n; ++i) {
      for (VertexId j = 0; j < n; ++j) {
        const VertexId a = 3 + i * (n + 1) + j, b = a + n + 1;
        faces.push_back({a, b, a + 1});
        faces.push_back({b, b + 1, a + 1});
      }
    }
    return ply_text(points, faces);
  }

  Json repaired(const Words& more) const {
    Words words = {"--fixed-first", "3", "--force"};
    words.insert(words.end(), more.begin(), more.end());
    return json_of(repair(written_, words), 0);
  }
  std::vector<Position> last(const Json& json) const { return positions(out(json["frames"].get<std::size_t>() - 1)); }

  /// Of the edges along the squares' sides, which are 1 as given.
  static double longest_edge(const std::vector<Position>& x) {
    double longest = 0;
    for (std::size_t i = 0; i <= n; ++i) {
      for (std::size_t j = 0; j < n; ++j) {
        const std::size_t along = 3 + i * (n + 1) + j, across = 3 + j * (n + 1) + i;
        for (const auto& [a, b] : {std::array{along, along + 1}, std::array{across, across + n + 1}}) {
          longest = std::max(longest, std::hypot(x[a][0] - x[b][0], x[a][1] - x[b][1], x[a][2] - x[b][2]));
        }
      }
    }
    return longest;
  }

  bool corner_ = false;
  Words written_;
};

TEST_F(RepairSpread, SurroundingsComeAlong) {
  const Json alone = repaired({});
  EXPECT_EQ(alone["verdict"], "proved");
  EXPECT_EQ(alone["spread"], 0);
  const double torn = longest_edge(last(alone));
  const Json spread = repaired({"--spread", "3"});
  EXPECT_EQ(spread["verdict"], "proved");
  EXPECT_EQ(spread["spread"], 3);
  EXPECT_EQ(verify_out().exit_code, 0);
  EXPECT_LT(longest_edge(last(spread)) - 1, (torn - 1) / 2) << torn;
  EXPECT_GT(spread["changed"].back()["moved"], 2 * alone["changed"].back()["moved"].get<int>());
}

TEST_F(RepairSpread, BeyondThemNothingMoves) {
  // The triangle is in a corner, below the vertices from 0 to 4; the step after the first spreads over 9 edges at most.
  corner_ = true;
  write_frames(3);
  const std::vector<Position> x = last(repaired({"--spread", "3"})), given = positions(written_.back());
  std::size_t moved = 0, near = 0;
  for (std::size_t v = 3; v < x.size(); ++v) {
    const double from_corner = std::max(given[v][0], given[v][1]);
    moved += x[v] != given[v] ? 1 : 0;
    near += from_corner < 8 ? 1 : 0;
    if (from_corner > 13) {
      EXPECT_EQ(x[v], given[v]) << v;
    }
  }
  EXPECT_GT(moved, near / 2) << "what is near comes along";
}

TEST_F(RepairSpread, IsAnotherRepairWhenResumed) {
  ASSERT_EQ(repaired({"--spread", "2"})["verdict"], "proved");
  const auto whole = read_text(out(6)), table = read_text(folder.path("out/times.csv"));
  folder.write("out/times.csv", table.substr(0, table.size() / 2));
  Words words = repair(written_, {"--fixed-first", "3", "--resume"});
  EXPECT_EQ(run_noli(words).exit_code, 3) << "without --spread it is another repair";
  words.insert(words.end(), {"--spread", "2"});
  EXPECT_EQ(run_noli(words).exit_code, 0);
  EXPECT_EQ(read_text(out(6)), whole);
  EXPECT_EQ(read_text(folder.path("out/times.csv")), table);
}

TEST_F(RepairSpread, DeepContactWithoutItGetsAdvice) {
  const Process alone = run_noli(repair(written_, {"--fixed-first", "3"}));
  EXPECT_NE(alone.out.find("--spread"), std::string::npos) << alone.out;
  const Process spread = run_noli(repair(written_, {"--fixed-first", "3", "--spread", "3", "--force"}));
  EXPECT_EQ(spread.out.find("--spread"), std::string::npos) << spread.out;
}

/// A cloth of 30 by 30 squares, which falls through a moving ball of radius 0.22 in frames that ignore contact.
class RepairDrape : public Repair {
 protected:
  static constexpr VertexId ball = 1026;

  void SetUp() override {
    fs::create_directory(made_);
    const std::string command = std::string(NOLI_UNTIDY_FRAMES) + " drape 30 '" + made_ + "' > /dev/null";
    ASSERT_EQ(std::system(command.c_str()), 0);
  }

  /// How far the cloth is in the ball, in frame k as given.
  double depth(int k) const {
    const auto x = positions(fmt::format("{}/{:03}.ply", made_, k));
    double deepest = 0;
    for (VertexId v = ball; v < x.size(); ++v) {
      deepest = std::max(deepest, 0.22 - std::hypot(x[v][0] - 0.002 * k, x[v][1], x[v][2] + 0.1 - 0.004 * k));
    }
    return deepest;
  }

  std::string made_ = folder.path("drape");
};

TEST_F(RepairDrape, SlowMovesNoMoreThanTwiceTheDepth) {
  const Json json =
      json_of(repair({made_}, {"--fixed-first", std::to_string(ball), "--spread", "5", "--friction", "0.3"}), 0);
  EXPECT_EQ(json["verdict"], "proved");
  EXPECT_GT(json["changed"].size(), 40u);
  EXPECT_GT(json["copied"], 10) << "frames before the cloth touches";
  double deepest = 0;
  for (const Json& step : json["changed"]) {
    // Where the cloth is on its way out, what was moved before goes back slowly: the depth so far is what counts.
    deepest = std::max(deepest, depth(step["step"].get<int>()));
    EXPECT_LE(step["largest"], 2 * std::max(deepest, 0.05)) << step;
  }
  EXPECT_GT(deepest, 0.2);
}

}  // namespace
}  // namespace noli::app_tests
