// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "noli/tests/app/process.h"
#include "noli/tests/app/scene.h"

namespace noli::app_tests {
namespace {

TEST(Info, DescribesAMesh) {
  const Folder folder;
  const auto json = json_of({"info", folder.write("a.ply", two_triangles(2))}, 0);
  const auto& file = json["files"][0];
  EXPECT_EQ(file["format"], "PLY ASCII");
  EXPECT_EQ(file["vertices"], 6);
  EXPECT_EQ(file["faces"], 2);
  EXPECT_EQ(file["mesh_edges"], 6);
  EXPECT_EQ(file["planar"], false);
  EXPECT_EQ(file["upper"], nlohmann::json({4.0, 4.0, 2.0}));
}

TEST(Info, DescribesQueries) {
  const Folder folder;
  const std::string rows = "0,1,0,1,0,1,1\n0,1,0,1,0,1,1\n0,1,0,1,0,1,1\n0,1,0,1,0,1,1\n";
  const auto json = json_of({"info", folder.write("vertex-vertex.csv", rows + rows)}, 0);
  const auto& file = json["files"][0];
  EXPECT_EQ(file["kind"], "vertex_vertex");
  EXPECT_EQ(file["queries"], 2);
  EXPECT_EQ(file["labelled"], 2);
  EXPECT_EQ(file["labelled_contact"], 2);
}

TEST(Info, SaysTheSameInText) {
  const Folder folder;
  const Process process =
      run_noli({"info", folder.write("a.ply", two_triangles(2)), folder.write("b.obj", "v 0 0\nv 1 1\nl 1 2\n")});
  EXPECT_EQ(process.exit_code, 0);
  EXPECT_EQ(process.verdict_line(), "verdict described files 2");
  EXPECT_NE(process.out.find("loose_edges 1"), std::string::npos) << process.out;
}

TEST(Info, SuggestsNoOptionThatItDoesNotHave) {
  const Folder folder;
  const auto path = folder.write("queries.csv", "0,1,0,1,0,1,0\n");
  const Process process = run_noli({"info", path});
  EXPECT_EQ(process.exit_code, 3);
  EXPECT_NE(process.err.find(path + ": the name does not say what the queries are"), std::string::npos) << process.err;
  EXPECT_EQ(process.err.find("--kind"), std::string::npos) << process.err;
  EXPECT_NE(run_noli({"ccd", path}).err.find("--kind"), std::string::npos);
}

}  // namespace
}  // namespace noli::app_tests
