// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <atomic>
#include <thread>

#include "audit/numerics/run_command.h"

namespace noli::audit {
namespace {

using std::chrono::milliseconds;

CommandRun shell(const std::string& line, std::chrono::nanoseconds limit = std::chrono::minutes(1)) {
  return run_command({"/bin/sh", "-c", line}, limit, nullptr);
}

TEST(RunCommand, KeepsWhatAProgramSaysAndHowItEnds) {
  const CommandRun run = shell("echo one; echo two; echo three >&2; exit 7");
  EXPECT_TRUE(run.exited(7));
  EXPECT_FALSE(run.exited(0));
  EXPECT_EQ(run.out, "one\ntwo\n");
  EXPECT_EQ(run.err, "three\n");
  EXPECT_EQ(run.verdict_line(), "one");
  EXPECT_EQ(end_words(run), "exit 7");
}

TEST(RunCommand, KeepsMoreThanAPipeHolds) {
  const CommandRun run = shell("head -c 1000000 /dev/zero");
  EXPECT_TRUE(run.exited(0));
  EXPECT_EQ(run.out.size(), 1'000'000u);
}

TEST(RunCommand, GivesNoInput) { EXPECT_EQ(shell("cat; echo end").out, "end\n"); }

TEST(RunCommand, TellsACrashFromAnExit) {
  const CommandRun run = shell("kill -SEGV $$");
  EXPECT_EQ(run.end, CommandRun::End::signalled);
  EXPECT_EQ(end_words(run), "signal 11");
}

TEST(RunCommand, EndsWhatHangsWithAllThatItHasStarted) {
  const CommandRun run = shell("echo begun; sleep 600 & sleep 600", milliseconds(200));
  EXPECT_EQ(run.end, CommandRun::End::hung);
  EXPECT_EQ(run.out, "begun\n");
  EXPECT_LT(run.seconds, 60);
}

TEST(RunCommand, LetsWhatHangsCleanUp) {
  const CommandRun run =
      shell("trap 'echo cleaned; exit 3' TERM; echo begun; while :; do sleep 0.01; done", milliseconds(200));
  EXPECT_EQ(run.end, CommandRun::End::hung);
  EXPECT_EQ(run.out, "begun\ncleaned\n");
}

TEST(RunCommand, StopsWhenAsked) {
  std::atomic<bool> stop = false;
  std::thread asking([&] {
    std::this_thread::sleep_for(milliseconds(100));
    stop = true;
  });
  const CommandRun run = run_command({"/bin/sleep", "600"}, std::chrono::minutes(5), &stop);
  asking.join();
  EXPECT_EQ(run.end, CommandRun::End::stopped);
}

TEST(RunCommand, SaysWhenAProgramIsNotThere) {
  EXPECT_THROW(run_command({"/no/such/program"}, milliseconds(100), nullptr), std::runtime_error);
}

}  // namespace
}  // namespace noli::audit
