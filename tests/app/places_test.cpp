// SPDX-License-Identifier: Apache-2.0
//
// Tests where commands write: they detect unwritable places before the work begins, and do not mix new and old files.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/app/runs/simulate_fixture.h"

namespace noli::app_tests {
namespace {

class Places : public Simulate {};

TEST_F(Places, ExportLeavesNoFilesOfALongerOne) {
  ASSERT_EQ(run_noli({"simulate", scene(falling_triangle()), "-o", run_path("run"), "--until", "0.25"}).exit_code, 0);
  const auto arguments = [&](const char* fps, const char* format) {
    return std::vector<std::string>{"export", run_path("run"), "--fps", fps, "-o", run_path("frames/a%03d.") + format};
  };
  EXPECT_EQ(run_noli(arguments("32", "vtu")).exit_code, 0);
  EXPECT_EQ(run_noli(arguments("32", "ply")).exit_code, 0);
  folder.write("frames/a8.ply", "mine");  // another pattern
  folder.write("frames/b000.ply", "mine");
  EXPECT_TRUE(fs::exists(run_path("frames/a008.ply")));
  const Process refused = run_noli(arguments("8", "ply"));
  EXPECT_EQ(refused.exit_code, 3);
  EXPECT_NE(refused.err.find("exists already; choose another name, or pass --force"), std::string::npos) << refused.err;
  EXPECT_TRUE(fs::exists(run_path("frames/a008.ply")));
  auto forced = arguments("8", "ply");
  forced.emplace_back("--force");
  const Process process = run_noli(forced);
  EXPECT_EQ(process.exit_code, 0) << process.err;
  EXPECT_NE(process.out.find("Removed: 6 files"), std::string::npos) << process.out;
  for (const char* file : {"a002.ply", "a008.vtu", "a.pvd", "a8.ply", "b000.ply"}) {
    EXPECT_TRUE(fs::exists(run_path("frames/") + file)) << file;
  }
  for (int i = 3; i <= 8; ++i) EXPECT_FALSE(fs::exists(run_path("frames/a00" + std::to_string(i) + ".ply"))) << i;
  // A series is one too; so is one without frames.
  for (int i = 0; i <= 8; ++i) fs::remove(run_path("frames/a00" + std::to_string(i) + ".vtu"));
  EXPECT_EQ(run_noli(arguments("8", "vtu")).exit_code, 3);
}

/// A command that writes to a place, with its other arguments.
struct Writer {
  std::vector<std::string> before, after;
  bool folder = false;  ///< writes a folder
  bool makes_parents = false;
};

TEST_F(Places, ThatCannotBeWrittenToAreKnownBeforeTheWorkBegins) {
  Json json = beam(0.02);
  const std::string file = scene(json);
  ASSERT_EQ(run_noli({"simulate", file, "-o", run_path("run")}).exit_code, 0);
  const auto mesh = folder.write("mesh.ply", two_triangles(1));
  const auto queries = folder.write("vertex-vertex.csv", "0,1,0,1,0,1\n1,1,0,1,0,1\n0,1,0,1,0,1\n1,1,0,1,0,1\n");
  folder.write("plain", "a file");
  fs::create_directories(run_path("closed"));
  fs::create_directories(run_path("there/%d.ply"));
  fs::create_directories(run_path("there/0.ply"));
  fs::permissions(run_path("closed"), fs::perms::owner_read | fs::perms::owner_exec);
  const std::vector<Writer> writers = {
      {{"simulate", file, "-o"}, {}, true, true},
      {{"simulate", file, "--force", "-o"}, {}, true, true},
      {{"simulate", file, "-o", run_path("new"), "--json"}, {}},
      {{"simulate", file, "--reproduce", run_path("run"), "--window", "1", "-o"}, {}},
      {{"export", run_path("run"), "-o"}, {"/%d.ply"}, true, true},
      {{"verify", run_path("run"), "--json"}, {}},
      {{"verify", mesh, mesh, "--json"}, {}},
      {{"ccd", queries, "--json"}, {}},
      {{"explain", file, "--json"}, {}},
      {{"info", run_path("run"), "--json"}, {}},
      {{"fuzz", "queries", "--count", "1", "--out", run_path("findings"), "--json"}, {}},
      {{"fuzz", "queries", "--count", "1", "--out"}, {}, true, false}};
  ProcessOptions obey;
  obey.obey_permissions = true;
  for (const Writer& writer : writers) {
    std::vector<std::string> places = {"plain/x", "closed/x"};
    if (!writer.makes_parents) places.emplace_back("none/x");
    places.emplace_back(writer.folder ? "plain" : "there");
    for (const std::string& place : places) {
      const auto before = folder.names();
      std::vector<std::string> arguments = writer.before;
      arguments.push_back(run_path(place) + (writer.after.empty() ? "" : writer.after[0]));
      const Process process = run_noli(arguments, obey);
      const std::string what = testing::PrintToString(arguments) + process.out + process.err;
      EXPECT_EQ(process.exit_code, 3) << what;
      EXPECT_EQ(std::count(process.err.begin(), process.err.end(), '\n'), 1) << what;
      EXPECT_NE(process.err.find(run_path(place)), std::string::npos) << what;
      EXPECT_NE(process.err.find("expected"), std::string::npos) << what;
      EXPECT_EQ(folder.names(), before) << what;
    }
  }
  const Process frame = run_noli({"export", run_path("run"), "--force", "-o", run_path("there/%d.ply")});
  EXPECT_EQ(frame.exit_code, 3);
  EXPECT_NE(frame.err.find("there/0.ply: is a folder; expected a file"), std::string::npos) << frame.err;
  // An existing run that cannot be resumed.
  fs::permissions(run_path("run/trajectory.blocks"), fs::perms::owner_read);
  EXPECT_EQ(run_noli({"simulate", file, "-o", run_path("run"), "--resume"}, obey).exit_code, 3);
  fs::permissions(run_path("run/trajectory.blocks"), fs::perms::owner_read | fs::perms::owner_write);
  EXPECT_EQ(run_noli({"simulate", file, "-o", run_path("run"), "--resume"}, obey).exit_code, 0);
  EXPECT_EQ(run_noli({"simulate", file, "-o", run_path("deep/in/run")}).exit_code, 0);
}

}  // namespace
}  // namespace noli::app_tests
