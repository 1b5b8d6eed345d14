// SPDX-License-Identifier: Apache-2.0
//
// Tests child processes, also when other code in the process has already waited for them.
#include "certify/process/child.h"

#include <gtest/gtest.h>

#include <csignal>
#include <system_error>

#include "tests/support/temporary_folder.h"

namespace noli {
namespace {

TEST(Children, HowItEndedIsTold) {
  Child good({"/bin/sh", "-c", "echo 1; exit 7"}, {.out = Child::piped});
  const ProgramEnd end = good.finish({});
  EXPECT_TRUE(end.exited_with(7));
  EXPECT_EQ(end.out, "1\n");
}

TEST(Children, ItsEndIsAskedForOnce) {
  Child child({"/bin/sh", "-c", "exit 0"}, {.out = Child::piped});
  EXPECT_TRUE(child.finish({}).exited_with(0));
  EXPECT_TRUE(child.has_ended());
  EXPECT_THROW(child.finish({}), std::system_error);
}

TEST(Children, HowMuchOfAFileItHasReadIsTold) {
  const test::TemporaryFolder folder;
  const std::string file = folder.write("file", std::string(1'000'000, 'x')), other = folder.write("other", "x");
  Child child({"/bin/sh", "-c", "exec 5<'" + file + "'; dd bs=250000 count=1 of=/dev/null <&5 2>&1; exec sleep 60"},
              {.out = Child::piped});
  std::optional<double> share;
  for (int looks = 0; looks < 1000 && share.value_or(0) < 0.25; ++looks) {
    child.look(std::chrono::milliseconds(10));
    share = child.share_read(file);
  }
  EXPECT_EQ(share, 0.25);
  EXPECT_EQ(child.share_read(other), std::nullopt) << "it has not opened this one";
  EXPECT_EQ(child.share_read(folder / "missing"), std::nullopt);
}

TEST(Children, OneThatReadsNoMoreRaisesNoSignalHere) {
  const auto before = std::signal(SIGPIPE, SIG_DFL);  // it would end this program
  Child child({"/bin/sh", "-c", "exit 0"}, {.in = Child::piped, .out = Child::piped});
  EXPECT_EQ(child.write(std::string(1 << 20, ' '), {}), Child::Written::refused);
  EXPECT_TRUE(child.finish({}).exited_with(0));
  sigset_t pending;
  ::sigpending(&pending);
  EXPECT_EQ(sigismember(&pending, SIGPIPE), 0);
  std::signal(SIGPIPE, before);
}

TEST(Children, OneThatSomebodyElseWaitedForIsAnErrorAndNoEnd) {
  const auto before = std::signal(SIGCHLD, SIG_IGN);  // the system reaps the child
  Child child({"/bin/sh", "-c", "exit 0"}, {.out = Child::piped});
  EXPECT_THROW(child.finish({}), std::system_error);
  std::signal(SIGCHLD, before);
}

}  // namespace
}  // namespace noli
