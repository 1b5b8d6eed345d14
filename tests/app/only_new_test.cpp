// SPDX-License-Identifier: Apache-2.0
//
// Tests `noli verify --only-new`: what intersects in the first frame is listed and not compared, all else is.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "tests/app/process.h"
#include "tests/app/runs/simulate_fixture.h"
#include "tests/app/scene.h"

namespace noli::app_tests {
namespace {

using Words = std::vector<std::string>;

class OnlyNew : public testing::Test {
 protected:
  /// Face 1 pierces face 0 from the beginning and slides in it. Face 2 is above; at height -1 it has gone through.
  std::string frame(double slid, double height) const {
    static int count = 0;
    const std::vector<Position> points = {{0, 0, 0},         {4, 0, 0},           {0, 4, 0},
                                          {1 + slid, 1, -1}, {1 + slid, 1, 1},    {1.5 + slid, 1, 1},
                                          {2, 0.5, height},  {2.25, 0.5, height}, {2, 0.75, height}};
    return folder.write(std::to_string(++count) + ".ply", ply_text(points, {{0, 1, 2}, {3, 4, 5}, {6, 7, 8}}));
  }
  Words apart() const { return {frame(0, 5), frame(0.25, 3), frame(0.5, 2)}; }
  Words through() const { return {frame(0, 5), frame(0.25, 3), frame(0.5, -1)}; }

  Process verify(const Words& frames, const Words& more = {}) const {
    Words words = {"verify", "--force", "--proof", proof(), "--claim-out", claim()};
    words.insert(words.end(), more.begin(), more.end());
    words.insert(words.end(), frames.begin(), frames.end());
    return run_noli(words);
  }
  /// By both checkers, where both are built; they agree.
  int check(const Words& frames, const Words& more) const {
    Words words = {"check", proof()};
    words.insert(words.end(), frames.begin(), frames.end());
    words.insert(words.end(), more.begin(), more.end());
    const int code = run_noli(words).exit_code;
    if (verified_checker_is_there()) {
      words.emplace_back("--verified");
      EXPECT_EQ(run_noli(words).exit_code, code);
    }
    return code;
  }
  std::string proof() const { return folder.path("proof.noli"); }
  std::string claim() const { return folder.path("claim.json"); }

