// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <sys/stat.h>
#include <filesystem>

#include <fstream>
#include <thread>

#include "tests/app/process.h"
#include "tests/app/scene.h"

namespace noli::app_tests {
namespace {

using Json = nlohmann::json;

class Verify : public testing::Test {
 protected:
  /// Frames with the upper triangle at these heights.
  std::vector<std::string> frames(const std::vector<double>& heights) const {
    std::vector<std::string> arguments = {"verify"};
    for (const double height : heights) {
      arguments.push_back(folder.write("frame" + std::to_string(arguments.size()) + ".ply", two_triangles(height)));
    }
    return arguments;
  }

  static std::vector<std::string> with(std::vector<std::string> arguments, const std::vector<std::string>& more) {
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }

  Folder folder;
};

Json vertex_face_contacts(int count) {
  return {{"vertex_face", count}, {"edge_edge", 0}, {"vertex_edge", 0}, {"vertex_vertex", 0}};
}

TEST_F(Verify, SaysThatNothingTouches) {
  const auto arguments = frames({1, 0.5});
  const Process process = run_noli(arguments);
  EXPECT_EQ(process.exit_code, 0);
  EXPECT_EQ(process.verdict_line().substr(0, 36), "PROVED  2 frames, 1 step: nothing to");
  EXPECT_EQ(process.err, "");
  const Json json = json_of(arguments, 0);
  EXPECT_EQ(json["verdict"], "proved");
  EXPECT_EQ(json["contacts"], vertex_face_contacts(0));
  EXPECT_TRUE(json["first"].is_null());
  EXPECT_TRUE(json["first_time"].is_null());
  EXPECT_EQ(json["statement"]["dimension"], 3);
}

TEST_F(Verify, CountsEveryContactAndFindsTheFirst) {
  const auto arguments = frames({1, -3});
  EXPECT_EQ(run_noli(arguments).exit_code, 1);
  const Json json = json_of(arguments, 1);
  EXPECT_EQ(json["verdict"], "contact");
  EXPECT_EQ(json["complete"], true);
  EXPECT_EQ(json["contacts"], vertex_face_contacts(3));
  EXPECT_EQ(json["initial_intersections"], 0);
  EXPECT_EQ(json["first_time"], 0.25);
  const Json first = {{"pair", "vertex_face"}, {"features", {{3}, {0, 1, 2}}}, {"face", 0},
                      {"cells", {{1}, {0}}},   {"kind", "crossing"},           {"step", 1},
                      {"time", 0.25},          {"point", {1.0, 1.0, 0.0}}};
  EXPECT_EQ(json["first"], first);
  EXPECT_EQ(json["steps"], 1);
  EXPECT_EQ(json["faces"], 2);
  EXPECT_EQ(json["reports"]["listed"], 3);
  EXPECT_EQ(json["reports"]["left_out"], 0);
  EXPECT_EQ(json["reports"]["contacts"][2]["features"], Json({{5}, {0, 1, 2}}));
}

TEST_F(Verify, PrintsTheFirstTimeWith17DigitsRoundedDown) {
  // From 1 to -2: the contact is at 1/3, and the double below it is 0.33333333333333331.
  const Process process = run_noli(frames({1, -2}));
  EXPECT_NE(process.out.find("  t = 0.3333  vertex 3 × face 0"), std::string::npos) << process.out;
  const std::string all = run_noli(with(frames({1, -2}), {"-v"})).out;
  EXPECT_NE(all.find("  t = 0.33333333333333331  crossing  vertex 3 × face 0 at (1, 1, "), std::string::npos) << all;
  const Process json = run_noli(with(frames({1, -2}), {"--json", "-"}));
  EXPECT_NE(json.out.find("\"first_time\": 0.33333333333333331,"), std::string::npos) << json.out;
}

TEST_F(Verify, CountsATouchAtTheVeryEnd) {
  const Json json = json_of(frames({1, 0}), 1);
  EXPECT_EQ(json["contacts"], vertex_face_contacts(3));
  EXPECT_EQ(json["first"]["kind"], "touching");
  EXPECT_EQ(json["first_time"], 1.0);
}

TEST_F(Verify, SaysWhenAFacePiercesAnotherThroughout) {
  const auto a = folder.write("a.ply", sail_through_deck());
  const Json json = json_of({"verify", a, a}, 1);
  EXPECT_EQ(json["verdict"], "contact");
  EXPECT_EQ(json["contacts"], vertex_face_contacts(0));
  EXPECT_EQ(json["initial_intersections"], 1);
  EXPECT_EQ(json["initial_reports"]["intersections"],
            Json::parse(R"([{"cells": [0, 1], "names": ["cell 0", "cell 1"], "step": 1}])"));
  EXPECT_TRUE(json["first"].is_null());
}

TEST_F(Verify, StopsAfterTheFirstStepThatHasAContact) {
  const Json json = json_of(frames({1, 0.5, -0.5, -1, 1}), 1);
  EXPECT_EQ(json["steps"], 2);
  EXPECT_EQ(json["steps_total"], 4);
  EXPECT_EQ(json["first"]["step"], 2);
  EXPECT_EQ(json["first_time"], 0.5);
  EXPECT_EQ(json["contacts"], vertex_face_contacts(3));
}

TEST_F(Verify, KeepsGoingWhenAsked) {
  const Json json = json_of(with(frames({1, 0.5, -0.5, -1, 1}), {"--keep-going"}), 1);
  EXPECT_EQ(json["steps"], 4);
  EXPECT_EQ(json["contacts"], vertex_face_contacts(6));
  EXPECT_EQ(json["per_step"][0]["contacts"], vertex_face_contacts(0));
  EXPECT_EQ(json["per_step"][3]["contacts"], vertex_face_contacts(3));
  EXPECT_EQ(json["first"]["step"], 2);
}

TEST_F(Verify, KeepsGoingBehindWhatIsTooNear) {
  const auto given = with(frames({2, 1, 0.5, 0.5, -0.5, 1}), {"--keep-going", "--min-distance", "0.75"});
  const Json json = json_of(given, 1);
  EXPECT_EQ(json["verdict"], "contact");
  EXPECT_EQ(json["steps"], 5);
  EXPECT_EQ(json["first"]["step"], 4);
  EXPECT_EQ(json["contacts"], vertex_face_contacts(6));
  EXPECT_EQ(json["near"]["step"], 2);
  EXPECT_NE(json["notes"].dump().find(
                "step 2 is the last that was checked for the least distance: something is too near in it"),
            std::string::npos)
      << json["notes"];
  const Json apart = json_of(with(frames({2, 1, 0.5, 1, 2}), {"--keep-going", "--min-distance", "0.75"}), 1);
  EXPECT_EQ(apart["verdict"], "too_near");
  EXPECT_EQ(apart["steps"], 4);
  EXPECT_EQ(apart["near"]["step"], 2);
  const Json contact = json_of(with(frames({2, -1, 0.5, 0.5}), {"--keep-going", "--min-distance", "0.75"}), 1);
  EXPECT_TRUE(contact["near"].is_null());
  EXPECT_NE(contact["notes"].dump().find("step 1 is the last"), std::string::npos);
}

/// Exactly at the least distance at a third of the first step, which no witness shows. No proof goes on behind it.
TEST_F(Verify, KeepsGoingBehindWhatMayBeTooNear) {
  const auto points = [&](const std::string& name, double x, double y) {
    return folder.write(name + ".obj", fmt::format("v 0 0 0\nv {} {} 0\np 1\np 2\n", x, y));
  };
  const std::string a = points("a", 1, 1), b = points("b", 1, -2), c = points("c", 0.25, 0), d = points("d", -0.25, 0);
  const Json may_be = json_of({"verify", a, b, c, "--min-distance", "1", "--keep-going"}, 2);
  EXPECT_EQ(may_be["verdict"], "undecided");
  EXPECT_EQ(may_be["near"]["step"], 1);
  EXPECT_EQ(may_be["near"]["witnessed"], false);
  EXPECT_NE(may_be["notes"].dump().find(
                "step 1 is the last that was checked for the least distance: something may be too near in it"),
            std::string::npos)
      << may_be["notes"];
  const Json meets = json_of({"verify", a, b, c, d, "--min-distance", "1", "--keep-going"}, 1);
  EXPECT_EQ(meets["verdict"], "contact");
  EXPECT_EQ(meets["first"]["step"], 3);
  EXPECT_TRUE(meets["checker"].is_null());
}

TEST_F(Verify, SaysNothingOfTheCheckerWhereItsWitnessIsAboutAnotherStep) {
  const Json json = json_of(with(frames({2, 1, 0.5, 0.5, -0.5, 1}), {"--keep-going", "--min-distance", "0.75"}), 1);
  EXPECT_EQ(json["verdict"], "contact");
  EXPECT_TRUE(json["checker"].is_null()) << json["checker"];
}

TEST_F(Verify, CountsAContactAtABorderOnce) {
  const Json json = json_of(with(frames({1, 0, -1}), {"--keep-going"}), 1);
  EXPECT_EQ(json["steps"], 2);
  EXPECT_EQ(json["per_step"][0]["contacts"], vertex_face_contacts(3));
  EXPECT_EQ(json["per_step"][1]["contacts"], vertex_face_contacts(0));
  EXPECT_EQ(json["reports"]["listed"], 3);
  EXPECT_EQ(json["reports"]["left_out"], 0);
}

TEST_F(Verify, IsContentWithTheFirstContactWhenAsked) {
  const Json json = json_of(with(frames({1, -1}), {"--first-only"}), 1);
  EXPECT_EQ(json["verdict"], "contact");
  EXPECT_FALSE(json["first"].is_null());
  EXPECT_EQ(json_of(with(frames({1, 0.5}), {"--first-only"}), 0)["verdict"], "proved");
}

TEST_F(Verify, ListsNoMoreThanAskedButCountsAll) {
  const auto arguments = with(frames({1, -1}), {"--max-reports", "2"});
  const Json json = json_of(arguments, 1);
  EXPECT_EQ(json["reports"]["contacts"].size(), 2u);
  EXPECT_EQ(json["reports"]["left_out"], 1);
  EXPECT_EQ(json["contacts"], vertex_face_contacts(3));
  EXPECT_NE(run_noli(with(arguments, {"-v"})).out.find("... and 1 more (--max-reports)"), std::string::npos);
}

/// Contacts that go on from step 1 do not take the room of one that begins in step 2.
TEST_F(Verify, ListsNewContactsBesideThoseThatGoOn) {
  const auto frame = [&](const std::string& name, double resting, double falling) {
    return folder.write(name,
                        fmt::format("v 0 0 0\nv 9 0 0\nv 0 9 0\nv 1 1 {0}\nv 2 1 {0}\nv 1 2 {0}\nv 3 3 {1}\nv 3 3 9\n"
                                    "v 4 3 9\nf 1 2 3\nf 4 5 6\nf 7 8 9\n",
                                    resting, falling));
  };
  const Json json = json_of({"verify", "--keep-going", "--max-reports", "2", frame("0.obj", 1, 2), frame("1.obj", 0, 1),
                             frame("2.obj", 0, -1)},
                            1);
  EXPECT_EQ(json["per_step"][0]["goes_on"], false);
  EXPECT_EQ(json["per_step"][0]["first_time"], 1.0);
  EXPECT_EQ(json["per_step"][1]["goes_on"], true);
  EXPECT_EQ(json["per_step"][1]["first_time"], 0.5);
  EXPECT_EQ(json["per_step"][1]["contacts"]["vertex_face"], 1);
  ASSERT_EQ(json["reports"]["contacts"].size(), 2U);
  EXPECT_EQ(json["reports"]["contacts"][1]["step"], 2);
  EXPECT_EQ(json["reports"]["contacts"][1]["features"], Json({{6}, {0, 1, 2}}));
}

TEST_F(Verify, SaysWhatIntersectsBeforeWhatMeetsLater) {
  const auto begin = folder.write("begin.ply", sail_through_deck());
  const Json json = json_of({"verify", begin, begin}, 1);
  ASSERT_EQ(json["initial_intersections"], 1);
  EXPECT_NE(run_noli({"verify", begin, begin}).verdict_line().find("from its beginning  cell 0 × cell 1"),
            std::string::npos);
}

TEST_F(Verify, TakesASingleFrameAtRest) {
  const auto apart = folder.write("apart.ply", two_triangles(1));
  const auto touching = folder.write("touching.ply", two_triangles(0));
  const auto pierced = folder.write("pierced.ply", sail_through_deck());
  EXPECT_EQ(json_of({"verify", apart, "--static"}, 0)["steps"], 1);
  const Json json = json_of({"verify", touching, "--static", "--dimension", "3"}, 1);
  EXPECT_EQ(json["contacts"], vertex_face_contacts(3));
  EXPECT_EQ(json["first"]["kind"], "persistent");
  EXPECT_EQ(json["first_time"], 0.0);
  // The same frame is flat: in its plane, one face covers the other, but no vertex touches an edge.
  const Json flat = json_of({"verify", touching, "--static"}, 1);
  EXPECT_EQ(flat["statement"]["dimension"], 2);
  EXPECT_EQ(flat["initial_intersections"], 1);
  EXPECT_EQ(json_of({"verify", pierced, "--static"}, 1)["initial_intersections"], 1);
  // Intersections in every frame count, not only in the first.
  const Json later = json_of({"verify", apart, pierced, apart, "--static", "--keep-going"}, 1);
  EXPECT_EQ(later["steps"], 3);
  EXPECT_EQ(later["initial_intersections"], 1);
  EXPECT_EQ(later["initial_reports"]["intersections"][0]["step"], 2);
}

TEST_F(Verify, LooksAtOneCellWhenStrict) {
  const auto open = folder.write("open.ply", ply_text({{0, 0, 0}, {4, 0, 1}, {2, 1, 0}}, {{0, 1, 2}}));
  const auto flipped = folder.write("flipped.ply", ply_text({{0, 0, 0}, {4, 0, 1}, {2, -1, 1}}, {{0, 1, 2}}));
  EXPECT_EQ(json_of({"verify", open, flipped}, 0)["verdict"], "proved");
  const Json json = json_of({"verify", open, flipped, "--strict"}, 1);
  EXPECT_EQ(json["contacts"]["vertex_edge"], 1);
  EXPECT_EQ(json["statement"]["strict"], true);
}

TEST_F(Verify, TakesLooseVerticesAsPointsWhenAsked) {
  const auto above = folder.write("above.ply", ply_text({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, 1}}, {{0, 1, 2}}));
  const auto below = folder.write("below.ply", ply_text({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, -1}}, {{0, 1, 2}}));
  const Json without = json_of({"verify", above, below}, 0);
  EXPECT_EQ(without["statement"]["unreferenced_vertices_left_out"], 1);
  const Json with_points = json_of({"verify", above, below, "--points"}, 1);
  EXPECT_EQ(with_points["contacts"], vertex_face_contacts(1));
  EXPECT_EQ(with_points["points"], 1);
}

