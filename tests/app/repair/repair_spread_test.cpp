// SPDX-License-Identifier: Apache-2.0
//
// Tests `noli repair --spread`: what contact moves takes its surroundings along, and nothing beyond them.
#include <array>
#include <cmath>

#include "tests/app/repair/repair_fixture.h"

namespace noli::app_tests {
namespace {

/// A sheet of 16 by 16 squares of side 1 sinks, as it is, over a triangle that rests below its middle.
class RepairSpread : public Repair {
 protected:
  static constexpr int n = 16, frames = 7;

  void SetUp() override {
    for (int k = 0; k < frames; ++k)
      written_.push_back(folder.write(fmt::format("sheet_{}.ply", k), sheet(0.25 - 0.5 * k)));
  }

  static std::string sheet(double z) {
    std::vector<Position> points = {{5.2, 5.1, 0}, {11.1, 5.3, 0}, {8.2, 11.2, 0}};
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
  written_.resize(4);
  const std::vector<Position> x = last(repaired({"--spread", "1"})), given = positions(written_.back());
  std::size_t moved = 0;
  for (std::size_t v = 3; v < x.size(); ++v) {
    const double from_middle = std::max(std::abs(given[v][0] - 8), std::abs(given[v][1] - 8));
    moved += x[v] != given[v] ? 1 : 0;
    // Contact reaches the vertices from 5 to 12, and each of the two steps after the first one edge further.
    if (from_middle == 8) {
      EXPECT_EQ(x[v], given[v]) << v;
    }
  }
  EXPECT_GT(moved, 50u);
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

}  // namespace
}  // namespace noli::app_tests