  Folder folder;
};

TEST_F(OnlyNew, WhatIntersectsFirstIsListedAndNotCompared) {
  const Words frames = apart();
  EXPECT_EQ(verify(frames).exit_code, 1) << "they intersect";
  const Process process = verify(frames, {"--only-new", "-v"});
  EXPECT_EQ(process.exit_code, 0) << process.out << process.err;
  EXPECT_TRUE(
      process.out.starts_with("Not compared: 1 pair of cells that intersects in the first frame:\n"
                              "  cells 0 and 1\n"))
      << process.out;
  EXPECT_NE(process.verdict_line().find("PROVED  3 frames, 2 steps: nothing that is compared touches; not compared: 1 "
                                        "pair of cells that intersects in the first frame (accepted by "),
            std::string::npos)
      << process.verdict_line();
}

TEST_F(OnlyNew, ANewContactIsFound) {
  const Words frames = through();
  const Process process = verify(frames, {"--only-new"});
  EXPECT_EQ(process.exit_code, 1) << process.out << process.err;
  EXPECT_NE(process.verdict_line().find("CONTACT  step 2 "), std::string::npos) << process.out;
  EXPECT_NE(process.verdict_line().find("t = 0.75  vertex 6 × face 0 at (2, 0.5, 0)"), std::string::npos)
      << process.verdict_line();
  EXPECT_EQ(check(frames, {"--claim", claim()}), 1);
}

TEST_F(OnlyNew, BothCheckersHoldTheClaimThatListsThePairs) {
  const Words frames = apart();
  ASSERT_EQ(verify(frames, {"--only-new"}).exit_code, 0);
  EXPECT_EQ(check(frames, {"--claim", claim()}), 0);
  EXPECT_EQ(check(frames, {}), 3) << "a weaker claim than the one asked by default";
}

TEST_F(OnlyNew, TheResultListsThePairs) {
  Words words = {"verify", "--only-new", "--no-check"};
  for (const std::string& path : through()) words.push_back(path);
  const Json found = json_of(words, 1);
  EXPECT_EQ(found["baseline"], Json::parse("[[0, 1]]"));
  EXPECT_EQ(found["initial_intersections"], 0);
  EXPECT_TRUE(found["statement"]["only_new"].get<bool>());
  EXPECT_EQ(found["statement"]["excluded"],
            Json::array({"1 pair of cells that intersects in the first frame (--only-new)"}));
  words = {"verify", "--no-check"};
  for (const std::string& path : through()) words.push_back(path);
  EXPECT_FALSE(json_of(words, 1).contains("baseline"));
}

/// A claim file with a word that is no list must not be split for ever.
TEST_F(OnlyNew, ALongWordInAClaimIsRefused) {
  const Words frames = apart();
  ASSERT_EQ(verify(frames, {"--only-new"}).exit_code, 0);
  const std::string text = R"({"schema": "noli-claim", "version": 1, "cells": ")" + std::string(150'000, 'a') + "\"}";
  EXPECT_EQ(check(frames, {"--claim", folder.write("long.json", text)}), 3);
}

/// Triangles that all intersect each other: more pairs than a checker can be asked about.
TEST_F(OnlyNew, TooManyPairsForACheckerAreDecidedAndNotChecked) {
  constexpr int count = 600;
  const auto fan = [&](double height) {
    std::vector<Position> points;
    std::vector<std::array<VertexId, 3>> faces;
    for (int i = 0; i < count; ++i) {
      const double x = std::cos(0.005 * i), y = std::sin(0.005 * i);
      const auto v = static_cast<VertexId>(points.size());
      points.insert(points.end(), {{x, y, -1 - 0.001 * i}, {x, y, 1 + 0.001 * i}, {-x, -y, 0.0001 * i}});
      faces.push_back({v, v + 1, v + 2});
    }
    points.insert(points.end(), {{5, 0, height}, {6, 0, height}, {5, 1, height}});
    faces.push_back({3 * count, 3 * count + 1, 3 * count + 2});
    return folder.write("fan_" + std::to_string(points.size() + static_cast<std::size_t>(height)) + ".ply",
                        ply_text(points, faces));
  };
  const Process process = run_noli({"verify", "--only-new", fan(1), fan(2)});
  EXPECT_EQ(process.exit_code, 0) << process.out << process.err;
  EXPECT_NE(process.out.find("more pairs of cells are left out than a checker can be asked about"), std::string::npos)
      << process.out;
  EXPECT_TRUE(process.verdict_line().starts_with("NO CONTACT  ")) << process.verdict_line();
  fan(3);
  // Checkers do not read joined bodies: noli would send the frames through a pipe.
  const Process joined = run_noli({"verify", "--only-new", "--body", "fan=" + folder.path("fan_*.ply")});
  EXPECT_EQ(joined.exit_code, 0) << joined.out << joined.err;
  EXPECT_NE(joined.out.find("3 frames, 2 steps"), std::string::npos) << joined.out;
  EXPECT_NE(joined.out.find("more pairs of cells are left out than a checker can be asked about"), std::string::npos)
      << joined.out;
}

TEST_F(OnlyNew, WithoutAnyTheClaimIsTheUsualOne) {
  const Words frames = {frame(9, 5), frame(9, 3)};
  const Process process = verify(frames, {"--only-new"});
  EXPECT_EQ(process.exit_code, 0) << process.out;
  EXPECT_TRUE(process.out.starts_with("Not compared: 0 pairs of cells that intersect in the first frame.\n"));
  EXPECT_EQ(check(frames, {}), 0);
}

TEST_F(OnlyNew, BesidesGroupsThatAreIgnored) {
  const std::string groups = folder.write(
      "groups.json", R"({"groups": {"sheet": [[0, 2]], "falling": [[6, 8]]}, "ignore": [["sheet", "falling"]]})");
  const Words frames = through();
  EXPECT_EQ(verify(frames, {"--ignore", groups}).exit_code, 1);
  EXPECT_EQ(verify(frames, {"--only-new"}).exit_code, 1);
  ASSERT_EQ(verify(frames, {"--only-new", "--ignore", groups}).exit_code, 0);
  EXPECT_EQ(check(frames, {"--claim", claim()}), 0);
}

TEST_F(OnlyNew, OfFramesAtRestAndWithALeastDistance) {
  EXPECT_EQ(verify(apart(), {"--only-new", "--static"}).exit_code, 0);
  const Words meeting = {frame(0, 5), frame(0, 0)};
  const Process met = verify(meeting, {"--only-new", "--static", "--keep-going"});
  EXPECT_EQ(met.exit_code, 1);
  EXPECT_NE(met.out.find("2: cell 0 and cell 2"), std::string::npos) << met.out;
  const Words frames = apart();
  ASSERT_EQ(verify(frames, {"--only-new", "--min-distance", "0.5"}).exit_code, 0);
  EXPECT_EQ(check(frames, {"--claim", claim()}), 0);
  EXPECT_EQ(verify(frames, {"--only-new", "--min-distance", "2"}).exit_code, 1);
}

}  // namespace
}  // namespace noli::app_tests