TEST_F(Verify, MergesVerticesThatAreTheSameThroughoutWhenAsked) {
  // Two adjacent triangles whose common edge has duplicate vertices.
  const std::vector<std::array<VertexId, 3>> faces = {{0, 1, 2}, {3, 4, 5}};
  const auto a =
      folder.write("a.ply", ply_text({{0, 0, 0}, {0, 2, 0}, {2, 1, 0}, {0, 0, 0}, {0, 2, 0}, {-2, 1, 1}}, faces));
  const auto b =
      folder.write("b.ply", ply_text({{0, 0, 1}, {0, 2, 1}, {2, 1, 1}, {0, 0, 1}, {0, 2, 1}, {-2, 1, 2}}, faces));
  EXPECT_EQ(json_of({"verify", a, b}, 1)["statement"]["merged_vertices"], 0);
  const Json merged = json_of({"verify", a, b, "--merge-identical"}, 0);
  EXPECT_EQ(merged["statement"]["merged_vertices"], 2);
}

TEST_F(Verify, DecidesFlatMeshesInTheirPlane) {
  const auto moved = [&](const std::string& name, double x, double z) {
    return folder.write(name, ply_text({{0, 0, z}, {2, 0, z}, {0, 2, z}, {x, 0.25, z}, {x + 2, 0.25, z}, {x + 2, 1, z}},
                                       {{0, 1, 2}, {3, 4, 5}}));
  };
  const auto right = moved("right.ply", 4, 0), nearer = moved("nearer.ply", 3, 0), over = moved("over.ply", 1, 0);
  const auto lifted = moved("lifted.ply", 3, 1);
  EXPECT_EQ(json_of({"verify", right, nearer}, 0)["statement"]["dimension"], 2);
  const Json touch = json_of({"verify", right, over}, 1);
  EXPECT_EQ(touch["statement"]["dimension"], 2);
  EXPECT_EQ(touch["contacts"]["vertex_face"], 0);
  EXPECT_GT(touch["contacts"]["vertex_edge"], 0);
  EXPECT_EQ(json_of({"verify", right, over, "--dimension", "3"}, 1)["statement"]["dimension"], 3);
  EXPECT_EQ(json_of({"verify", right, lifted}, 0)["statement"]["dimension"], 3);
  const Process leaves = run_noli({"verify", right, nearer, lifted});
  EXPECT_EQ(leaves.exit_code, 3);
  EXPECT_NE(leaves.err.find("leaves the plane"), std::string::npos) << leaves.err;
}

