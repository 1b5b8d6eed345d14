// SPDX-License-Identifier: Apache-2.0
#include "certify/process/run_program.h"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>

namespace noli::audit {
namespace {

using std::chrono::milliseconds;

ProgramEnd shell(const std::string& line, const ProgramLimits& limits = {}) {
  return run_program({"/bin/sh", "-c", line}, limits);
}

TEST(RunProgram, KeepsWhatAProgramSaysAndHowItEnds) {
  const ProgramEnd run = shell("echo one; echo two; echo three >&2; exit 7");
  EXPECT_TRUE(run.exited_with(7));
  EXPECT_FALSE(run.exited_with(0));
  EXPECT_EQ(run.out, "one\ntwo\n");
  EXPECT_EQ(run.err, "three\n");
  EXPECT_EQ(run.words(), "exit code 7");
  EXPECT_EQ(run.brief(), "exit 7");
}

TEST(RunProgram, GivesNoInput) { EXPECT_EQ(shell("cat; echo end").out, "end\n"); }

TEST(RunProgram, TellsACrashFromAnExit) {
  const ProgramEnd run = shell("kill -SEGV $$");
  EXPECT_EQ(run.kind, ProgramEnd::Kind::signalled);
  EXPECT_EQ(run.words(), "signal 11 (Segmentation fault)");
  EXPECT_EQ(run.brief(), "signal 11");
}

TEST(RunProgram, EndsWhatHangsWithAllThatItHasStarted) {
  const ProgramEnd run = shell("echo begun; sleep 600 & sleep 600", {.time = milliseconds(200)});
  EXPECT_EQ(run.kind, ProgramEnd::Kind::hung);
  EXPECT_EQ(run.out, "begun\n");
  EXPECT_LT(run.seconds, 60);
}

TEST(RunProgram, EndsWhatAProgramLeavesBehind) {
  const ProgramEnd run = shell("sleep 600 & echo begun; kill -KILL $$");
  EXPECT_EQ(run.brief(), "signal 9");
  EXPECT_EQ(run.out, "begun\n");
  EXPECT_LT(run.seconds, 60);
}

TEST(RunProgram, LetsWhatHangsCleanUp) {
  const ProgramEnd run =
      shell("trap 'echo cleaned; exit 3' TERM; echo begun; while :; do sleep 0.01; done", {.time = milliseconds(200)});
  EXPECT_EQ(run.kind, ProgramEnd::Kind::hung);
  EXPECT_EQ(run.out, "begun\ncleaned\n");
}

TEST(RunProgram, StopsWhenAsked) {
  std::atomic<bool> stop = false;
  std::thread asking([&] {
    std::this_thread::sleep_for(milliseconds(100));
    stop = true;
  });
  const ProgramEnd run = run_program({"/bin/sleep", "600"}, {.time = std::chrono::minutes(5), .stop = stop_by(&stop)});
  asking.join();
  EXPECT_EQ(run.kind, ProgramEnd::Kind::stopped);
}

TEST(RunProgram, SaysWhenAProgramIsNotThere) {
  EXPECT_THROW(run_program({"/no/such/program"}, {}), std::runtime_error);
}

TEST(RunProgram, KeepsAMegabyteOfWhatAProgramSays) {
  const ProgramEnd whole = shell("head -c 1000000 /dev/zero");
  EXPECT_TRUE(whole.exited_with(0));
  EXPECT_EQ(whole.out.size(), 1'000'000u);
  const ProgramEnd cut = shell("head -c 50000000 /dev/zero; echo end >&2; exit 3");
  EXPECT_TRUE(cut.exited_with(3));
  EXPECT_LT(cut.out.size(), most_output + 100);
  EXPECT_NE(cut.out.find("cut off after 1 MB"), std::string::npos);
  EXPECT_EQ(cut.err, "end\n");
}

TEST(RunProgram, EndsWhatClosesItsOutputAndStays) {
  const auto begin = std::chrono::steady_clock::now();
  const ProgramEnd stays = shell("exec >&- 2>&-; exec sleep 60");
  EXPECT_EQ(stays.kind, ProgramEnd::Kind::hung);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(10));
  EXPECT_TRUE(shell("exec >&- 2>&-; sleep 0.3; exit 5").exited_with(5));
}

TEST(RunProgram, HearsAStopAlsoThen) {
  std::atomic<bool> stop = false;
  const ProgramLimits limits{.stop = stop_by(&stop)};
  std::thread later([&] {
    std::this_thread::sleep_for(milliseconds(200));
    stop = true;
  });
  EXPECT_EQ(shell("exec >&- 2>&-; exec sleep 60", limits).kind, ProgramEnd::Kind::stopped);
  later.join();
}

}  // namespace
}  // namespace noli::audit
