// SPDX-License-Identifier: Apache-2.0
//
// Tests `noli repair`: free motions stay as they are, others are moved until nothing touches, and impossible ones are
// reported with the features that meet.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <map>

#include "tests/app/repair/repair_fixture.h"
#include "trajectory/blocks/folder_lock.h"

namespace noli::app_tests {
namespace {

TEST_F(Repair, WhatIsFreeStaysByteForByte) {
  const Words frames = falling({3, 2, 1, 0.5});
  const Json json = json_of(repair(frames), 0);
  EXPECT_EQ(json["verdict"], "proved");
  EXPECT_EQ(json["copied"], 4);
  EXPECT_EQ(json["inserted"], 0);
  EXPECT_TRUE(json["changed"].empty());
  for (std::size_t k = 0; k < frames.size(); ++k) EXPECT_EQ(read_text(out(k)), read_text(frames[k])) << k;
}

TEST_F(Repair, WhatTouchesIsProvedAfterwards) {
  const Words frames = falling({1, 0.5, -0.5, -0.25, 1});
  EXPECT_EQ(run_noli(Words{"verify"} + frames).exit_code, 1);
  const Process process = run_noli(repair(frames));
  EXPECT_EQ(process.exit_code, 0) << process.out << process.err;
  EXPECT_TRUE(process.verdict_line().starts_with("PROVED  ")) << process.out;
  const Process again = verify_out();
  EXPECT_EQ(again.exit_code, 0) << again.out;
  EXPECT_TRUE(again.verdict_line().starts_with("PROVED  ")) << again.out;
  // The free frames are as given, and what comes back is followed again.
  EXPECT_EQ(read_text(out(0)), read_text(frames[0]));
  EXPECT_EQ(positions(out(4)), positions(frames[4]));
  // Where it would have gone through, it stays above, and not far.
  for (const VertexId v : {3, 4, 5}) {
    const double above = positions(out(2))[v][2] - positions(out(2))[0][2];
    EXPECT_GT(above, 0);
    EXPECT_LT(above, 0.6);
  }
}

TEST_F(Repair, FixedVerticesMoveAsGiven) {
  const Words frames = falling({1, -0.5});
  const Json json = json_of(repair(frames, {"--fixed-first", "3"}), 0);
  EXPECT_EQ(json["changed"].size(), 1u);
  const auto given = positions(frames[1]), repaired = positions(out(json["frames"].get<std::size_t>() - 1));
  for (VertexId v = 0; v < 3; ++v) EXPECT_EQ(repaired[v], given[v]) << v;
  for (VertexId v = 3; v < 6; ++v) EXPECT_GT(repaired[v][2], 0) << v;
}

TEST_F(Repair, ListedVerticesMoveAsGiven) {
  const Words frames = falling({1, -0.5});
  const std::string list = folder.write("fixed.txt", "3 4\n5\n");
  const Json json = json_of(repair(frames, {"--fixed-vertices", list}), 0);
  EXPECT_EQ(json["fixed"], 3);
  const auto given = positions(frames[1]), repaired = positions(out(json["frames"].get<std::size_t>() - 1));
  for (VertexId v = 3; v < 6; ++v) EXPECT_EQ(repaired[v], given[v]) << v;
  for (VertexId v = 0; v < 3; ++v) EXPECT_LT(repaired[v][2], -0.5) << v;
  const Process beyond = run_noli(repair(frames, {"--fixed-vertices", folder.write("six.txt", "6\n"), "--force"}));
  EXPECT_EQ(beyond.exit_code, 3);
  EXPECT_NE(beyond.err.find("there is no vertex 6; the frames have 6"), std::string::npos) << beyond.err;
  for (const char* const bad : {"1\n-1\n", "1\n1.5\n", "1\nx\n", "1\n4294967296\n"}) {
    const Process process = run_noli(repair(frames, {"--fixed-vertices", folder.write("bad.txt", bad), "--force"}));
    EXPECT_EQ(process.exit_code, 3) << bad;
    EXPECT_NE(process.err.find("bad.txt: line 2: expected the number of a vertex, found"), std::string::npos)
        << process.err;
  }
}

TEST_F(Repair, BodiesAreJoinedAndSomeMoveAsGiven) {
  const auto triangle = [&](const char* name, double z) {
    return folder.write(name, ply_text({{1, 1, z}, {1.5, 1, z}, {1, 1.5, z}}, {{0, 1, 2}}));
  };
  const std::string floor = folder.write("floor.ply", ply_text({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}, {{0, 1, 2}}));
  triangle("cloth_0.ply", 1), triangle("cloth_1.ply", -1);
  triangle("lid_0.ply", 3), triangle("lid_1.ply", 2);
  const Words bodies = {"repair",
                        "-o",
                        pattern(),
                        "--body",
                        "cloth=" + folder.path("cloth_*.ply"),
                        "--body",
                        "lid=" + folder.path("lid_*.ply"),
                        "--fixed",
                        "lid",
                        "--obstacle",
                        floor};
  const Json json = json_of(bodies, 0);
  EXPECT_EQ(json["verdict"], "proved");
  EXPECT_EQ(json["fixed"], 6);
  ASSERT_EQ(json["bodies"].size(), 3u);
  EXPECT_EQ(json["bodies"][0]["moved"], 3);
  EXPECT_EQ(json["bodies"][1]["moved"], 0);
  EXPECT_EQ(json["bodies"][2]["moved"], 0);
  EXPECT_LT(json["momentum_into_fixed"][2], 0) << "the floor is pushed down";
  const auto last = positions(out(json["frames"].get<std::size_t>() - 1));
  for (VertexId v = 3; v < 6; ++v) EXPECT_EQ(last[v][2], 2);
  for (VertexId v = 6; v < 9; ++v) EXPECT_EQ(last[v][2], 0);
  // Bodies that may pass through each other do.
  Words through = bodies;
  through.insert(through.end(),
                 {"--force", "--ignore", folder.write("ignore.json", R"({"ignore": [["cloth", "floor"]]})")});
  const Json passed = json_of(through, 0);
  EXPECT_TRUE(passed["changed"].empty());
  Words wrong = bodies;
  wrong.insert(wrong.end(), {"--force", "--fixed", "hat"});
  const Process refused = run_noli(wrong);
  EXPECT_EQ(refused.exit_code, 3);
  EXPECT_NE(refused.err.find("--fixed hat: there is no such body"), std::string::npos) << refused.err;
}

TEST_F(Repair, MassesSayWhoGivesWay) {
  const Words frames = falling({1, -0.5});
  const std::string heavy = folder.write("heavy.txt", "1000 1000 1000 1 1 1\n");
  const auto moved = [&](const std::string& masses) {
    const Json json = json_of(repair(frames, {"--force", "--masses", masses}), 0);
    const auto x = positions(out(json["frames"].get<std::size_t>() - 1));
    return std::abs(x[0][2]) + std::abs(x[1][2]) + std::abs(x[2][2]);  // of the lower triangle, which rests
  };
  EXPECT_GT(moved("uniform"), 100 * moved(heavy));
  for (const char* wrong :
       {"1 1 1 1 1", "1 1 1 1 1 1 1", "1 1 1 1 1 0", "1 1 1 1 1 x", "1 1 1 1 1 inf", "1 1 1 1 1 1e5"}) {
    const Process refused = run_noli(repair(frames, {"--force", "--masses", folder.write("wrong.txt", wrong)}));
    EXPECT_EQ(refused.exit_code, 3) << wrong;
    EXPECT_NE(refused.err.find("wrong.txt: "), std::string::npos) << refused.err;
  }
}

TEST_F(Repair, AStartThatTouchesCannotBe) {
  const Process process = run_noli(repair(falling({0, 1})));
  EXPECT_EQ(process.exit_code, 1) << process.out << process.err;
  EXPECT_TRUE(process.verdict_line().starts_with("CANNOT BE  first frame  ")) << process.out;
  EXPECT_NE(process.out.find("--ignore"), std::string::npos);
  const std::string pierced = folder.write("pierced.ply", sail_through_deck());
  const Json json = json_of({"repair", pierced, pierced, "-o", folder.path("other/%d.ply"), "--order", "given"}, 1);
  EXPECT_EQ(json["end"], "start_touches");
  EXPECT_EQ(json["obstacle"]["cells"], Json::parse("[0, 1]"));
}

TEST_F(Repair, WhatIsFixedAndPassesThroughEachOtherCannotBe) {
  const Words frames = falling({1, 0.5, -0.5});
  const Json json = json_of(repair(frames, {"--fixed-first", "6"}), 1);
  EXPECT_EQ(json["end"], "blocked");
  EXPECT_EQ(json["obstacle"]["step"], 2);
  EXPECT_EQ(json["obstacle"]["time"], 0.5);
  EXPECT_EQ(json["steps"], 1);
  // What was repaired so far is there.
  EXPECT_EQ(read_text(out(1)), read_text(frames[1]));
  EXPECT_FALSE(fs::exists(out(2)));
}

TEST_F(Repair, OutputsReplaceNothingThatIsReadOrThere) {
  const Words frames = falling({1, -0.5});
  Words words = {"repair", frames[0], frames[1], "-o", folder.path("in_%d.ply"), "--force"};
  const Process over = run_noli(words);
  EXPECT_EQ(over.exit_code, 3);
  EXPECT_NE(over.err.find("is read; choose another folder or name"), std::string::npos) << over.err;
  EXPECT_EQ(run_noli(repair(frames)).exit_code, 0);
  const Process again = run_noli(repair(frames));
  EXPECT_EQ(again.exit_code, 3);
  EXPECT_NE(again.err.find("exists already"), std::string::npos) << again.err;
  EXPECT_EQ(run_noli(repair(frames, {"--force"})).exit_code, 0);
}

TEST_F(Repair, ThreadsChangeNoByte) {
  const Words frames = falling({1, -0.5, -1, 0.25});
  std::string first;
  for (const char* threads : {"1", "2", "5"}) {
    ASSERT_EQ(run_noli(repair(frames, {"--threads", threads, "--force"})).exit_code, 0);
    std::string bytes;
    for (const auto& entry : fs::directory_iterator(folder.path("out"))) {
      bytes += entry.path().filename().string() + read_text(entry.path());
    }
    if (first.empty()) first = bytes;
    EXPECT_EQ(bytes, first) << threads;
  }
}

std::string replaced_in(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

/// All that a repair writes, by name.
std::map<std::string, std::string> content_of(const std::string& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    files[entry.path().filename().string()] = read_text(entry.path());
  }
  return files;
}

TEST_F(Repair, WhatWasKilledAnywhereResumesToTheSameBytes) {
  const Words frames = falling({1, 0.5, -0.5, -1, -0.5, 1, -1});
  ASSERT_EQ(run_noli(repair(frames)).exit_code, 0);
  const auto whole = content_of(folder.path("out"));
  const std::string table = whole.at("times.csv");
  for (std::size_t bytes = table.find('\n') + 1; bytes <= table.size(); bytes += 7) {
    // As if it had been killed when so much of the table was written, perhaps within a frame. Its head is always whole.
    folder.write("out/times.csv", table.substr(0, bytes));
    // A frame without its row may be torn; one with its row is whole.
    const std::size_t row = table.find("\n003.ply") + 1;
    const bool has_row = bytes > table.find('\n', row);
    folder.write("out/003.ply", has_row ? whole.at("003.ply") : "torn");
    fs::remove(out(whole.size() - 3));
    const Process process = run_noli(repair(frames, {"--resume"}));
    ASSERT_EQ(process.exit_code, 0) << bytes << process.out << process.err;
    ASSERT_EQ(content_of(folder.path("out")), whole) << bytes;
  }
  const Process other = run_noli(repair(frames, {"--resume", "--restitution", "0.5"}));
  EXPECT_EQ(other.exit_code, 3);
  EXPECT_NE(other.err.find("with different frames, options or version"), std::string::npos) << other.err;
  // Another content of the same size is another repair too.
  folder.write("in_1.ply", replaced_in(read_text(frames[1]), "0.5", "0.7"));
  EXPECT_EQ(run_noli(repair(frames, {"--resume"})).exit_code, 3);
}

TEST_F(Repair, FramesThatWereChangedAreNotResumed) {
  const Words frames = falling({1, 0.5, -0.5, -1});
  ASSERT_EQ(run_noli(repair(frames)).exit_code, 0);
  const std::string changed = folder.write("out/001.ply", two_triangles(0.75));
  const Process process = run_noli(repair(frames, {"--resume"}));
  EXPECT_EQ(process.exit_code, 3);
  EXPECT_NE(process.err.find("001.ply: has changed since it was written"), std::string::npos) << process.err;
  EXPECT_EQ(read_text(changed), two_triangles(0.75));
}

TEST_F(Repair, ADamagedTableIsNotResumed) {
  const Words frames = falling({1, 0.5, -0.5, -1});
  ASSERT_EQ(run_noli(repair(frames)).exit_code, 0);
  const std::string table = read_text(folder.path("out/times.csv"));
  folder.write("out/002.ply", "edited");
  const std::size_t head = table.find('\n') + 1, row = table.find('\n', head) + 1;
  std::string semicolons = table;
  std::ranges::replace(semicolons, ',', ';');
  for (const std::string& damaged :
       {std::string(), table.substr(head), semicolons, table.substr(0, row) + "?" + table.substr(row),
        table.substr(0, head) + table.substr(row)}) {
    folder.write("out/times.csv", damaged);
    const Process process = run_noli(repair(frames, {"--resume"}));
    EXPECT_EQ(process.exit_code, 3) << process.out;
    EXPECT_NE(process.err.find("is damaged; expected the table as it was written"), std::string::npos) << process.err;
    EXPECT_EQ(read_text(folder.path("out/times.csv")), damaged);
    EXPECT_EQ(read_text(out(2)), "edited");
  }
  // A frame that was edited stays, also if one before it is missing.
  folder.write("out/times.csv", table);
  fs::remove(out(1));
  EXPECT_EQ(run_noli(repair(frames, {"--resume"})).exit_code, 3);
  EXPECT_EQ(read_text(out(2)), "edited");
}

TEST_F(Repair, WhatWasChangedBeforeIsStillKnown) {
  const Words frames = falling({1, 0.5, -0.5, -1, -0.5, 1, -1});
  Json whole = json_of(repair(frames), 0);
  ASSERT_GT(whole["changed"].size(), 1u);
  const std::string table = read_text(folder.path("out/times.csv")),
                    changed = read_text(folder.path("out/changed.jsonl"));
  for (std::size_t row = table.find('\n'); row != std::string::npos; row = table.find('\n', row + 1)) {
    folder.write("out/times.csv", table.substr(0, row + 1));
    Json resumed = json_of(repair(frames, {"--resume"}), 0);
    for (const char* member : {"timing", "steps_before"}) resumed.erase(member), whole.erase(member);
    EXPECT_EQ(resumed, whole) << row;
    EXPECT_EQ(read_text(folder.path("out/changed.jsonl")), changed) << row;
  }
  const std::string second = changed.substr(changed.find('\n') + 1);
  for (const std::string& damaged :
       {"?\n" + changed, std::string(), second, changed + changed, "{\"step\":1}\n" + second}) {
    folder.write("out/changed.jsonl", damaged);
    const Process process = run_noli(repair(frames, {"--resume"}));
    EXPECT_EQ(process.exit_code, 3) << damaged;
    EXPECT_NE(process.err.find("changed.jsonl"), std::string::npos) << process.err;
  }
}

TEST_F(Repair, ResumeReplacesNoFileThatIsOnlyCalledLikeItsOwn) {
  const Words frames = falling({1, -0.5});
  fs::create_directory(folder.path("out"));
  const std::string mine = folder.write("out/repair.json", "mine");
  EXPECT_EQ(run_noli(repair(frames, {"--resume"})).exit_code, 3);
  EXPECT_EQ(read_text(mine), "mine");
}

TEST_F(Repair, AKillWhileAnotherRepairWasReplacedResumes) {
  ASSERT_EQ(run_noli(repair(falling({1, 0.5, -1}))).exit_code, 0);
  const std::string table = read_text(folder.path("out/times.csv"));
  const Words frames = falling({1, -0.5});
  // --force writes the head of the table first.
  folder.write("out/times.csv", table.substr(0, table.find('\n') + 1));
  EXPECT_EQ(run_noli(repair(frames, {"--resume"})).exit_code, 0);
  EXPECT_EQ(read_text(out(0)), read_text(frames[0]));
}

TEST_F(Repair, SaysWhatIsFixedAndListsTheNewFrames) {
  const Process process = run_noli(repair(falling({1, -0.5}), {"--fixed-first", "3", "-v"}));
  EXPECT_EQ(process.exit_code, 0) << process.err;
  EXPECT_NE(process.out.find("3 of 6 vertices move as given."), std::string::npos) << process.out;
  EXPECT_NE(process.out.find("    copied  " + out(0)), std::string::npos) << process.out;
}

TEST_F(Repair, OneRepairAtATimeWritesToAFolder) {
  const Words frames = falling({1, -0.5});
  fs::create_directory(folder.path("out"));
  const FolderLock lock(folder.path("out"));
  const Process process = run_noli(repair(frames));
  EXPECT_EQ(process.exit_code, 3);
  EXPECT_NE(process.err.find("is being written by"), std::string::npos) << process.err;
  EXPECT_FALSE(fs::exists(folder.path("out/times.csv")));
}

TEST_F(Repair, NamesAndNumbersAreNotMistakenForEachOther) {
  falling({1, 0.5});
  const auto still = [&](const std::string& name, double x) {
    for (const char* frame : {"_0.ply", "_1.ply"}) {
      folder.write(name + frame, ply_text({{x, 0, 0}, {x + 1, 0, 0}, {x, 1, 0}}, {{0, 1, 2}}));
    }
    return folder.path(name + "_*.ply");
  };
  const Words bodies = {"--body", "x=" + folder.path("in_*.ply"), "--body", "3 man=" + still("y", 9),
                        "--body", "man=" + still("z", 19)};
  ASSERT_EQ(run_noli(repair({}, bodies + Words{"--fixed", "3 man"})).exit_code, 0);
  const Words other = {"--fixed-vertices", folder.write("pins.txt", "3\n"), "--fixed", "man", "--resume"};
  const Process process = run_noli(repair({}, bodies + other));
  EXPECT_EQ(process.exit_code, 3);
  EXPECT_NE(process.err.find("with different frames, options or version"), std::string::npos) << process.err;
}

TEST_F(Repair, AStartThatTouchesLeavesNothing) {
  EXPECT_EQ(run_noli(repair(falling({0, 1}))).exit_code, 1);
  EXPECT_FALSE(fs::exists(folder.path("out/times.csv")));
  EXPECT_FALSE(fs::exists(folder.path("out/repair.json")));
  EXPECT_EQ(run_noli(repair(falling({1, 2}))).exit_code, 0);
}

TEST_F(Repair, AFolderThatIsReadGetsNoFrames) {
  const Words frames = falling({1, -0.5});
  const Process process = run_noli({"repair", folder.path(""), "-o", folder.path("new_%d.ply")});
  EXPECT_EQ(process.exit_code, 3);
  EXPECT_NE(process.err.find("is read; choose another folder"), std::string::npos) << process.err;
  EXPECT_FALSE(fs::exists(folder.path("new_0.ply")));
}

TEST_F(Repair, TheTableOfStepsIsWholeWithVerbose) {
  std::vector<double> heights = {1};
  for (int k = 0; k < 15; ++k) heights.push_back(-0.5 - 0.125 * k);
  const Words frames = falling(heights);
  EXPECT_NE(run_noli(repair(frames)).out.find("  ... and 3 more (-v)"), std::string::npos);
  const Process all = run_noli(repair(frames, {"--force", "-v"}));
  for (int step = 1; step <= 15; ++step)
    EXPECT_NE(all.out.find(fmt::format("\n{:>6}  ", step)), std::string::npos) << step;
}

TEST_F(Repair, ResumeTouchesNoFilesThatAreNoRepair) {
  const Words frames = falling({1, -0.5});
  fs::create_directory(folder.path("out"));
  folder.write("out/000.ply", "mine");
  folder.write("out/007.ply", "mine too");
  const Process process = run_noli(repair(frames, {"--resume"}));
  EXPECT_EQ(process.exit_code, 3);
  EXPECT_EQ(read_text(out(0)), "mine");
  EXPECT_EQ(read_text(out(7)), "mine too");
  fs::remove(out(0));
  fs::remove(out(7));
  folder.write("out/times.csv", "my own table");
  EXPECT_EQ(run_noli(repair(frames)).exit_code, 3);
  EXPECT_EQ(run_noli(repair(frames, {"--resume"})).exit_code, 3);
  EXPECT_EQ(read_text(folder.path("out/times.csv")), "my own table");
}

TEST_F(Repair, LinksToWhatIsReadAreNotWrittenThrough) {
  const Words frames = falling({1, -0.5});
  fs::create_directory(folder.path("out"));
  for (std::size_t k = 0; k < 2; ++k) fs::create_symlink(frames[k], out(k));
  const std::string before = read_text(frames[1]);
  EXPECT_EQ(run_noli(repair(frames, {"--force"})).exit_code, 0);
  EXPECT_EQ(read_text(frames[1]), before);
  EXPECT_FALSE(fs::is_symlink(out(1)));
  // Read by their own names, they are refused.
  fs::remove_all(folder.path("out"));
  fs::create_directory(folder.path("out"));
  for (std::size_t k = 0; k < 2; ++k) fs::create_symlink(frames[k], out(k));
  const Process refused = run_noli(repair({out(0), out(1)}, {"--force"}));
  EXPECT_EQ(refused.exit_code, 3);
  EXPECT_NE(refused.err.find("is read"), std::string::npos) << refused.err;
  EXPECT_EQ(read_text(frames[1]), before);
}

TEST_F(Repair, OtherOutputsAreNoFramesAndNoInputsAreReplaced) {
  const Words frames = falling({1, -0.5});
  for (const char* name : {"out/001.ply", "out/times.csv", "out/repair.json", "out/../out/000.ply"}) {
    for (const char* option : {"--json", "--proof"}) {
      const Process refused = run_noli(repair(frames, {option, folder.path(name)}));
      EXPECT_EQ(refused.exit_code, 3) << option << ' ' << name;
    }
  }
  EXPECT_FALSE(fs::exists(folder.path("out/000.ply")));
  fs::create_directory(folder.path("out"));
  const std::string masses = folder.write("out/times.csv", "1 1 1 1 1 1\n");
  EXPECT_EQ(run_noli(repair(frames, {"--force", "--masses", masses})).exit_code, 3);
  EXPECT_EQ(read_text(masses), "1 1 1 1 1 1\n");
  const std::string pins = folder.write("out/7.ply", "0 1 2\n");
  const Words over = {"repair", "-o", folder.path("out/%d.ply"), "--fixed-vertices", pins, "--force"};
  EXPECT_EQ(run_noli(over + frames).exit_code, 3);
  EXPECT_EQ(read_text(pins), "0 1 2\n");
}

TEST_F(Repair, AFaceWithTwoEqualVerticesHearsItsLimit) {
  const auto frame = [&](const char* name, double s, double z) {
    return folder.write(name, ply_text({{-0.0195 * s, 1.0277 * s, 0},
                                        {0.9958 * s, 0.0039 * s, 0.013 * s},
                                        {-0.0195 * s, 1.0277 * s, 0},
                                        {0.0332 * s, 0.016 * s, z},
                                        {0.9622 * s, 0.0184 * s, 1.095 * z},
                                        {0.0205 * s, 0.9828 * s, z}},
                                       {{0, 1, 2}, {3, 4, 5}}));
  };
  const Words frames = {frame("d_0.ply", 1, 0.2), frame("d_1.ply", -0.5, -0.1)};
  const auto begin = std::chrono::steady_clock::now();
  const Process process = run_noli(repair(frames, {"--fixed-first", "3", "--threads", "1", "--time-limit", "2s"}));
  EXPECT_TRUE(process.exit_code == 0 || process.exit_code == 2) << process.exit_code << process.out << process.err;
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(20));
}

TEST_F(Repair, AFrameThatLeavesThePlaneIsAnError) {
  const auto flat = [&](const char* name, double z) {
    return folder.write(
        name, ply_text({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {2, 0, z}, {3, 0, z}, {2, 1, z}}, {{0, 1, 2}, {3, 4, 5}}));
  };
  const Words frames = {flat("p_0.ply", 0), flat("p_1.ply", 0), flat("p_2.ply", 5)};
  const Process process = run_noli(repair(frames));
  EXPECT_EQ(process.exit_code, 3);
  EXPECT_NE(process.err.find("leaves the plane"), std::string::npos) << process.err;
  EXPECT_EQ(run_noli(repair(frames, {"--force", "--dimension", "3"})).exit_code, 0);
}

TEST_F(Repair, WhatDoublesCannotKeepApartIsUndecided) {
  // A unit is the last bit of these coordinates: there is nothing between the triangle and the floor.
  const auto frame = [&](const char* name, double above) {
    const double z = 0x1p52;
    return folder.write(
        name, ply_text({{0, 0, z}, {9, 0, z}, {0, 9, z}, {1, 1, z + above}, {2, 1, z + above}, {1, 2, z + above}},
                       {{0, 1, 2}, {3, 4, 5}}));
  };
  const Process process = run_noli(repair({frame("f_0.ply", 1), frame("f_1.ply", -1)}, {"--fixed-first", "3"}));
  EXPECT_EQ(process.exit_code, 2) << process.out << process.err;
  EXPECT_TRUE(process.verdict_line().starts_with("UNDECIDED  0 of 1 steps repaired; ")) << process.out;
}

TEST_F(Repair, FramesAreInsertedWhereStraightLinesWouldTouch) {
  // A projectile flies through four sheets, which it tears along: they end where straight lines cross it.
  const std::string made = folder.path("shot");
  fs::create_directory(made);
  ASSERT_EQ(std::system((std::string(NOLI_UNTIDY_FRAMES) + " shot 16 '" + made + "'").c_str()), 0);
  const Json json = json_of(repair({made}, {"--no-check"}), 0);
  EXPECT_EQ(json["verdict"], "no_contact");
  EXPECT_GT(json["inserted"], 0);
  EXPECT_EQ(json["frames"], 4 + json["inserted"].get<int>());
  const std::string table = read_text(json["times"].get<std::string>());
  EXPECT_NE(table.find(",,inserted,"), std::string::npos) << table;
  EXPECT_EQ(verify_out().exit_code, 0);
}

TEST_F(Repair, AVtuPatternGetsASeries) {
  Words words = repair(falling({1, -0.5}));
  words[2] = folder.path("vtk/sheet_%03d.vtu");
  EXPECT_EQ(run_noli(words).exit_code, 0);
  EXPECT_TRUE(fs::exists(folder.path("vtk/sheet.pvd")));
  EXPECT_TRUE(fs::exists(folder.path("vtk/sheet_times.csv")));
  EXPECT_EQ(run_noli({"verify", folder.path("vtk/sheet.pvd")}).exit_code, 0);
}

TEST_F(Repair, InThePlaneThirdCoordinatesStay) {
  const auto curve = [&](const char* name, double y) {
    return folder.write(name, fmt::format("v 0 0 7\nv 2 0 7\nv 0.5 {} 7\nv 1.5 {} 7\nl 1 2\nl 3 4\n", y, y));
  };
  const Words frames = {curve("c_0.obj", 1), curve("c_1.obj", -1)};
  const Json json = json_of(repair(frames), 0);
  EXPECT_EQ(json["dimension"], 2);
  for (std::size_t k = 0; k < json["frames"].get<std::size_t>(); ++k) {
    for (const Position& x : positions(out(k))) EXPECT_EQ(x[2], 7);
  }
  EXPECT_EQ(verify_out().exit_code, 0);
}

TEST_F(Repair, ATimeLimitIsHeard) {
  const std::string large = folder.write("large.ply", sheets(400'000, 1));
  const Process process = run_noli(repair({large, large}, {"--order", "given", "--time-limit", "50ms"}));
  EXPECT_EQ(process.exit_code, 2) << process.out << process.err;
  EXPECT_TRUE(process.verdict_line().starts_with("UNDECIDED")) << process.out << process.err;
}

TEST_F(Repair, TheTableSaysWhichFrameIsWhen) {
  const Words frames = falling({1, -0.5, 1});
  const Json json = json_of(repair(frames), 0);
  const std::string table = read_text(json["times"].get<std::string>());
  const auto row = [](const std::string& begin, const Json& output) {
    return begin + output["sha256"].get<std::string>() + "\n";
  };
  EXPECT_TRUE(table.starts_with("file,time,given,what,sha256\n" +
                                row("000.ply,0," + frames[0] + ",copied,", json["outputs"][0])))
      << table;
  EXPECT_NE(table.find(row(",2," + frames[2] + ",copied,", json["outputs"].back())), std::string::npos) << table;
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), json["frames"].get<int>() + 1);
}

}  // namespace
}  // namespace noli::app_tests