TEST_F(Verify, ReadsObjAndMixesFormats) {
  const auto obj =
      folder.write("a.obj", "v 0 0 0\nv 4 0 0\nv 0 4 0\nv 1 1 1\nv 1.5 1 1\nv 1 1.5 1\nf 1 2 3\nf -3 -2 -1\n");
  const auto ply = folder.write("b.ply", two_triangles(-1));
  EXPECT_EQ(json_of({"verify", obj, ply}, 1)["contacts"], vertex_face_contacts(3));
}

TEST_F(Verify, ReadsAFrameFromAPipe) {
  const auto pipe = folder.path("pipe.ply");
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  std::thread writer([&] { std::ofstream(pipe) << two_triangles(1); });
  const Json json = json_of({"verify", pipe, folder.write("b.ply", two_triangles(-1))}, 1);
  writer.join();
  EXPECT_EQ(json["contacts"], vertex_face_contacts(3));
}

TEST_F(Verify, MergingNeedsFiles) {
  const auto pipe = folder.path("pipe.ply");
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_EQ(run_noli({"verify", pipe, folder.write("b.ply", two_triangles(1)), "--merge-identical"}).exit_code, 3);
}

TEST_F(Verify, WhatCanBeReadOnlyOnceIsNotChecked) {
  const auto pipe = folder.path("pipe.ply");
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  std::thread writer([&] { std::ofstream(pipe) << two_triangles(1); });
  const Json json = json_of({"verify", pipe, folder.write("b.ply", two_triangles(0.5))}, 0);
  writer.join();
  EXPECT_EQ(json["verdict"], "no_contact");
}

