// SPDX-License-Identifier: Apache-2.0
//
// Tests `noli audit ccd --frames`: whole pipelines.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "tests/app/audits/libraries.h"
#include "tests/app/process.h"
#include "tests/app/scene.h"

namespace noli::app_tests {
namespace {

using Json = nlohmann::json;

/// A triangle falls through another one: only its three vertices meet the lower face.
class AuditFrames : public testing::Test {
 protected:
  std::vector<std::string> command(const std::string& library, const std::vector<std::string>& more = {}) const {
    std::vector<std::string> words = {"audit", "ccd", "--library", library, "--frames", before, after};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }

  void refused(const std::vector<std::string>& line, const std::string& words) const {
    const Process process = run_noli(line);
    EXPECT_EQ(process.exit_code, 3) << process.out;
    EXPECT_NE(process.err.find(words), std::string::npos) << process.err;
  }

  Folder folder;
  std::string before = folder.write("before.ply", two_triangles(1)),
              after = folder.write("after.ply", two_triangles(-1));
};

TEST_F(AuditFrames, FindsNothingInWhatIsRight) {
  const Process process = run_noli(command(plugin("noli")));
  EXPECT_EQ(process.exit_code, 0) << process.err;
  EXPECT_EQ(process.verdict_line(),
            "NO FINDING  audits 1, contacts.vertex_face 3, contacts.edge_edge 0, findings 0, complete true");
  const Json document = json_of(command(plugin("noli"), {"--tolerance", "0"}), 0);
  EXPECT_EQ(document["faces"], 2);
  EXPECT_EQ(document["edges"], 6);
  EXPECT_EQ(document["audits"][0]["early"]["count"], 3);
  EXPECT_EQ(document["audits"][0]["early"]["worst"], 0);
  EXPECT_GE(document["audits"][0]["candidates"]["vertex_face"], 3);
  EXPECT_EQ(document["audits"][0]["false_positives"]["edge_edge"], 0);
  EXPECT_EQ(without_timing(document), without_timing(json_of(command(plugin("noli"), {"--tolerance", "0"}), 0)));
}

/// The right answers are nowhere in the memory of the library's process.
TEST_F(AuditFrames, IsNotMisledByALibraryThatWritesBehindThePoints) {
  const Json audit = json_of(command(faulty("marks_what_lies_behind")), 1)["audits"][0];
  EXPECT_EQ(audit["not_found"], 3);
  EXPECT_EQ(audit["ending"], "finished");
}

TEST_F(AuditFrames, KeepsWhatALibrarySaysBeforeItCrashes) {
  add_sanitizer_options("handle_segv=0");
  const Process process = run_noli(command(faulty("says_why")));
  EXPECT_EQ(process.exit_code, 1);
  EXPECT_NE(process.out.find("wrote to its standard error: no memory for the \\x1b[31mtree\n"), std::string::npos)
      << process.out;
  const Json audit = json_of(command(faulty("says_why")), 1)["audits"][0];
  EXPECT_EQ(audit["ending"], "crash");
  EXPECT_EQ(audit["standard_error"], "no memory for the \x1b[31mtree\n");
  EXPECT_FALSE(json_of(command(plugin("noli")), 0)["audits"][0].contains("standard_error"));
}

TEST_F(AuditFrames, ASandboxKeepsALibraryFromOthers) {
  const std::string mine = folder.write("mine", "mine");
  ProcessOptions options;
  options.environment = {{"NOLI_TEST_FILE", mine}};
  const std::string inherited = folder.path("inherited");
  const int file = ::open(inherited.c_str(), O_CREAT | O_WRONLY | O_CLOEXEC, 0600);
  ASSERT_EQ(::dup2(file, 9), 9);  // inherited by `noli`
  const Process process = run_noli(command(faulty("attacks_others"), {"--sandbox", "--json", "-"}), options);
  ::close(file);
  ::close(9);
  if (process.err.find("cannot filter system calls") != std::string::npos) {
    EXPECT_EQ(process.exit_code, 3);
    GTEST_SKIP() << "this machine has no seccomp";
  }
  EXPECT_EQ(process.exit_code, 1) << process.err;
  const Json audit = Json::parse(process.out)["audits"][0];
  EXPECT_EQ(audit["ending"], "finished") << audit;
  EXPECT_EQ(read_text(mine), "mine");
  EXPECT_EQ(read_text(inherited), "");
  const Process ended = run_noli(command(faulty("ends_as_without_sandbox"), {"--sandbox", "--json", "-"}));
  EXPECT_EQ(ended.exit_code, 1) << ended.err;  // the library's exit code is not trusted
  EXPECT_NE(Json::parse(ended.out)["audits"][0]["ending"], "finished");
  options.environment = {{"NOLI_TEST_FILE", folder.path("new")}};
  EXPECT_EQ(run_noli(command(faulty("attacks_others"), {"--sandbox"}), options).exit_code, 1);
  EXPECT_FALSE(std::filesystem::exists(folder.path("new")));
  for (const char* library : {"noli", "textbook"}) {  // well-behaved libraries work as without it
    EXPECT_EQ(without_timing(json_of(command(plugin(library), {"--sandbox"}), 0)),
              without_timing(json_of(command(plugin(library)), 0)));
  }
}

TEST_F(AuditFrames, FindsWhatTheSearchMisses) {
  const Json audit = json_of(command(faulty("finds_nothing")), 1)["audits"][0];
  EXPECT_EQ(audit["not_found"], 3);
  EXPECT_EQ(audit["false_negatives"], 0);
  const Json first = {{"pair", "vertex_face"},
                      {"features", {{3}, {0, 1, 2}}},
                      {"finding", "not_found"},
                      {"words", "exact first time 0.5"}};
  EXPECT_EQ(audit["reports"].size(), 3);
  EXPECT_EQ(audit["reports"][0], first);
}

TEST_F(AuditFrames, NamesVerticesAsTheFramesDo) {
  const auto frame = [&](const char* name, double height) {
    return folder.write(
        name,
        ply_text(
            {{9, 9, 9}, {0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {8, 8, 8}, {1, 1, height}, {1.5, 1, height}, {1, 1.5, height}},
            {{1, 2, 3}, {5, 6, 7}}));
  };
  const Process process = run_noli({"audit", "ccd", "--library", faulty("finds_nothing"), "--frames", frame("a.ply", 1),
                                    frame("b.ply", -1), "--max-reports", "2"});
  const auto listed = [&](const char* words) { return process.out.find(words) != std::string::npos; };
  EXPECT_TRUE(listed("not_found: vertex 5 meets face 1-2-3: exact first time 0.5\n")) << process.out;
  EXPECT_TRUE(listed("vertex 6 meets face 1-2-3")) << process.out;
  EXPECT_FALSE(listed("vertex 7 meets face 1-2-3")) << process.out;
}

/// The edge from a vertex to itself meets other features, but is not passed to libraries.
TEST_F(AuditFrames, KnowsFacesThatListAVertexTwice) {
  const auto frame = [&](const char* name, double height) {
    return folder.write(name, ply_text({{0, 0, height}, {0, 0, height}, {4, 0, 0}, {0, 4, 0}}, {{3, 1, 2}, {1, 0, 0}}));
  };
  const Process process =
      run_noli({"audit", "ccd", "--library", plugin("noli"), "--frames", frame("a.ply", 0), frame("b.ply", 1)});
  EXPECT_EQ(process.exit_code, 0) << process.out << process.err;
}

TEST_F(AuditFrames, SaysWhatIsWrongWithAContact) {
  const auto listed = [&](const std::string& library, const std::string& words) {
    const Process process = run_noli(command(faulty(library)));
    EXPECT_EQ(process.exit_code, 1);
    EXPECT_NE(process.out.find(words), std::string::npos) << process.out;
  };
  const std::string contact = "vertex 3 meets face 0-1-2: ", truth = "exact first time 0.5\n";
  listed("never_hits", "false_negative: " + contact + truth);
  listed("fails", "failure: " + contact + truth);
  listed("lies_about_time", "late: " + contact + "1, " + truth);
  listed("has_wild_times", "bad_time: " + contact + "-7, " + truth);
}

TEST_F(AuditFrames, FindsCandidatesThatAreNone) {
  const Json audit = json_of(command(faulty("finds_neighbours")), 1)["audits"][0];
  EXPECT_EQ(audit["bad_pairs"], 6);
  EXPECT_EQ(audit["candidates"]["vertex_face"], 6);
  EXPECT_EQ(audit["false_positives"]["vertex_face"], 3);
  EXPECT_EQ(audit["not_found"], 0);
}

TEST_F(AuditFrames, GoesOnWithTheNextLibraryAfterACrash) {
  const Json document = json_of(command(faulty("crashes_when_searching"), {"--library", plugin("noli")}), 1);
  EXPECT_EQ(document["audits"][0]["ending"], "crash");
  EXPECT_EQ(document["audits"][1]["ending"], "finished");
  EXPECT_EQ(document["findings"], 1);
  EXPECT_EQ(document["complete"], false);
}

TEST_F(AuditFrames, RefusesWhatItCannotDo) {
  refused(command(faulty("always_hits")), "has no visible function noli_ccd_candidates");
  refused(command(plugin("noli"), {"--svg", folder.path("a.svg")}), "--svg");
  refused({"audit", "ccd", "a-edge-edge.csv", "--library", plugin("noli"), "--frames", before, after}, "and not both");
  refused({"audit", "ccd", "--library", plugin("noli")}, "expected files of queries, or --frames");
  refused({"audit", "ccd", "--library", plugin("noli"), "--frames", before, folder.path("absent.ply")}, "absent.ply");
}

TEST_F(AuditFrames, AgreesOnRealFramesSlow) {
  const auto first = real_data("frames/cloth-funnel/227.ply"), second = real_data("frames/cloth-funnel/228.ply");
  if (!first || !second) GTEST_SKIP() << "no real data";
  const Json document = json_of({"audit", "ccd", "--library", plugin("noli"), "--frames", *first, *second}, 0);
  EXPECT_EQ(document["contacts"]["vertex_face"], 27);
  EXPECT_EQ(document["contacts"]["edge_edge"], 107);
  EXPECT_EQ(document["audits"][0]["false_positives"]["edge_edge"], 0);
}

}  // namespace
}  // namespace noli::app_tests
