// SPDX-License-Identifier: Apache-2.0
//
// Installs the project into an empty folder, then builds and runs examples/ against it, as a user would.
#include <gtest/gtest.h>

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "workspace.h"

namespace noli::repository {
namespace {

namespace fs = std::filesystem;

void succeed(const std::string& command) {
  const auto [exit_code, output] = run(command + " 2>&1");
  ASSERT_EQ(exit_code, 0) << command << "\n" << output;
}

/// Programs that link a library built with a sanitizer need the sanitizer too.
std::string sanitizer_flags() {
  const std::string sanitizers = NOLI_SANITIZE;
  return sanitizers.empty() ? "" : " -DCMAKE_CXX_FLAGS=-fsanitize=" + sanitizers;
}

void install(const fs::path& prefix) {
  succeed(quoted(NOLI_CMAKE) + " --install " + quoted(NOLI_BINARY_DIR) + " --prefix " + quoted(prefix.string()));
}

void build_examples(const fs::path& prefix, const fs::path& build) {
  succeed(quoted(NOLI_CMAKE) + " -S " + quoted((fs::path(NOLI_SOURCE_DIR) / "examples").string()) + " -B " +
          quoted(build.string()) + " -G " + quoted(NOLI_GENERATOR) +
          " -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_COMPILER=" + quoted(NOLI_CXX_COMPILER) +
          " -DCMAKE_PREFIX_PATH=" + quoted(prefix.string()) + sanitizer_flags());
  succeed(quoted(NOLI_CMAKE) + " --build " + quoted(build.string()));
}

TEST(InstallSlow, AnInstalledNoliIsFoundAndTheExamplesRun) {
  const TemporaryFolder folder;
  const fs::path prefix = folder.path() / "prefix";
  const fs::path build = folder.path() / "build";
  ASSERT_NO_FATAL_FAILURE(install(prefix));
  ASSERT_NO_FATAL_FAILURE(build_examples(prefix, build));
  ASSERT_NO_FATAL_FAILURE(
      succeed(quoted(NOLI_CTEST) + " --test-dir " + quoted(build.string()) + " --no-tests=error --output-on-failure"));
  const auto [exit_code, output] = run(quoted((build / "meet").string()));
  EXPECT_EQ(exit_code, 0);
  EXPECT_EQ(output, "through the face: they meet\nbeside the face: they stay apart\n");
  EXPECT_EQ(run(quoted((build / "certify_frames").string())).output,
            "x = 1.25: nothing touches\nx = 0.25: crossing contact at t = 0.5 of the step\n");
  EXPECT_EQ(run(quoted((build / "certify_in_solver").string())).output,
            "step 5 is rejected: contact at t = 0.038736 of it\n");
}

TEST(InstallSlow, WhatIsInstalledStandsOnItsOwn) {
  const TemporaryFolder folder;
  ASSERT_NO_FATAL_FAILURE(install(folder.path()));
  int seen = 0;
  for (const fs::path& file : files_below(folder.path())) {
    if (file.extension() != ".cmake" && file.extension() != ".h") continue;
    ++seen;
    const std::string text = read_text(file);
    EXPECT_EQ(text.find(NOLI_SOURCE_DIR), std::string::npos) << file;
    EXPECT_EQ(text.find(NOLI_BINARY_DIR), std::string::npos) << file;
  }
  EXPECT_GT(seen, 5);
  const fs::path headers = fs::path(NOLI_SOURCE_DIR) / "include";
  std::vector<fs::path> installed, expected;
  for (const fs::path& file : files_below(folder.path() / "include"))
    installed.push_back(file.lexically_relative(folder.path() / "include"));
  for (const fs::path& file : files_below(headers)) expected.push_back(file.lexically_relative(headers));
  EXPECT_EQ(std::set(installed.begin(), installed.end()), std::set(expected.begin(), expected.end()));
  EXPECT_TRUE(fs::exists(folder.path() / "bin" / "noli"));
  EXPECT_TRUE(fs::exists(folder.path() / "bin" / "noli_ccd_host"));
  EXPECT_TRUE(fs::exists(folder.path() / "bin" / "noli_check_host"));
#ifdef NOLI_SERIES
  EXPECT_TRUE(fs::exists(folder.path() / "bin" / "noli_series"));
#endif
}

}  // namespace
}  // namespace noli::repository
