// SPDX-License-Identifier: Apache-2.0
//
// Tests child processes, also when other code in the process has already waited for them.
#include "certify/process/child.h"

#include <gtest/gtest.h>

#include <csignal>
#include <system_error>

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

TEST(Children, OneThatSomebodyElseWaitedForIsAnErrorAndNoEnd) {
  const auto before = std::signal(SIGCHLD, SIG_IGN);  // the system reaps the child
  Child child({"/bin/sh", "-c", "exit 0"}, {.out = Child::piped});
  EXPECT_THROW(child.finish({}), std::system_error);
  std::signal(SIGCHLD, before);
}

}  // namespace
}  // namespace noli
