// SPDX-License-Identifier: Apache-2.0
//
// Tests `noli export RESULT.json`: a contact as a grid or as a picture.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "tests/app/process.h"
#include "tests/app/scene.h"
#include "tests/support/temporary_folder.h"

namespace noli::app_tests {
namespace {

class ContactExport : public testing::Test {
 protected:
  /// A result of frames in which the upper triangle passes through the lower one.
  std::string result(std::vector<std::string> more = {}) const {
    const std::string path = folder.path("result.json");
    std::vector<std::string> words = {
        "verify", folder.write("a.ply", two_triangles(1)), folder.write("b.ply", two_triangles(-1)), "--json", path,
        "--force"};
    words.insert(words.end(), more.begin(), more.end());
    run_noli(words);
    return path;
  }

  Process export_to(const std::string& output, const std::vector<std::string>& more = {}) const {
    std::vector<std::string> words = {"export", folder.path("result.json"), "-o", folder.path(output)};
    words.insert(words.end(), more.begin(), more.end());
    return run_noli(words);
  }

  void expect_refused(const Process& process, const std::string& part) const {
    EXPECT_EQ(process.exit_code, 3) << process.out;
    EXPECT_NE(process.err.find(part), std::string::npos) << process.err;
  }

  Folder folder;
};

/// At the time of contact the triangles coincide; the upper face has mark 1, the lower one mark 2.
TEST_F(ContactExport, WritesTheGridAtTheTimeOfContact) {
  result();
  const Process process = export_to("hits.vtu");
  EXPECT_EQ(process.exit_code, 0) << process.err;
  EXPECT_NE(process.out.find("WRITTEN  " + folder.path("hits.vtu") + "  step 1 at t = 0.5, 2 cells marked\n"),
            std::string::npos)
      << process.out;
  const std::string grid = test::read_text(folder.path("hits.vtu"));
  EXPECT_NE(grid.find("<CellData Scalars=\"contact\">"), std::string::npos);
  const std::string marks = "AgAAAAAAAAACAQ==";  // two bytes: 2, 1
  EXPECT_NE(grid.find(marks), std::string::npos) << grid;
}

TEST_F(ContactExport, WritesAPicture) {
#ifdef NOLI_WITH_PNG
  result();
  EXPECT_EQ(export_to("first.png", {"--size", "200x150"}).exit_code, 0);
  EXPECT_EQ(test::read_text(folder.path("first.png")).substr(1, 3), "PNG");
#else
  result();
  expect_refused(export_to("first.png"), "NOLI_WITH_PNG");
#endif
}

TEST_F(ContactExport, ShowsWhichOneIsAskedFor) {
  result();
  EXPECT_EQ(export_to("third.vtu", {"--contact", "3"}).exit_code, 0);
  expect_refused(export_to("fourth.vtu", {"--contact", "4"}), "lists 3 contacts");
}

TEST_F(ContactExport, RefusesFramesThatHaveChanged) {
  result();
  folder.write("b.ply", two_triangles(-2));
  expect_refused(export_to("hits.vtu"), "is about other frames");
  EXPECT_FALSE(std::filesystem::exists(folder.path("hits.vtu")));
}

TEST_F(ContactExport, RefusesResultsWithoutContact) {
  const std::string path = folder.path("result.json");
  run_noli(
      {"verify", folder.write("a.ply", two_triangles(1)), folder.write("b.ply", two_triangles(2)), "--json", path});
  expect_refused(export_to("hits.vtu"), "lists no contact");
  folder.write("result.json", "{}");
  expect_refused(export_to("hits.vtu"), "is not a result of noli verify");
}

/// "... t = 0.5, 2 cells marked"
std::size_t marked(const Process& process) { return std::stoul(process.out.substr(process.out.rfind(", ") + 2)); }

TEST_F(ContactExport, ShowsCellsThatIntersectWhereNoPairOfFeaturesMeets) {
  const std::string path = folder.path("result.json");
  run_noli({"verify", "--static", folder.write("pierced.ply", sail_through_deck()), "--json", path});
  const Process process = export_to("hits.vtu");
  EXPECT_EQ(process.exit_code, 0) << process.err;
  EXPECT_EQ(marked(process), 2U);
}

TEST_F(ContactExport, ShowsCellsThatComeTooNear) {
  run_noli({"verify", folder.write("a.ply", two_triangles(1)), folder.write("b.ply", two_triangles(0.5)), "--json",
            folder.path("result.json"), "--min-distance", "0.75"});
  const Process process = export_to("near.vtu");
  EXPECT_EQ(process.exit_code, 0) << process.err;
  EXPECT_EQ(marked(process), 2U);
}

/// Particles are cells too.
TEST_F(ContactExport, MarksParticles) {
  const auto frame = [&](const std::string& name, const std::string& z) {
    return folder.write(name, "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0.25 0.25 " + z + "\nf 1 2 3\n");
  };
  run_noli({"verify", "--points", frame("p.obj", "1"), frame("q.obj", "-1"), "--json", folder.path("result.json")});
  const Process process = export_to("hits.vtu");
  EXPECT_EQ(process.exit_code, 0) << process.err;
  EXPECT_EQ(marked(process), 2U);
}

/// Two faces share an edge only by position: with merged vertices, the edge belongs to both.
TEST_F(ContactExport, MarksWhatMergedVerticesBelongTo) {
  const auto frame = [&](const std::string& name, const std::string& z) {
    return folder.write(name, "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nv -1 -1 " + z + "\nv 2 2 " + z +
                                  "\nv 3 0 5\nf 1 2 3\nf 4 6 5\nf 7 8 9\n");
  };
  run_noli(
      {"verify", "--merge-identical", frame("p.obj", "1"), frame("q.obj", "-1"), "--json", folder.path("result.json")});
  const auto json = nlohmann::json::parse(test::read_text(folder.path("result.json")));
  std::size_t number = 0;
  while (json["reports"]["contacts"].at(number)["features"][0] != nlohmann::json({1, 2})) ++number;
  const Process process = export_to("hits.vtu", {"--contact", std::to_string(number + 1)});
  EXPECT_EQ(process.exit_code, 0) << process.err;
  EXPECT_EQ(marked(process), 3U) << "both faces at the edge, and the one that comes down";
}

TEST_F(ContactExport, RefusesWhatIsForRuns) {
  result();
  expect_refused(export_to("hits.ply"), "ends in .vtu or .png");
  expect_refused(export_to("hits.png", {"--at", "1"}), "--at: is for a run");
  expect_refused(export_to("hits.png", {"--zoom", "ball"}), "--zoom: is for a run");
  expect_refused(export_to("hits.png", {"--fps", "24"}), "apply to runs only");
  expect_refused(export_to("hits.vtu", {"--size", "200x150"}), "are for pictures");
}

TEST_F(ContactExport, ReplacesNothingUnlessForced) {
  result();
  folder.write("hits.vtu", "mine");
  expect_refused(export_to("hits.vtu"), "hits.vtu");
  EXPECT_EQ(test::read_text(folder.path("hits.vtu")), "mine");
  EXPECT_EQ(export_to("hits.vtu", {"--force"}).exit_code, 0);
}

}  // namespace
}  // namespace noli::app_tests
