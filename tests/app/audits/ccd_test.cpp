// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "tests/app/process.h"
#include "tests/app/scene.h"

namespace noli::app_tests {
namespace {

using Json = nlohmann::json;

/// One row: a point with integer coordinates, and a label if given.
std::string row(int x, int y, int z, const std::string& label) {
  const auto cell = [](int value) { return std::to_string(value) + ",1"; };
  return cell(x) + "," + cell(y) + "," + cell(z) + (label.empty() ? "" : "," + label) + "\n";
}

/// A vertex over the middle of an edge along x, moving from height 1 to `end` in y.
std::string vertex_edge(int end, const std::string& label, int z = 0) {
  return row(0, 1, z, label) + row(-2, 0, 0, label) + row(2, 0, 0, label) + row(0, end, z, label) +
         row(-2, 0, 0, label) + row(2, 0, 0, label);
}

class Ccd : public testing::Test {
 protected:
  Folder folder;
};

TEST_F(Ccd, AgreesWithRightLabels) {
  const auto path = folder.write("a-vertex-edge.csv", vertex_edge(-3, "1") + vertex_edge(1, "0") + vertex_edge(0, "1"));
  const Process process = run_noli({"ccd", path});
  EXPECT_EQ(process.exit_code, 0) << process.err;
  EXPECT_EQ(process.verdict_line(), "AGREEMENT  queries 3, contacts 2, labelled 3, disagreements 0, complete true");
  const Json json = json_of({"ccd", path}, 0);
  EXPECT_EQ(json["queries"], 3);
  EXPECT_EQ(json["contacts"], 2);
  EXPECT_EQ(json["labelled"], 3);
  EXPECT_EQ(json["disagreements"], 0);
  EXPECT_GT(json["timing"]["ns_per_query"], 0);
  std::uint64_t decided = 0;
  for (const auto& count : json["stages"]) decided += count.get<std::uint64_t>();
  EXPECT_EQ(decided, 3u);
}

TEST_F(Ccd, NoticesAFlippedLabel) {
  const auto path = folder.write("vertex_edge.csv", vertex_edge(-3, "1") + vertex_edge(1, "1") + vertex_edge(0, "0"));
  const Process process = run_noli({"ccd", path});
  EXPECT_EQ(process.exit_code, 1);
  EXPECT_EQ(process.verdict_line(), "DISAGREEMENT  queries 3, contacts 2, labelled 3, disagreements 2, complete true");
  EXPECT_NE(process.out.find("query 2: labelled 1, but apart"), std::string::npos) << process.out;
  EXPECT_NE(process.out.find("query 3: labelled 0, but in contact"), std::string::npos) << process.out;
  const Json json = json_of({"ccd", path, "--max-reports", "1"}, 1);
  EXPECT_EQ(json["disagreements"], 2);
  EXPECT_EQ(json["files"][0]["disagreement_reports"], Json::parse(R"([{"query": 2, "label": 1, "contact": false}])"));
}

TEST_F(Ccd, DecidesWithoutLabels) {
  const auto path = folder.write("queries.csv", vertex_edge(-3, "") + vertex_edge(1, ""));
  const Json json = json_of({"ccd", path, "--kind", "vertex-edge"}, 0);
  EXPECT_EQ(json["verdict"], "decided");
  EXPECT_EQ(json["labelled"], 0);
  EXPECT_EQ(json["contacts"], 1);
}

TEST_F(Ccd, IgnoresZInTwoDimensions) {
  const auto path = folder.write("vertex-edge.csv", vertex_edge(-1, "1", 7));
  EXPECT_EQ(run_noli({"ccd", path}).exit_code, 1);
  EXPECT_EQ(run_noli({"ccd", path, "--dimension", "2"}).exit_code, 0);
}

TEST_F(Ccd, PrintsTimesAndKindsRoundedDown) {
  const auto path = folder.write("vertex-edge.csv", vertex_edge(-2, "1") + vertex_edge(1, "0") + vertex_edge(0, "1"));
  const Process process = run_noli({"ccd", path, "--dimension", "2", "--times"});
  EXPECT_NE(process.out.find("query 1: crossing at 0.33333333333333331\n"), std::string::npos) << process.out;
  EXPECT_EQ(process.out.find("query 2: "), std::string::npos) << process.out;
  EXPECT_NE(process.out.find("query 3: touching at 1.0\n"), std::string::npos) << process.out;
  const Json json = json_of({"ccd", path, "--times"}, 0);
  const Json times = Json::parse(R"([{"query": 1, "kind": "touching", "time": 0.33333333333333331},
                                     {"query": 3, "kind": "touching", "time": 1.0}])");
  EXPECT_EQ(json["files"][0]["times"], times) << "in 3D no contact of a vertex with an edge has codimension one";
}

TEST_F(Ccd, AddsUpSeveralFiles) {
  const auto a = folder.write("a-vertex-edge.csv", vertex_edge(-3, "1"));
  const auto b = folder.write("b-vertex-edge.csv", vertex_edge(1, ""));
  const Json json = json_of({"ccd", a, b}, 0);
  EXPECT_EQ(json["queries"], 2);
  EXPECT_EQ(json["labelled"], 1);
  EXPECT_EQ(json["files"].size(), 2u);
  EXPECT_EQ(json["timing"]["files"].size(), 2u);
}

TEST_F(Ccd, GivesTheSameBytesTwice) {
  const auto path = folder.write("vertex-edge.csv", vertex_edge(-3, "1") + vertex_edge(1, "0"));
  EXPECT_EQ(without_timing(json_of({"ccd", path, "--times"}, 0)), without_timing(json_of({"ccd", path, "--times"}, 0)));
}

TEST_F(Ccd, AgreesWithTheLabelsOfRealQueries) {
  std::vector<std::string> arguments = {"ccd"};
  for (const char* const name :
       {"unit-tests-edge-edge-0", "unit-tests-vertex-face-0", "cloth-funnel-edge-edge", "cloth-funnel-vertex-face"}) {
    if (const auto path = real_data("queries/" + std::string(name) + ".csv")) arguments.push_back(*path);
  }
  if (arguments.size() == 1) GTEST_SKIP() << "no real data";
  const Json json = json_of(arguments, 0);
  EXPECT_EQ(json["labelled"], json["queries"]);
  EXPECT_GT(json["contacts"], 0);
}

TEST_F(Ccd, NoticesAFlippedLabelAmongRealQueries) {
  const auto original = real_data("queries/cloth-funnel-vertex-face.csv");
  if (!original) GTEST_SKIP() << "no real data";
  // The labels of the first query are the last characters of its eight lines.
  std::string text = read_text(*original);
  std::size_t end = 0;
  for (int line = 0; line < 8; ++line) {
    end = text.find('\n', end + 1);
    char& label = text[text.find_last_of("01", end)];
    label = label == '1' ? '0' : '1';
  }
  const Json json = json_of({"ccd", folder.write("flipped-vertex-face.csv", text)}, 1);
  EXPECT_EQ(json["disagreements"], 1);
}

}  // namespace
}  // namespace noli::app_tests
