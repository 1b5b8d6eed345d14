// SPDX-License-Identifier: Apache-2.0
//
// Tests bad input: exit code 3, one line that names the file, the place and what was expected, and no output files.
#include <gtest/gtest.h>

#include <algorithm>
#include <ostream>

#include "tests/app/process.h"
#include "tests/app/scene.h"

namespace noli::app_tests {
namespace {

using Arguments = std::vector<std::string>;

/// Runs the command with --json into the folder; expects a refusal whose line contains all of `parts`.
void expect_refusal(const Folder& folder, Arguments arguments, const std::vector<std::string>& parts) {
  const auto before = folder.names();
  arguments.insert(arguments.end(), {"--json", folder.path("result.json")});
  const Process process = run_noli(arguments);
  EXPECT_EQ(process.exit_code, 3) << process.out << process.err;
  EXPECT_EQ(process.out, "");
  EXPECT_EQ(process.err.rfind("noli: ", 0), 0u) << process.err;
  EXPECT_EQ(std::count(process.err.begin(), process.err.end(), '\n'), 1) << process.err;
  for (const std::string& part : parts)
    EXPECT_NE(process.err.find(part), std::string::npos) << part << " not in: " << process.err;
  EXPECT_EQ(folder.names(), before) << "something was written";
}

/// A fault in the second of two frames.
struct BadFrame {
  std::string name, file, content;
  std::vector<std::string> parts;
};

void PrintTo(const BadFrame& bad, std::ostream* out) { *out << bad.name; }

class BadFrames : public testing::TestWithParam<BadFrame> {};

TEST_P(BadFrames, AreRefused) {
  const Folder folder;
  const BadFrame& bad = GetParam();
  const auto good = folder.write("good.ply", two_triangles(1));
  const auto path = folder.write(bad.file, bad.content);
  auto parts = bad.parts;
  parts.push_back(path);
  expect_refusal(folder, {"verify", good, path}, parts);
}

std::string replaced(std::string text, const std::string& what, const std::string& with) {
  return text.replace(text.find(what), what.size(), with);
}

std::string without_end(const std::string& text, std::size_t count) { return text.substr(0, text.size() - count); }

/// A header of about a hundred bytes that promises a billion elements.
std::string huge_promise(const std::string& format) {
  return "ply\nformat " + format +
         " 1.0\nelement vertex 1000000000\nproperty float x\nproperty float y\nproperty float z\nend_header\n";
}

const std::vector<BadFrame> bad_frames = {
    {"empty_ply", "bad.ply", "", {}},
    {"empty_obj", "bad.obj", "", {}},
    {"truncated_ascii", "bad.ply", without_end(two_triangles(1), 8), {"line "}},
    {"truncated_binary", "bad.ply", without_end(sheets(10, 0), 5), {"byte "}},
    {"truncated_header", "bad.ply", "ply\nformat ascii 1.0\nelement vertex 3\n", {"line "}},
    {"not_a_number", "bad.ply", replaced(two_triangles(1), "1.5 1 1", "nan 1 1"), {"line 14"}},
    {"infinite", "bad.ply", replaced(two_triangles(1), "1.5 1 1", "1.5 inf 1"), {"line 14"}},
    {"infinite_obj", "bad.obj", "v 0 0 0\nv 1e999 0 0\nv 0 1 0\nf 1 2 3\n", {"line 2"}},
    {"index_out_of_range", "bad.ply", replaced(two_triangles(1), "3 3 4 5", "3 3 4 6"), {"line 17"}},
    {"negative_index", "bad.ply", replaced(two_triangles(1), "3 3 4 5", "3 3 4 -1"), {"line 17"}},
    {"index_out_of_range_obj", "bad.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n", {"line 4"}},
    {"promise_ascii", "bad.ply", huge_promise("ascii"), {}},
    {"promise_little_endian", "bad.ply", huge_promise("binary_little_endian"), {}},
    {"promise_big_endian", "bad.ply", huge_promise("binary_big_endian"), {}},
    {"other_vertex_count", "bad.ply", ply_text({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}), {"good.ply"}},
    {"other_connectivity", "bad.ply", replaced(two_triangles(1), "3 3 4 5", "3 3 5 4"), {"good.ply"}},
    {"other_format", "bad.stl", "solid\nendsolid\n", {}},
    {"not_ply", "bad.ply", "hello\n", {}}};

INSTANTIATE_TEST_SUITE_P(All, BadFrames, testing::ValuesIn(bad_frames),
                         [](const auto& test) { return test.param.name; });

/// A fault in a file of queries; the arguments follow `ccd FILE`.
struct BadQueries {
  std::string name, file, content;
  Arguments more;
  std::vector<std::string> parts;
};

void PrintTo(const BadQueries& bad, std::ostream* out) { *out << bad.name; }

class BadQueryFiles : public testing::TestWithParam<BadQueries> {};

TEST_P(BadQueryFiles, AreRefused) {
  const Folder folder;
  const BadQueries& bad = GetParam();
  const auto path = folder.write(bad.file, bad.content);
  Arguments arguments = {"ccd", path};
  arguments.insert(arguments.end(), bad.more.begin(), bad.more.end());
  auto parts = bad.parts;
  parts.push_back(bad.file);
  expect_refusal(folder, arguments, parts);
}

/// Rows of a vertex-vertex query in which both points rest apart.
std::string rows(const std::string& third = "5,1,0,1,0,1,0") {
  return "0,1,0,1,0,1,0\n1,1,0,1,0,1,0\n" + third + "\n1,1,0,1,0,1,0\n";
}

const std::vector<BadQueries> bad_queries = {
    {"empty", "vertex-vertex.csv", "", {}, {}},
    {"no_whole_number", "vertex-vertex.csv", rows() + "0,1,0,1,0,1,0\n", {}, {}},
    {"zero_denominator", "vertex-vertex.csv", rows("0,0,0,1,0,1,0"), {}, {"line 3"}},
    {"label_two", "vertex-vertex.csv", rows("0,1,0,1,0,1,2"), {}, {"line 3"}},
    {"no_double", "vertex-vertex.csv", rows("1,3,0,1,0,1,0"), {}, {"line 3"}},
    {"no_integer", "vertex-vertex.csv", rows("0.5,1,0,1,0,1,0"), {}, {"line 3"}},
    {"columns", "vertex-vertex.csv", rows("0,1,0,1,0"), {}, {"line 3"}},
    {"no_kind", "queries.csv", rows(), {}, {"--kind"}},
    {"no_such_kind_in_2d", "queries.csv", rows() + rows(), {"--kind", "edge-edge", "--dimension", "2"}, {"edge_edge"}}};

INSTANTIATE_TEST_SUITE_P(All, BadQueryFiles, testing::ValuesIn(bad_queries),
                         [](const auto& test) { return test.param.name; });

/// An invalid command line; %1 and %2 stand for two good frames.
struct BadLine {
  std::string name;
  Arguments arguments;
  std::vector<std::string> parts;
};

void PrintTo(const BadLine& bad, std::ostream* out) { *out << bad.name; }

class BadLines : public testing::TestWithParam<BadLine> {};

TEST_P(BadLines, AreRefused) {
  const Folder folder;
  Arguments arguments = GetParam().arguments;
  for (std::string& argument : arguments) {
    if (argument == "%1") argument = folder.write("1.ply", two_triangles(1));
    if (argument == "%2") argument = folder.write("2.ply", two_triangles(0.5));
  }
  expect_refusal(folder, arguments, GetParam().parts);
}

const std::vector<BadLine> bad_lines = {
    {"unknown_command", {"prove", "%1", "%2"}, {}},
    {"unknown_option", {"verify", "%1", "%2", "--tolerance", "1e-6"}, {"--tolerance"}},
    {"no_distance", {"verify", "%1", "%2", "--min-distance", "0"}, {"--min-distance"}},
    {"ring_without_distance", {"verify", "%1", "%2", "--min-distance-from-ring", "2"}, {"--min-distance-from-ring"}},
    {"single_frame", {"verify", "%1"}, {}},
    {"no_frame", {"verify"}, {}},
    {"missing_frame", {"verify", "%1", "%2", "/nowhere/frame.ply"}, {"/nowhere/frame.ply"}},
    {"missing_first_frame", {"verify", "/nowhere/frame.ply", "%2"}, {"/nowhere/frame.ply"}},
    {"folder_as_frame", {"verify", "%1", "/"}, {"/"}},
    {"negative_threads", {"verify", "%1", "%2", "--threads=-1"}, {"--threads"}},
    {"no_number", {"verify", "%1", "%2", "--threads", "two"}, {"--threads"}},
    {"no_duration", {"verify", "%1", "%2", "--time-limit", "soon"}, {"--time-limit", "soon"}},
    {"no_time", {"verify", "%1", "%2", "--time-limit", "0s"}, {"--time-limit"}},
    {"negative_time", {"verify", "%1", "%2", "--time-limit=-1s"}, {"--time-limit"}},
    {"endless_time", {"verify", "%1", "%2", "--time-limit", "1e300h"}, {"--time-limit"}},
    {"unknown_unit", {"verify", "%1", "%2", "--time-limit", "5parsec"}, {"--time-limit"}},
    {"dimension", {"verify", "%1", "%2", "--dimension", "4"}, {"--dimension"}},
    {"half_dimension", {"verify", "%1", "%2", "--dimension", "2.5"}, {"--dimension", "2.5", "expected 2 or 3"}},
    {"half_dimension_ccd", {"ccd", "%1", "--dimension", "2.5"}, {"--dimension", "2.5", "expected 2 or 3"}},
    {"two_lines", {"verify", "%1", "%2", "--time-limit", "1\n2"}, {"1\\n2"}},
    {"max_reports", {"verify", "%1", "%2", "--max-reports=-1"}, {"--max-reports"}},
    {"contradiction", {"verify", "%1", "%2", "--keep-going", "--first-only"}, {"--first-only"}},
    {"missing_queries", {"ccd", "/nowhere/edge-edge.csv"}, {"/nowhere/edge-edge.csv"}},
    {"unknown_kind", {"ccd", "/nowhere/queries.csv", "--kind", "edge-face"}, {"edge-face"}},
    {"missing_info", {"info", "/nowhere/frame.obj"}, {"/nowhere/frame.obj"}},
    {"fuzz_count", {"fuzz", "queries", "--count", "0"}, {"--count"}},
    {"fuzz_duration", {"fuzz", "queries", "--for", "1y"}, {"--for"}},
    {"fuzz_seed", {"fuzz", "queries", "--seed", "x"}, {"--seed"}},
    {"fuzz_out", {"fuzz", "queries", "--for", "1s", "--out", "/nowhere/deep/findings"}, {"/nowhere/deep/findings"}}};

INSTANTIATE_TEST_SUITE_P(All, BadLines, testing::ValuesIn(bad_lines), [](const auto& test) { return test.param.name; });

TEST(BadInput, AMeshOfNothingIsRefused) {
  const Folder folder;
  const auto path = folder.write("points.obj", "v 0 0 0\nv 1 0 0\n");
  expect_refusal(folder, {"verify", path, path}, {path, "no faces, edges or points"});
}

TEST(BadInput, AFileNameOfTwoLinesIsToldOnOne) {
  const Folder folder;
  expect_refusal(folder, {"verify", folder.path("a\n.ply"), "b.ply"}, {"a\\n.ply"});
  expect_refusal(folder, {"info", folder.write("c\n\x1b.ply", "")}, {"c\\n\\x1b.ply: is empty"});
  const auto good = folder.write("d\t\n.ply", two_triangles(1));
  EXPECT_NE(run_noli({"info", good}).out.find("d\\t\\n.ply\n"), std::string::npos);
}

TEST(BadInput, APromiseOfAThousandMillionElementsTakesNoMemory) {
  const Folder folder;
  const auto path = folder.write("a.ply", huge_promise("binary_little_endian"));
  EXPECT_LT(run_noli({"info", path}).peak_bytes, 300'000'000u);
}

TEST(BadInput, OutputThatCannotBeWrittenIsKnownBeforeTheWorkBegins) {
  const Folder folder;
  const auto a = folder.write("a.ply", two_triangles(1));
  for (const std::string& out : {folder.path("none/result.json"), folder.path("."), std::string("/proc/result.json")}) {
    // The frames are bad too, which would be reported if the output were checked later.
    const Process process = run_noli({"verify", a, "/nowhere/frame.ply", "--json", out});
    EXPECT_EQ(process.exit_code, 3);
    EXPECT_NE(process.err.find("--json " + out), std::string::npos) << process.err;
    EXPECT_EQ(folder.names(), std::vector<std::string>{"a.ply"});
  }
}

}  // namespace
}  // namespace noli::app_tests
