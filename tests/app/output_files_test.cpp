// SPDX-License-Identifier: Apache-2.0
//
// Tests the rule for all outputs (app/output_files.h) with each command: existing files are kept unless --force is
// given. Inputs, files of runs, and files of other outputs are always kept.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/app/runs/simulate_fixture.h"

namespace noli::app_tests {
namespace {

class OutputFiles : public Simulate {
 protected:
  OutputFiles() {
    folder.write("a.ply", two_triangles(1));
    folder.write("b.ply", two_triangles(0.5));
  }

  std::vector<std::string> verify(std::vector<std::string> more) const {
    std::vector<std::string> words = {"verify", run_path("a.ply"), run_path("b.ply")};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }
  std::string run() const {
    EXPECT_EQ(run_noli({"simulate", scene(resting_bar(0.02, 0.01)), "-o", run_path("run")}).exit_code, 0);
    return run_path("run");
  }
  static void expect_refused(const std::vector<std::string>& words, const std::string& why) {
    const Process process = run_noli(words);
    EXPECT_EQ(process.exit_code, 3) << process.out << process.err;
    EXPECT_NE(process.err.find(why), std::string::npos) << process.err;
    EXPECT_EQ(process.out, "");
  }
  static std::vector<std::string> forced(std::vector<std::string> words) {
    words.emplace_back("--force");
    return words;
  }
};

TEST_F(OutputFiles, WhatExistsStaysUnlessForced) {
  const auto queries = folder.write("vertex-vertex.csv", "0,1,0,1,0,1\n1,1,0,1,0,1\n0,1,0,1,0,1\n1,1,0,1,0,1\n");
  const std::string mine = folder.write("mine", "mine");
  const std::string run_folder = run();
  const std::vector<std::vector<std::string>> all = {
      verify({"--json", mine}),
      verify({"--proof", mine}),
      verify({"--claim-out", mine}),
      {"verify", run_folder, "--json", mine},
      {"ccd", queries, "--json", mine},
      {"info", queries, "--json", mine},
      {"explain", run_folder, "--json", mine},
      {"report", run_folder, "-o", mine},
      {"simulate", run_path("scene.json"), "-o", run_path("other"), "--json", mine},
      {"fuzz", "queries", "--count", "1", "--json", mine},
  };
  for (const auto& words : all) {
    SCOPED_TRACE(words[0] + " " + words[words.size() - 2]);
    if (words[0] == "report" && !reports_are_there()) continue;
    expect_refused(words, mine + ": exists already; choose another name, or pass --force");
    EXPECT_EQ(bytes_of(mine), "mine");
    EXPECT_EQ(run_noli(forced(words)).exit_code, 0);
    EXPECT_NE(bytes_of(mine), "mine");
    folder.write("mine", "mine");
  }
  EXPECT_EQ(run_noli(verify({"--json", "/dev/null"})).exit_code, 0) << "a device is no file that could be lost";
}

TEST_F(OutputFiles, NoneIsAFileOfARun) {
  const std::string run_folder = run();
  const std::string before = blocks("run");
  fs::create_symlink(run_folder, run_path("link"));
  for (const char* name : {"trajectory.blocks", "proof.blocks", "log.jsonl", "series.h5", "manifest.json"}) {
    for (const std::string& place : {run_folder + "/" + name, run_path("link/") + name}) {
      expect_refused(forced({"explain", run_folder, "--json", place}), place + ": is ");
      expect_refused(forced(verify({"--proof", place})), place + ": is a file of the run in that folder");
      if (reports_are_there()) expect_refused(forced({"report", run_folder, "-o", place}), place + ": is ");
    }
    const std::string to_come = run_path("other/") + name;
    expect_refused(forced({"simulate", run_path("scene.json"), "-o", run_path("other"), "--json", to_come}),
                   to_come + ": is a file of the run in that folder");
  }
  EXPECT_TRUE(blocks("run") == before);
  EXPECT_FALSE(fs::exists(run_path("other")));
}

TEST_F(OutputFiles, OthersInTheFolderOfARunAreLetBe) {
  const std::string run_folder = run();
  const std::string page = run_folder + "/report.html";
  if (reports_are_there()) {
    EXPECT_EQ(run_noli({"report", run_folder, "-o", page}).exit_code, 0);
  } else {
    folder.write("run/report.html", "mine");
  }
  EXPECT_EQ(run_noli({"export", run_folder, "-o", run_folder + "/%d.vtu"}).exit_code, 0);
  EXPECT_EQ(run_noli({"verify", run_folder, "--no-check", "--json", run_folder + "/verdict.json"}).exit_code, 0);
  folder.write("scene.json", resting_bar(0.04, 0.01).dump(2));
  const Process process = run_noli({"simulate", run_path("scene.json"), "-o", run_folder, "--resume"});
  EXPECT_EQ(process.exit_code, 0) << process.err;
  EXPECT_TRUE(fs::exists(page));
}

TEST_F(OutputFiles, TwoAreNotOne) {
  const std::string p = run_path("p.noli");
  fs::create_symlink("p.noli", run_path("dangling"));
  fs::create_symlink(folder.path("."), run_path("here"));
  for (const std::string& json : {p, run_path("./p.noli"), run_path("dangling"), run_path("here/p.noli")}) {
    expect_refused(forced(verify({"--proof", p, "--json", json})), "--proof " + p + ": is where --json goes");
    expect_refused(forced(verify({"--claim-out", p, "--json", json})), "--claim-out " + p + ": is where --json goes");
  }
  EXPECT_FALSE(fs::exists(p));
  folder.write("p.noli", "mine");
  fs::create_hard_link(p, run_path("hard"));
  expect_refused(forced(verify({"--proof", p, "--json", run_path("hard")})), "is where --json goes");
  EXPECT_EQ(bytes_of(p), "mine");
  EXPECT_EQ(run_noli(forced(verify({"--proof", p, "--json", run_path("other.json")}))).exit_code, 0);
  EXPECT_EQ(run_noli({"check", p, run_path("a.ply"), run_path("b.ply")}).exit_code, 0);
}

TEST_F(OutputFiles, NoneIsRead) {
  fs::create_symlink("a.ply", run_path("link"));
  fs::create_hard_link(run_path("b.ply"), run_path("hard"));
  for (const char* name : {"a.ply", "link", "hard"}) {
    expect_refused(forced(verify({"--json", run_path(name)})), "is also an input");
    expect_refused(forced(verify({"--proof", run_path(name)})), "is also an input");
  }
  EXPECT_EQ(bytes_of(run_path("a.ply")), two_triangles(1));
  const std::string run_folder = run();
  fs::create_hard_link(run_folder + "/trajectory.blocks", run_path("blocks"));
  expect_refused(forced({"verify", run_folder, "--json", run_path("blocks")}), "is also an input");
}

TEST_F(OutputFiles, NoneIsReadByAScene) {
  Json json = resting_bar(0.04, 0.01);
  const std::string mesh = folder.write("mesh.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  json["dimension"] = 3;
  json["gravity"] = {0, 0, 0};
  json["bodies"] = {{{"name", "triangle"},
                     {"mesh", {{"file", "mesh.obj"}}},
                     {"material", {{"young", 1e4}, {"density", 200}, {"thickness", 0.001}}}}};
  const std::string scene = folder.write("named.json", json.dump(2));
  EXPECT_EQ(run_noli({"explain", scene}).exit_code, 0);
  expect_refused({"explain", scene, "--json", mesh, "--force"}, "is also an input");
  expect_refused({"simulate", scene, "-o", run_path("named"), "--json", mesh, "--force"}, "is also an input");
  EXPECT_EQ(bytes_of(mesh), "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  EXPECT_EQ(run_noli({"simulate", scene, "-o", run_path("named"), "--json", run_path("result")}).exit_code, 0);
}

TEST_F(OutputFiles, ALinkToNothingExists) {
  fs::create_symlink("nowhere", run_path("link"));
  expect_refused(verify({"--json", run_path("link")}), "exists already");
  EXPECT_FALSE(fs::exists(run_path("nowhere")));
}

}  // namespace
}  // namespace noli::app_tests
