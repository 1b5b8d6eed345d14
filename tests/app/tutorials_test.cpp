// SPDX-License-Identifier: Apache-2.0
//
// Tests that following a tutorial of docs/, or the README, gives the output shown there.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "tests/app/process.h"
#include "tests/app/runs/simulate_fixture.h"
#include "tests/app/scene.h"
#include "tests/app/worked_example.h"
#include "tests/support/real_data.h"

namespace noli::app_tests {
namespace {

using Lines = std::vector<std::string>;

TEST(Tutorials, Certify) {
  const Folder folder;
  expect_tutorial("docs/certify.md", folder.path("."));
}

TEST(Tutorials, Mend) {
  if (!reports_are_there()) GTEST_SKIP() << "needs reports";
  const Folder folder;
  expect_tutorial("docs/mend.md", folder.path("."));
}

TEST(Tutorials, Fuzz) {
  const Folder folder;
  expect_tutorial("docs/fuzz.md", folder.path("."));
}

TEST(Tutorials, Audit) {
#if defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "the thread sanitizer's own memory grows with each query, and is reported as a leak";
#endif
  const Folder folder;
  expect_tutorial("docs/audit.md", folder.path("."));
}

TEST(Tutorials, Simulate) {
  const Folder folder;
  expect_tutorial("docs/simulate.md", folder.path("."));
}

TEST(Tutorials, Scale) {
  const Folder folder;
  expect_tutorial("docs/scale.md", folder.path("."));
}

TEST(Tutorials, Prove) {
  const Folder folder;
  expect_tutorial("docs/prove.md", folder.path("."));
}

/// The README's commands run in the source folder.
TEST(Tutorials, Readme) {
  const Folder folder;
  for (const char* const name : {"examples", "scenes"}) {
    std::filesystem::create_directory_symlink(std::string(NOLI_SOURCE_DIR) + "/" + name, folder.path(name));
  }
  expect_tutorial("README.md", folder.path("."));
}

/// The study's commands run where its frames are.
TEST(Tutorials, Study) {
  const auto frames = test::real_data("frames");
  if (!frames || !verified_checker_is_there()) GTEST_SKIP() << "needs the real frames and the verified checker";
  const Folder folder;
  for (const char* const name : {"armadillo-rollers", "cloth-funnel", "cloth-ball", "rod-twist-clean"}) {
    std::filesystem::create_directory_symlink(*frames / name, folder.path(name));
  }
  expect_tutorial("docs/study.md", folder.path("."));
}

TEST(Tutorials, TheirStepsAreFound) {
  const auto steps = tutorial("docs/certify.md");
  ASSERT_GE(steps.size(), 5U);
  EXPECT_EQ(steps[0].file, "frame_1.obj");
  EXPECT_EQ(steps[0].text.substr(0, 8), "v 0 0 0\n");
  EXPECT_EQ(steps[3].file, "");
  EXPECT_EQ(steps[3].text, "noli verify frame_1.obj frame_2.obj");
  EXPECT_EQ(steps[3].printed.front(), "...");
  EXPECT_EQ(steps[4].text, "echo $?");
  EXPECT_EQ(steps[4].printed, Lines{"0"});
}

TEST(Tutorials, ThreeDotsStandForWhatIsLeftOut) {
  EXPECT_TRUE(is_like("a", "a"));
  EXPECT_FALSE(is_like("a", "ab"));
  EXPECT_TRUE(is_like("a ... d", "a b c d"));
  EXPECT_TRUE(is_like("... b ... d", "a b c d"));
  EXPECT_TRUE(is_like("a...", "a"));
  EXPECT_FALSE(is_like("a ... c ... d", "a d c"));
  EXPECT_FALSE(is_like("ab...bc", "abc"));
  EXPECT_FALSE(is_like("b...", "ab"));

  EXPECT_TRUE(are_like({}, {}));
  EXPECT_FALSE(are_like({}, {"a"}));
  EXPECT_FALSE(are_like({"a"}, {}));
  EXPECT_TRUE(are_like({"..."}, {}));
  EXPECT_TRUE(are_like({"a", "...", "d"}, {"a", "b", "c", "d"}));
  EXPECT_TRUE(are_like({"...", "c ...", "..."}, {"a", "b", "c d"}));
  EXPECT_FALSE(are_like({"...", "c"}, {"c", "d"}));
}

}  // namespace
}  // namespace noli::app_tests
