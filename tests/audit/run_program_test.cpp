// SPDX-License-Identifier: Apache-2.0
#include "certify/process/run_program.h"

#include <gtest/gtest.h>

#include <thread>

#include "certify/process/start_process.h"

namespace noli::audit {
namespace {

using std::chrono::milliseconds;

ProgramEnd shell(const std::string& line, const ProgramLimits& limits = {}) {
  return run_program({"/bin/sh", "-c", line}, limits);
}

TEST(RunProgram, KeepsAMegabyteOfWhatAProgramSays) {
  const ProgramEnd whole = shell("head -c 1000000 /dev/zero");
  EXPECT_TRUE(whole.exited_with(0));
  EXPECT_EQ(whole.out.size(), 1'000'000u);
  const ProgramEnd cut = shell("head -c 50000000 /dev/zero; echo end >&2; exit 3");
  EXPECT_TRUE(cut.exited_with(3));
  EXPECT_LT(cut.out.size(), most_words + 100);
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
  ProgramLimits limits;
  limits.stop = &stop;
  std::thread later([&] {
    std::this_thread::sleep_for(milliseconds(200));
    stop = true;
  });
  EXPECT_EQ(shell("exec >&- 2>&-; exec sleep 60", limits).kind, ProgramEnd::Kind::stopped);
  later.join();
}

}  // namespace
}  // namespace noli::audit
