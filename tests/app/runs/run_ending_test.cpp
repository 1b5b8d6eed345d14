// SPDX-License-Identifier: Apache-2.0
//
// Tests what is reported about where a run ends, and why, and what to do about it.
#include <gtest/gtest.h>

#include <sstream>

#include "tests/app/runs/simulate_fixture.h"
#include "trajectory/blocks/folder_lock.h"
#include "trajectory/blocks/run_file.h"

namespace noli::app_tests {
namespace {

bool says(const std::string& run, const std::string& line) {
  return ("\n" + run_noli({"verify", run}).out).find("\n" + line + "\n") != std::string::npos;
}

bool speaks_of_an_end(const std::string& run) {
  return run_noli({"verify", run}).out.find("The run ends") != std::string::npos;
}

TEST_F(Simulate, VerifySaysThatARunEndedInAContact) {
  ASSERT_EQ(run_noli({"simulate", scene(falling_triangle()), "-o", run_path("run")}).exit_code, 1);
  EXPECT_TRUE(says(run_path("run"), "The run ends at 0.3046875 s of 1 s (contact)."));
  const Json run = json_of({"verify", run_path("run")}, 0)["run"];
  EXPECT_EQ(run["end"], "contact");
  EXPECT_EQ(run["time"], 0.3046875);
  EXPECT_EQ(run["duration"], 1);
}

TEST_F(Simulate, VerifySaysNothingOfTheEndOfAWholeRun) {
  ASSERT_EQ(run_noli({"simulate", scene(hanging_sheet()), "-o", run_path("run")}).exit_code, 0);
  EXPECT_FALSE(speaks_of_an_end(run_path("run")));
  const Json run = json_of({"verify", run_path("run")}, 0)["run"];
  EXPECT_EQ(run["end"], "done");
  EXPECT_EQ(run["time"], run["duration"]);
}

TEST_F(Simulate, VerifySaysThatNoMoreOfARunWasAskedFor) {
  const std::string file = scene(hanging_sheet());
  ASSERT_EQ(run_noli({"simulate", file, "-o", run_path("run"), "--until", "0.1"}).exit_code, 0);
  EXPECT_TRUE(says(run_path("run"), "The run ends at 0.1 s of 0.25 s (no more was requested)."));
  ASSERT_EQ(run_noli({"simulate", file, "-o", run_path("run"), "--resume"}).exit_code, 0);
  EXPECT_FALSE(speaks_of_an_end(run_path("run")));
}

TEST_F(Simulate, VerifySaysThatARunWasInterruptedOrMayGoOn) {
  Json json = hanging_sheet();
  json["bodies"][0].erase("pin");
  json["duration"] = 10000;
  const std::vector<std::string> simulate = {"simulate", scene(json), "-o", run_path("run"), "--ignore-space"};
  // A busy machine may need longer for its first window.
  std::uint64_t windows = 0;
  for (int milliseconds = 200; windows == 0 && milliseconds < 60'000; milliseconds *= 2) {
    fs::remove_all(run_path("run"));
    ASSERT_EQ(run_noli(simulate, interrupt_after(milliseconds)).exit_code, 2);
    windows = RunReader(run_path("run")).look().windows;
  }
  const Json run = json_of({"verify", run_path("run")}, 0)["run"];
  EXPECT_EQ(run["end"], "interrupted");
  EXPECT_NE(run_noli({"verify", run_path("run")}).out.find(" s of 10000 s (interrupted).\n"), std::string::npos);
  add_entry(run_path("run"), {{"event", "resume"}});
  EXPECT_EQ(json_of({"verify", run_path("run")}, 0)["run"]["end"], nullptr);
  const std::string out = run_noli({"verify", run_path("run")}).out;
  EXPECT_NE(out.find("(it may still be going on, or was killed).\n"), std::string::npos) << out;
}

/// Of the line "Next: ...".
std::string next_of(const Process& process) {
  const std::string out = '\n' + process.out, begin = "\nNext: ";
  const std::size_t at = out.find(begin);
  if (at == std::string::npos) return "";
  return out.substr(at + begin.size(), out.find('\n', at + 1) - at - begin.size());
}

/// A kill leaves a part of a window that was never committed.
TEST_F(Simulate, CheckSaysThatARunWhichEndsWithinAWindowHasToBeResumed) {
  const std::string file = scene(hanging_sheet()), run = run_path("run");
  ASSERT_EQ(run_noli({"simulate", file, "-o", run, "--until", "0.05"}).exit_code, 0);
  ASSERT_EQ(run_noli({"simulate", file, "-o", run_path("longer"), "--until", "0.06"}).exit_code, 0);
  const std::string committed = blocks("run"), longer = blocks("longer");
  ASSERT_TRUE(longer.starts_with(committed) && longer.size() > committed.size() + 200);
  std::ofstream(run + "/trajectory.blocks", std::ios::binary) << longer.substr(0, committed.size() + 200);
  EXPECT_TRUE(says(
      run, "The proof was not checked: the run ends within a window; resume it first (noli simulate ... --resume)."));
  EXPECT_EQ(run_noli({"verify", run, "--proof", run_path("proof.noli")}).exit_code, 0);
  for (const std::vector<std::string>& check :
       {std::vector<std::string>{"check", run}, {"check", run_path("proof.noli"), run}}) {
    const Process process = run_noli(check);
    EXPECT_EQ(process.exit_code, 3) << process.out;
    EXPECT_NE(next_of(process).find("resume it first (noli simulate ... --resume)"), std::string::npos) << process.out;
  }
  {
    const FolderLock writer(run);
    EXPECT_NE(next_of(run_noli({"check", run})).find("when it has ended"), std::string::npos);
  }
  ASSERT_EQ(run_noli({"simulate", file, "-o", run, "--resume"}).exit_code, 0);
  EXPECT_EQ(run_noli({"check", run}).exit_code, 0);
}

/// Following the advice goes on with what was asked for, and does not stop at the scene's duration.
TEST_F(Simulate, TheNextStepOfAStoppedRunGoesOnWithWhatWasAskedFor) {
  const std::string file = scene(resting_bar(1, 0.5)), run = run_path("run");
  const Process stopped = run_noli(
      {"simulate", file, "-o", run, "--until", "1e6", "--past-duration", "--ignore-space", "--time-limit", "1s"});
  ASSERT_EQ(stopped.exit_code, 2) << stopped.err;
  EXPECT_EQ(next_of(stopped),
            "noli simulate " + file + " -o " + run + " --until 1000000 --past-duration --ignore-space --resume");
  std::istringstream line(next_of(stopped));
  std::vector<std::string> words;
  for (std::string word; line >> word;) words.push_back(word);
  ASSERT_FALSE(words.empty());
  words.erase(words.begin());
  words.insert(words.end(), {"--time-limit", "5s"});
  const Process resumed = run_noli(words);
  EXPECT_EQ(resumed.exit_code, 2) << resumed.out << resumed.err;
  EXPECT_EQ(next_of(resumed), next_of(stopped));
}

TEST_F(Simulate, VerifyDoesWithoutLogAndScene) {
  ASSERT_EQ(run_noli({"simulate", scene(falling_triangle()), "-o", run_path("run")}).exit_code, 1);
  fs::remove(run_path("run/log.jsonl"));
  EXPECT_TRUE(says(run_path("run"), "The run ends at 0.3046875 s of 1 s (its log does not say why)."));
  fs::remove(run_path("run/scene.json"));
  EXPECT_TRUE(says(run_path("run"), "The run ends at 0.3046875 s (its log does not say why)."));
  EXPECT_EQ(json_of({"verify", run_path("run")}, 0)["run"]["duration"], nullptr);
}

TEST_F(Simulate, OfNoWindowNothingIsClaimed) {
  const std::string file = scene(resting_bar(1e9, 1e8));  // a window would take hours
  const Process process =
      run_noli({"simulate", file, "-o", run_path("run"), "--time-limit", "200ms", "--ignore-space"});
  EXPECT_EQ(process.exit_code, 2) << process.err;
  EXPECT_EQ(process.out.find("verified exactly"), std::string::npos) << process.out;
  EXPECT_NE(process.out.find("\nNo window was committed to " + run_path("run") + ": nothing is claimed.\n"),
            std::string::npos)
      << process.out;
  const Process verified = run_noli({"verify", run_path("run")});
  EXPECT_EQ(verified.exit_code, 2);
  EXPECT_NE(verified.out.find("\nUNDECIDED  0 of 0 windows begun: nothing found so far (no window was committed)\n"),
            std::string::npos)
      << verified.out;
  EXPECT_TRUE(says(run_path("run"), "The run ends at 0 s of 1000000000 s (time limit)."));
  EXPECT_EQ(
      json_of({"simulate", file, "-o", run_path("json"), "--time-limit", "200ms", "--ignore-space"}, 2)["statement"],
      "no window was committed: nothing is claimed.");
}

}  // namespace
}  // namespace noli::app_tests
