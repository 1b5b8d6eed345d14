// SPDX-License-Identifier: Apache-2.0
//
// Tests scripts/setup with dpkg-query, id, apt-get and sudo replaced by scripts that answer as each test needs.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "workspace.h"

namespace noli::repository {
namespace {

namespace fs = std::filesystem;

class Setup : public testing::Test {
 protected:
  void command(const std::string& name, const std::string& body) {
    write_file(folder.path() / name, "#!/bin/bash\n" + body + "\n");
    fs::permissions(folder.path() / name, fs::perms::owner_all);
  }

  void packages(const std::string& missing) {
    command("dpkg-query", "[ \"$4\" = '" + missing + "' ] && exit 1; printf 'install ok installed'");
  }

  void user(int id) { command("id", "echo " + std::to_string(id)); }

  void apt() {
    command("apt-get", "echo \"$@\" >>'" + log().string() + "'");
    command("env", "exec /usr/bin/env \"$@\"");
  }

  void sudo() { command("sudo", "echo sudo >>'" + log().string() + "'; exec \"$@\""); }

  fs::path log() const { return folder.path() / "log"; }

  CommandResult setup(const std::string& arguments = "") const {
    return run("PATH=" + quoted(folder.path().string()) + " /bin/bash " +
               quoted((fs::path(NOLI_SOURCE_DIR) / "scripts" / "setup").string()) + " " + arguments + " 2>/dev/null");
  }

  TemporaryFolder folder;
};

TEST_F(Setup, DoesNothingWhenNothingIsMissing) {
  packages("nothing");
  user(0);
  apt();
  const auto [exit_code, output] = setup();
  EXPECT_EQ(exit_code, 0);
  EXPECT_EQ(output, "");
  EXPECT_FALSE(fs::exists(log()));
}

TEST_F(Setup, InstallsAsRoot) {
  packages("libcgal-dev");
  user(0);
  apt();
  EXPECT_EQ(setup().exit_code, 0);
  EXPECT_EQ(read_text(log()), "-q update\n-q install -y --no-install-recommends libcgal-dev\n");
}

TEST_F(Setup, InstallsWithSudo) {
  packages("libcgal-dev");
  user(1000);
  apt();
  sudo();
  EXPECT_EQ(setup().exit_code, 0);
  EXPECT_EQ(read_text(log()), "sudo\n-q update\nsudo\n-q install -y --no-install-recommends libcgal-dev\n");
}

TEST_F(Setup, PrintsTheLineToRunWithoutSudo) {
  packages("libcgal-dev");
  user(1000);
  apt();
  const auto [exit_code, output] = setup();
  EXPECT_EQ(exit_code, 3);
  EXPECT_EQ(output, "apt-get update && apt-get install -y --no-install-recommends libcgal-dev\n");
  EXPECT_FALSE(fs::exists(log()));
}

TEST_F(Setup, AllWantsTheToolsToo) {
  packages("valgrind");
  user(1000);
  EXPECT_EQ(setup().exit_code, 0);
  EXPECT_EQ(setup("--all").exit_code, 3);
}

TEST_F(Setup, WhatBuildsNoliAloneNeedsNoTools) {
  packages("coq");
  user(1000);
  EXPECT_EQ(setup("--demo").exit_code, 0);
  EXPECT_EQ(setup().exit_code, 3);
  packages("libcgal-dev");
  EXPECT_EQ(setup("--demo").exit_code, 3);
}

TEST_F(Setup, TheDocumentationNeedsSphinxAndWhatBuildsNoli) {
  packages("python3-sphinx");
  user(1000);
  EXPECT_EQ(setup().exit_code, 0);
  EXPECT_EQ(setup("--demo").exit_code, 0);
  EXPECT_EQ(setup("--docs").exit_code, 3);
  EXPECT_EQ(setup("--all").exit_code, 3);
  packages("libcgal-dev");
  EXPECT_EQ(setup("--docs").exit_code, 3);
  packages("coq");
  EXPECT_EQ(setup("--docs").exit_code, 0);
}

TEST_F(Setup, RefusesWhatItDoesNotKnow) {
  packages("nothing");
  user(0);
  EXPECT_EQ(setup("--everything").exit_code, 3);
}

}  // namespace
}  // namespace noli::repository