TEST_F(Verify, GivesTheSameForAnyNumberOfThreads) {
  const auto a = folder.write("a.ply", sheets(2000, 0)), b = folder.write("b.ply", sheets(2000, 3));
  const auto arguments = std::vector<std::string>{"verify", a, b, "--strict", "--threads"};
  const std::string one = without_timing(json_of(with(arguments, {"1"}), 0));
  EXPECT_EQ(one, without_timing(json_of(with(arguments, {"2"}), 0)));
  EXPECT_EQ(one, without_timing(json_of(with(arguments, {"5"}), 0)));
}

TEST_F(Verify, CountsTheContactsOfRealCloth) {
  const auto a = real_data("frames/cloth-funnel/227.ply"), b = real_data("frames/cloth-funnel/228.ply");
  if (!a || !b) GTEST_SKIP() << "no real data";
  const Json one = json_of({"verify", *a, *b, "--threads", "1"}, 1);
  EXPECT_EQ(one["contacts"]["vertex_face"], 27);
  EXPECT_EQ(one["contacts"]["edge_edge"], 107);
  EXPECT_EQ(without_timing(one), without_timing(json_of({"verify", *a, *b, "--threads", "5"}, 1)));
}

TEST_F(Verify, ClearsARealRodTwist) {
  const auto a = real_data("frames/rod-twist-clean/0.ply"), b = real_data("frames/rod-twist-clean/1.ply");
  if (!a || !b) GTEST_SKIP() << "no real data";
  EXPECT_EQ(json_of({"verify", *a, *b}, 0)["verdict"], "proved");
}

}  // namespace
}  // namespace noli::app_tests
