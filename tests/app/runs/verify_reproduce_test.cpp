// SPDX-License-Identifier: Apache-2.0
//
// Tests `noli verify RUN --reproduce`, which verifies runs that recorded frames again.
#include <gtest/gtest.h>

#include "tests/app/runs/simulate_fixture.h"
#include "trajectory/blocks/block_file.h"
#include "trajectory/blocks/block_sink.h"

namespace noli::app_tests {
namespace {

bool says(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

class Reproduce : public Simulate {
 protected:
  /// Runs the scene and returns the folder.
  std::string frames_of(Json json, const std::string& name = "run") const {
    json["record"] = "frames";
    EXPECT_EQ(run_noli({"simulate", scene(json), "-o", run_path(name)}).exit_code, 0);
    return run_path(name);
  }
};

TEST_F(Reproduce, ARunOfFramesSaysWhatToDo) {
  const std::string run = frames_of(beam(0.1));
  const Process process = run_noli({"verify", run});
  EXPECT_EQ(process.exit_code, 3);
  for (const char* part :
       {"only frames were recorded", "pass --reproduce", "\"record\": \"full\"", "noli simulate SCENE.json -o RUN"}) {
    EXPECT_TRUE(says(process.err, part)) << process.err;
  }
}

TEST_F(Reproduce, CheckOfARunOfFramesSaysWhatToDo) {
  const std::string run = frames_of(beam(0.1)), way = "noli verify " + run + " --reproduce";
  const Process process = run_noli({"check", run});
  EXPECT_EQ(process.exit_code, 3);
  EXPECT_TRUE(says(process.err, "the run recorded only frames; `" + way + "`")) << process.err;
  EXPECT_EQ(run_noli({"verify", run, "--reproduce"}).exit_code, 0);
  // With the proof of the same motion, recorded in full.
  Json json = beam(0.1);
  json["record"] = "full";
  ASSERT_EQ(run_noli({"simulate", scene(json), "-o", run_path("full")}).exit_code, 0);
  const Process other = run_noli({"check", run_path("full") + "/proof.blocks", run});
  EXPECT_EQ(other.exit_code, 3);
  EXPECT_TRUE(says(other.out, "Next: the run recorded only frames")) << other.out;
}

TEST_F(Reproduce, CheckOfARunWithoutAProofSaysHowToMakeOne) {
  const std::string run = run_path("run"), proof = run_path("out.noli");
  ASSERT_EQ(run_noli({"simulate", scene(hanging_sheet()), "-o", run, "--no-proof"}).exit_code, 0);
  const Process process = run_noli({"check", run});
  EXPECT_EQ(process.exit_code, 3);
  EXPECT_TRUE(says(process.err, "`noli verify " + run + " --proof OUT.noli` makes one")) << process.err;
  EXPECT_EQ(run_noli({"verify", run, "--proof", proof}).exit_code, 0);
  EXPECT_EQ(run_noli({"check", proof, run}).exit_code, 0);
}

/// --proof is refused, and so is --reproduce without --no-check in shards.
TEST_F(Reproduce, NothingSuggestsAProofThatIsRefused) {
  const std::string run = frames_of(beam(0.1)), full = "Next: record the run in full (\"record\": \"full\"",
                    checked = "Next: without --no-check, and without shards, the proof is checked.";
  const std::vector<std::string> verify = {"verify", run, "--reproduce"};
  for (const auto& [more, hint] : {std::pair<std::vector<std::string>, std::string>{{}, full},
                                   {{"--no-check"}, checked},
                                   {{"--min-distance", "1e-9"}, full},
                                   {{"--no-check", "--min-distance", "1e-9"}, full}}) {
    std::vector<std::string> words = verify;
    words.insert(words.end(), more.begin(), more.end());
    const Process process = run_noli(words);
    EXPECT_EQ(process.exit_code, 0) << process.err;
    EXPECT_TRUE(says(process.out, hint)) << process.out;
    EXPECT_FALSE(says(process.out, "--proof")) << process.out;
  }
}

TEST_F(Reproduce, WindowsOfThePlaneAndOfSpaceAreVerifiedAgain) {
  for (const Json& json : {beam(0.1), hanging_sheet(), two_cloths()}) {
    const std::string run = frames_of(json, json.value("title", "beam"));
    const auto before = folder.names();
    const std::string bytes = bytes_of(run + "/trajectory.blocks");
    const Json verified = json_of({"verify", run, "--reproduce"}, 0);
    EXPECT_EQ(verified["verdict"], "proved");
    EXPECT_EQ(verified["complete"], true);
    const Json unchecked = json_of({"verify", run, "--reproduce", "--no-check"}, 0);
    EXPECT_EQ(unchecked["verdict"], "no_contact");
    EXPECT_EQ(verified["reproduced"], true);
    EXPECT_EQ(verified["steps"], verified["steps_total"]);
    EXPECT_GT(verified["steps"], 4);
    EXPECT_TRUE(says(verified["statement"]["motion"], "integrated again")) << verified["statement"];
    EXPECT_EQ(folder.names(), before);
    EXPECT_TRUE(bytes_of(run + "/trajectory.blocks") == bytes);
  }
}

TEST_F(Reproduce, ItIsTheMotionThatARunInFullHas) {
  Json json = two_cloths();
  const std::string frames = frames_of(json, "frames");
  ASSERT_EQ(run_noli({"simulate", scene(json), "-o", run_path("full")}).exit_code, 0);
  const Json again = json_of({"verify", frames, "--reproduce"}, 0), full = json_of({"verify", run_path("full")}, 0);
  EXPECT_EQ(again["stages"], full["stages"]);
  EXPECT_EQ(full["reproduced"], false);
  const Json both = json_of({"verify", run_path("full"), "--reproduce"}, 0);
  EXPECT_EQ(both["verdict"], "proved");
  EXPECT_EQ(both["reproduced"], true);
}

/// Copies a run without its log, which would reveal the change, and flips one bit in the eighth byte from the end of a
/// window's block of this kind.
void copy_with_a_fault(const std::string& run, const std::string& to, int window, FourLetters kind) {
  fs::copy(run, to);
  fs::remove(fs::path(to) / "log.jsonl");
  const fs::path file = fs::path(to) / "trajectory.blocks";
  fs::remove(file);
  constexpr FourLetters content = four_letters("TRAJ");
  BlockReader reader(fs::path(run) / "trajectory.blocks", content);
  BlockWriter writer(std::make_unique<FileSink>(file, FileSink::Open::create), content);
  int windows = 0, faults = 0;
  while (auto block = reader.next()) {
    if (block->kind == block_format::commit) {
      writer.commit();
      continue;
    }
    windows += block->kind == four_letters("WIND") ? 1 : 0;
    if (windows == window && block->kind == kind) {
      char& byte = block->payload[block->payload.size() - 8];
      byte = static_cast<char>(byte ^ 1);
      ++faults;
    }
    writer.append(block->kind, block->payload);
  }
  EXPECT_EQ(faults, 1);
}

TEST_F(Reproduce, AnotherMotionIsAnErrorThatNamesTheWindow) {
  const std::string run = frames_of(hanging_sheet());
  copy_with_a_fault(run, run_path("hash"), 3, four_letters("HASH"));
  const Process hash = run_noli({"verify", run_path("hash"), "--reproduce"});
  EXPECT_EQ(hash.exit_code, 3) << hash.out;
  EXPECT_TRUE(says(hash.err, "window 3: integrated again, it has world lines with SHA-256 ")) << hash.err;
  copy_with_a_fault(run, run_path("velocities"), 5, four_letters("VELO"));
  const Process velocities = run_noli({"verify", run_path("velocities"), "--reproduce"});
  EXPECT_EQ(velocities.exit_code, 3) << velocities.out;
  EXPECT_TRUE(says(velocities.err, "window 5: integrated again, it ends in a different state")) << velocities.err;
}

TEST_F(Reproduce, FilesOfTheSceneHaveToBeFoundUnchanged) {
  Json json = falling_triangle();
  json["duration"] = 0.1;
  const std::string run = frames_of(json);
  const Process lost = run_noli({"verify", run, "--reproduce"});
  EXPECT_EQ(lost.exit_code, 3);
  EXPECT_TRUE(says(lost.err, "names level.obj")) << lost.err;
  EXPECT_TRUE(says(lost.err, "pass --scene-folder FOLDER")) << lost.err;
  const std::string files = fs::path(run).parent_path();
  EXPECT_EQ(json_of({"verify", run, "--reproduce", "--scene-folder", files}, 0)["steps"], 13);
  folder.write("upright.obj", "v 0 -0.25 0.375\nv -0.25 -0.25 1\nv 0.25 -0.25 1\nf 1 2 3\n");
  const Process changed = run_noli({"verify", run, "--reproduce", "--scene-folder", files});
  EXPECT_EQ(changed.exit_code, 3);
  EXPECT_TRUE(says(changed.err, "/model/sha256: the run began with other meshes")) << changed.err;
}

TEST_F(Reproduce, ARunThatWasInterruptedIsVerifiedAsFarAsItGot) {
  Json json = hanging_sheet();
  json["record"] = "frames";
  ASSERT_EQ(run_noli({"simulate", scene(json), "-o", run_path("run"), "--until", "0.05"}).exit_code, 0);
  const Json part = json_of({"verify", run_path("run"), "--reproduce"}, 0);
  EXPECT_EQ(part["steps"], 5);
  EXPECT_EQ(part["run"]["windows_total"], 25);
  const Json limited = json_of({"verify", run_path("run"), "--reproduce", "--time-limit", "1ms"}, 2);
  EXPECT_EQ(limited["verdict"], "undecided");
  EXPECT_LT(limited["steps"], 5);
}

TEST_F(Reproduce, LeastDistancesAreDecidedToo) {
  const std::string run = frames_of(two_cloths());
  EXPECT_EQ(json_of({"verify", run, "--reproduce", "--min-distance", "1e-9"}, 0)["verdict"], "no_contact");
  EXPECT_TRUE(says(json_of({"verify", run, "--reproduce", "--min-distance", "1e-9"}, 0)["proof"]["not_checked"],
                   "recorded only frames"));
  EXPECT_NE(json_of({"verify", run, "--reproduce", "--min-distance", "0.5"}, 1)["verdict"], "no_contact");
}

TEST_F(Reproduce, WhatDoesNotGoTogetherIsRefused) {
  const std::string run = frames_of(beam(0.1));
  EXPECT_EQ(run_noli({"verify", run, "--scene-folder", run}).exit_code, 3);
  const Process proof = run_noli({"verify", run, "--reproduce", "--proof", run_path("proof")});
  EXPECT_EQ(proof.exit_code, 3);
  EXPECT_TRUE(says(proof.err, "--proof: needs world lines in a file")) << proof.err;
  const std::string mesh = folder.write("mesh.ply", two_triangles(1));
  EXPECT_TRUE(says(run_noli({"verify", mesh, mesh, "--reproduce"}).err, "--reproduce: is for a run")) << mesh;
}

TEST_F(Reproduce, MemoryIsBoundedByAWindow) {
  Json json = beam(2);
  const std::string once = frames_of(json, "once");
  json["duration"] = 20;
  const std::string tenfold = frames_of(json, "tenfold");
  const Process one = run_noli({"verify", once, "--reproduce"}), ten = run_noli({"verify", tenfold, "--reproduce"});
  ASSERT_EQ(one.exit_code, 0) << one.err;
  ASSERT_EQ(ten.exit_code, 0) << ten.err;
  if (!sanitized) {
    EXPECT_LT(static_cast<double>(ten.peak_bytes), 1.2 * static_cast<double>(one.peak_bytes));
  }
}

}  // namespace
}  // namespace noli::app_tests
