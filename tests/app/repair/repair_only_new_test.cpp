// SPDX-License-Identifier: Apache-2.0
//
// Tests `noli repair --only-new`: what intersects in the first frame may go on so, and all else is kept apart.
#include <cmath>

#include "tests/app/repair/repair_fixture.h"

namespace noli::app_tests {
namespace {

class RepairOnlyNew : public Repair {
 protected:
  /// A sail stands through a deck and slides in it; a plate above sinks to a height.
  std::string frame(const char* name, double slid, double height) const {
    const std::vector<Position> points = {{0, 0, 0},         {8, 0, 0},        {0, 8, 0},
                                          {1 + slid, 1, -1}, {1 + slid, 1, 1}, {2 + slid, 1, 1},
                                          {3, 0.5, height},  {4, 0.5, height}, {3, 1.5, height}};
    return folder.write(name, ply_text(points, {{0, 1, 2}, {3, 4, 5}, {6, 7, 8}}));
  }
  Words sinking() const { return {frame("a_0.ply", 0, 1), frame("a_1.ply", 0.25, -0.5), frame("a_2.ply", 0.5, -0.25)}; }
};

TEST_F(RepairOnlyNew, WhatIntersectsAtFirstGoesOnAndTheRestIsKeptApart) {
  const Words frames = sinking();
  const Process without = run_noli(repair(frames));
  EXPECT_EQ(without.exit_code, 1);
  EXPECT_NE(without.out.find("--only-new"), std::string::npos) << without.out;
  const Json json = json_of(repair(frames, {"--only-new", "--force", "--fixed-first", "3"}), 0);
  EXPECT_EQ(json["verdict"], "proved");
  EXPECT_EQ(json["baseline"], 1);
  EXPECT_EQ(json["changed"].size(), 2u);
  const auto last = positions(out(json["frames"].get<std::size_t>() - 1)), given = positions(frames[2]);
  for (VertexId v = 3; v < 6; ++v) EXPECT_EQ(last[v], given[v]) << "the sail goes where it was given";
  for (VertexId v = 6; v < 9; ++v) EXPECT_GT(last[v][2], 0) << "the plate does not";
  EXPECT_EQ(run_noli({"verify", "--only-new", folder.path("out")}).exit_code, 0);
  EXPECT_EQ(run_noli({"verify", folder.path("out")}).exit_code, 1);
}

TEST_F(RepairOnlyNew, WhatIsFreeButForThatStaysByteForByte) {
  const Words frames = {frame("b_0.ply", 0, 3), frame("b_1.ply", 0.25, 2), frame("b_2.ply", 0.5, 1)};
  const Json json = json_of(repair(frames, {"--only-new"}), 0);
  EXPECT_EQ(json["copied"], 3);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(read_text(out(k)), read_text(frames[k])) << k;
}

TEST_F(RepairOnlyNew, FixedCellsThatIntersectAtFirstBlockNothing) {
  // All is fixed but the plate; its own way is free.
  const Words frames = {frame("c_0.ply", 0, 3), frame("c_1.ply", 0.25, -1)};
  const Json json = json_of(repair(frames, {"--only-new", "--fixed-first", "6"}), 0);
  EXPECT_EQ(json["verdict"], "proved");
  const Json blocked = json_of(repair(frames, {"--only-new", "--fixed-first", "9", "--force"}), 1);
  EXPECT_EQ(blocked["end"], "blocked");
}

TEST_F(RepairOnlyNew, FixedCellsThatPartAndMeetAgainBlockNothing) {
  const Words frames = {frame("e_0.ply", 0, 3), frame("e_1.ply", 10, 2), frame("e_2.ply", 0, -1)};
  const Json json = json_of(repair(frames, {"--only-new", "--fixed-first", "6"}), 0);
  EXPECT_EQ(json["verdict"], "proved");
  EXPECT_EQ(json["baseline"], 1);
  EXPECT_EQ(json["changed"].size(), 1u);
}

TEST_F(RepairOnlyNew, GroupsMayPassTooAndTheAnswerSaysBoth) {
  const std::string groups = folder.write(
      "groups.json", R"({"groups": {"deck": [[0, 2]], "plate": [[6, 8]]}, "ignore": [["deck", "plate"]]})");
  const Json json = json_of(repair(sinking(), {"--only-new", "--ignore", groups}), 0);
  EXPECT_EQ(json["verdict"], "proved");
  EXPECT_TRUE(json["changed"].empty());
  EXPECT_NE(json["stated"], "nothing touches");
  const Json alone = json_of(repair(sinking(), {"--only-new", "--force"}), 0);
  EXPECT_NE(alone["stated"].get<std::string>().find("1 pair of cells that intersects"), std::string::npos)
      << alone["stated"];
}

TEST_F(RepairOnlyNew, NeighboursOfWhatIntersectsAreKeptApart) {
  // A sail of two faces: one stands through the deck, the other is before it, and would sink through with its edge.
  const auto sail = [&](const char* name, double z) {
    const std::vector<Position> points = {{0, 0, 0}, {8, 0, 0}, {0, 8, 0},    {1, 1, -1},
                                          {1, 1, 1}, {3, 1, 1}, {3.5, 1.5, z}};
    return folder.write(name, ply_text(points, {{0, 1, 2}, {3, 4, 5}, {4, 5, 6}}));
  };
  const Words frames = {sail("d_0.ply", 0.75), sail("d_1.ply", -0.5)};
  const Json json = json_of(repair(frames, {"--only-new", "--fixed-first", "3"}), 0);
  EXPECT_EQ(json["verdict"], "proved");
  EXPECT_EQ(json["baseline"], 1);
  EXPECT_EQ(json["changed"].size(), 1u);
  EXPECT_GT(positions(out(json["frames"].get<std::size_t>() - 1))[6][2], 0);
}

TEST_F(RepairOnlyNew, ResumesToTheSameBytes) {
  const Words frames = sinking();
  ASSERT_EQ(run_noli(repair(frames, {"--only-new"})).exit_code, 0);
  const std::string table = read_text(folder.path("out/times.csv")), last = read_text(out(2));
  folder.write("out/times.csv", table.substr(0, table.find("\n001") + 1));
  EXPECT_EQ(run_noli(repair(frames, {"--resume"})).exit_code, 3) << "without --only-new it is another repair";
  EXPECT_EQ(run_noli(repair(frames, {"--resume", "--only-new"})).exit_code, 0);
  EXPECT_EQ(read_text(folder.path("out/times.csv")), table);
  EXPECT_EQ(read_text(out(2)), last);
}

}  // namespace
}  // namespace noli::app_tests
