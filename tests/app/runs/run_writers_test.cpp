// SPDX-License-Identifier: Apache-2.0
//
// Tests writers of a run folder: one at a time, only files of the run, while others read.
#include <gtest/gtest.h>

#include <future>
#include <random>
#include <thread>

#include "tests/app/runs/killer.h"
#include "tests/app/runs/simulate_fixture.h"
#include "trajectory/blocks/folder_lock.h"

namespace noli::app_tests {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

class Writers : public Simulate {
 protected:
  void SetUp() override {
    file_ = scene(hanging_sheet());
    ASSERT_EQ(run_noli({"simulate", file_, "-o", run_path("whole"), "--until", "0.05"}).exit_code, 0);
  }

  Process simulate(const std::string& run, const std::vector<std::string>& more) const {
    std::vector<std::string> words = {"simulate", file_, "-o", run, "--until", "0.05"};
    words.insert(words.end(), more.begin(), more.end());
    return run_noli(words);
  }

  /// Starts two commands on one folder, the second after a pause. A command that reports success has written the run;
  /// the other one is refused.
  void race(const std::vector<std::string>& second, std::chrono::microseconds pause) {
    const std::string run = run_path("raced");
    fs::remove_all(run);
    auto first = std::async(std::launch::async, [&] { return simulate(run, {}); });
    std::this_thread::sleep_for(pause);
    const Process two = simulate(run, second), one = first.get();
    for (const Process* process : {&one, &two}) {
      if (process->exit_code == 0) continue;
      EXPECT_EQ(process->exit_code, 3) << process->err;
      const bool told = process->err.find(" is being written by ") != std::string::npos ||
                        process->err.find(": is being written by ") != std::string::npos;
      const bool too_early = process->err.find("is not the folder of a run") != std::string::npos;  // not created yet
      const bool too_late = process->err.find("exists already") != std::string::npos;  // created by the second
      EXPECT_TRUE(told || (process == &two && too_early) || (process == &one && too_late)) << process->err;
      (told ? told_ : not_told_)++;
    }
    EXPECT_TRUE(one.exit_code == 0 || two.exit_code == 0) << one.err << two.err;
    EXPECT_TRUE(blocks("raced") == blocks("whole")) << one.out << one.err << two.out << two.err;
  }

  void race_often(int times) {
    std::minstd_rand random(1);
    for (int i = 0; i < times; ++i) {
      const std::chrono::microseconds pause(random() % 120'000);
      race({i % 2 == 0 ? "--resume" : "--force"}, pause);
    }
    EXPECT_GT(told_, 0);
  }

  std::string file_;
  int told_ = 0, not_told_ = 0;
};

TEST_F(Writers, WhatTheWinnerReportsIsThere) { race_often(12); }

TEST_F(Writers, SlowWhatTheWinnerReportsIsThere) { race_often(static_cast<int>(trials(60, 1000))); }

TEST_F(Writers, TheLoserIsToldWhoHasTheFolder) {
  const FolderLock lock(run_path("whole"));
  const std::string before = blocks("whole");
  const std::vector<std::vector<std::string>> starts = {{}, {"--resume"}, {"--force"}};
  for (const auto& how : starts) {
    const Process process = simulate(run_path("whole"), how);
    EXPECT_EQ(process.exit_code, 3);
    EXPECT_NE(process.err.find("-o " + run_path("whole") + ": is being written by process " +
                               std::to_string(::getpid()) + "; choose another folder"),
              std::string::npos)
        << process.err;
  }
  EXPECT_TRUE(blocks("whole") == before);
}

TEST_F(Writers, ReadersSayThatTheRunIsBeingWritten) {
  const std::string run = run_path("whole"), note = "another process writes to the run: this is about the 5 windows";
  std::vector<std::vector<std::string>> readers = {
      {"explain", run}, {"info", run}, {"check", run}, {"export", run, "--force", "-o", run_path("f/%d.ply")}};
  if (reports_are_there()) readers.push_back({"report", run, "--force", "-o", run_path("page.html")});
  {
    const FolderLock lock(run);
    const Process process = run_noli({"verify", run});
    EXPECT_EQ(process.exit_code, 0) << process.err;
    EXPECT_NE(process.out.find(note), std::string::npos) << process.out;
    EXPECT_NE(process.out.find(" (it is being written).\n"), std::string::npos) << process.out;
    EXPECT_EQ(json_of({"verify", run}, 0)["verdict"], "proved");
    for (const auto& words : readers) {
      const Process other = run_noli(words);
      EXPECT_EQ(other.exit_code, 0) << words[0] << other.err;
      EXPECT_NE(other.err.find(" is being written: "), std::string::npos) << words[0] << other.err;
    }
  }
  EXPECT_EQ(run_noli({"verify", run}).out.find(note), std::string::npos);
  for (const auto& words : readers) {
    EXPECT_EQ(run_noli(words).err.find(" is being written: "), std::string::npos) << words[0];
  }
}

/// A run that takes about a second, with a reader that looks again and again.
TEST_F(Writers, ARunThatGrowsIsVerifiedUpToWhereItIs) {
  Json json = hanging_sheet();
  json["duration"] = 1.4;
  const std::string file = scene(json), run = run_path("grown");
  const Victim writer({"simulate", file, "-o", run});
  auto end = std::async(std::launch::async, [&writer] { return writer.wait(); });
  while (!fs::exists(run + "/log.jsonl")) std::this_thread::sleep_for(milliseconds(5));
  std::size_t before = 0;
  int looks = 0;
  while (end.wait_for(milliseconds(0)) != std::future_status::ready) {
    const Process process = run_noli({"verify", run, "--json", "-"});
    ++looks;
    const bool begun = process.exit_code == 2 && before == 0;  // no window was committed
    EXPECT_TRUE(process.exit_code == 0 || begun) << process.err;
    if (process.exit_code != 0) continue;
    const std::size_t steps = Json::parse(process.out)["steps"];
    EXPECT_GE(steps, before);
    before = steps;
  }
  EXPECT_EQ(end.get(), 0);
  EXPECT_GT(looks, 0);
}

TEST_F(Writers, FollowingARunVerifiesItToItsEnd) {
  Json json = hanging_sheet();
  json["duration"] = 1.4;
  const std::string file = scene(json), run = run_path("followed");
  const Victim writer({"simulate", file, "-o", run});
  while (!fs::exists(run + "/log.jsonl")) std::this_thread::sleep_for(milliseconds(5));
  const Json result = json_of({"verify", run, "--follow"}, 0);
  EXPECT_EQ(writer.wait(), 0);
  EXPECT_EQ(result["verdict"], "proved");
  EXPECT_EQ(result["steps"], 140);
  EXPECT_EQ(result["run"]["end"], "done");
  EXPECT_EQ(result["notes"], Json::array());
  const Json alone = json_of({"verify", run}, 0);
  EXPECT_EQ(without_timing(result), without_timing(alone));
  EXPECT_EQ(without_timing(json_of({"verify", run, "--follow"}, 0)), without_timing(alone)) << "nobody writes to it";
}

/// The writer has the folder before its log has a line.
TEST_F(Writers, OnlyARunThatNobodyWritesHasLostItsLog) {
  const std::string run = run_path("whole"), json = folder.path("result.json");
  fs::resize_file(run + "/log.jsonl", 0);
  const auto notes = [&] {
    run_noli({"verify", run, "--json", json, "--force"});
    return Json::parse(bytes_of(json))["notes"].dump();
  };
  EXPECT_NE(notes().find("has no log.jsonl"), std::string::npos);
  const FolderLock lock(run);
  EXPECT_EQ(notes().find("has no log.jsonl"), std::string::npos);
}

TEST_F(Writers, FollowingEndsAtTheTimeLimitAndWhenItIsInterrupted) {
  const FolderLock lock(run_path("whole"));
  const std::vector<std::string> follow = {"verify", run_path("whole"), "--follow"};
  std::vector<std::string> limited = follow;
  limited.insert(limited.end(), {"--time-limit", "300ms"});
  for (const bool interrupt : {false, true}) {
    const auto begin = Clock::now();
    const Process process = interrupt ? run_noli(follow, interrupt_after(300)) : run_noli(limited);
    const auto took = std::chrono::duration_cast<milliseconds>(Clock::now() - begin);
    EXPECT_EQ(process.exit_code, 2) << process.out << process.err;
    EXPECT_GE(took, milliseconds(300));
    EXPECT_LT(took, milliseconds(2000)) << "half a second, and what a busy machine takes to start";
    EXPECT_NE(process.out.find("UNDECIDED  5 of 5 windows begun"), std::string::npos) << process.out;
  }
  const Process frames = run_noli({"verify", folder.write("a.ply", two_triangles(1)), "--static", "--follow"});
  EXPECT_EQ(frames.exit_code, 3);
  EXPECT_NE(frames.err.find("--follow: is for a run"), std::string::npos) << frames.err;
}

TEST_F(Writers, LinksInAFolderAreNotWrittenThrough) {
  for (const std::string name : {"log.jsonl", "trajectory.blocks", "proof.blocks", "manifest.json", "scene.json",
                                 "series.h5", "series.h5.part", "manifest.json.part"}) {
    const std::string run = run_path("run"), target = run_path("precious");
    fs::remove_all(run);
    fs::copy(run_path("whole"), run);
    fs::remove(target);
    if (fs::exists(run + "/" + name)) fs::rename(run + "/" + name, target);
    if (!fs::exists(target)) folder.write("precious", "mine");
    fs::create_symlink(target, run + "/" + name);
    const std::string before = bytes_of(target);
    const Process read = run_noli({"verify", run});
    EXPECT_EQ(read.exit_code, 0) << name << read.err;
    const Process process = run_noli({"simulate", file_, "-o", run, "--resume"});
    EXPECT_EQ(process.exit_code, 3) << name;
    EXPECT_NE(process.err.find(name + " is a link"), std::string::npos) << process.err;
    EXPECT_TRUE(fs::is_symlink(run + "/" + name)) << name;
    EXPECT_EQ(simulate(run, {"--force"}).exit_code, 0) << name;
    EXPECT_FALSE(fs::is_symlink(run + "/" + name)) << name;
    EXPECT_TRUE(bytes_of(target) == before) << name;
    EXPECT_TRUE(blocks("run") == blocks("whole")) << name;
  }
}

TEST_F(Writers, FilesOfOthersAreLetBe) {
  const std::string run = run_path("run");
  fs::copy(run_path("whole"), run);
  const std::vector<std::string> others = {"run/report.html", "run/0.ply", "run/notes.part", "run/frames/1.ply"};
  fs::create_directory(run + "/frames");
  for (const std::string& other : others) folder.write(other, "mine");
  EXPECT_EQ(run_noli({"simulate", file_, "-o", run, "--resume", "--until", "0.1"}).exit_code, 0);
  EXPECT_EQ(json_of({"verify", run}, 0)["steps"], 10);
  folder.write("run/series.h5.part", "of a run that was killed");
  EXPECT_EQ(simulate(run, {"--force"}).exit_code, 0);
  EXPECT_TRUE(blocks("run") == blocks("whole"));
  EXPECT_FALSE(fs::exists(run + "/series.h5.part"));
  for (const std::string& other : others) EXPECT_EQ(bytes_of(folder.path(other)), "mine") << other;
  // A folder with only such files is not a run.
  fs::create_directory(run_path("none"));
  folder.write("none/0.ply", "mine");
  for (const char* const how : {"--resume", "--force"}) {
    const Process process = simulate(run_path("none"), {how});
    EXPECT_EQ(process.exit_code, 3);
    EXPECT_NE(process.err.find("is not "), std::string::npos) << process.err;
  }
  EXPECT_EQ(fs::exists(run_path("none/0.ply")), true);
}

}  // namespace
}  // namespace noli::app_tests
