// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "tests/app/process.h"
#include "tests/app/scene.h"

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

TEST(Info, DescribesMotions) {
  const std::string data = std::string(NOLI_SOURCE_DIR) + "/tests/data/frames/";
  std::vector<std::pair<std::string, std::string>> files = {{"numpy.npz", "numpy"}};
#ifdef NOLI_SERIES
  files.emplace_back("once.vtkhdf", "HDF5");
#endif
  for (const auto& [name, format] : files) {
    const auto json = json_of({"info", data + name}, 0);
    const auto& file = json["files"][0];
    EXPECT_EQ(file["format"], format);
    EXPECT_EQ(file["frames"], 3);
    EXPECT_EQ(file["vertices"], 6);
    EXPECT_EQ(file["faces"], 2);
    EXPECT_EQ(file["number_type"], "float64");
  }
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

TEST(Info, DescribesAProof) {
  const Folder folder;
  const std::string a = folder.write("a.ply", two_triangles(2)), b = folder.write("b.ply", two_triangles(1)),
                    c = folder.write("c.ply", two_triangles(-1)), proof = folder.path("proof.noli");
  ASSERT_EQ(run_noli({"verify", a, b, "--proof", proof, "--min-distance", "0.25", "--strict"}).exit_code, 0);
  const auto told = [&] { return json_of({"info", proof}, 0)["files"][0]; };
  const nlohmann::json apart = told();
  EXPECT_EQ(apart["format"], "Noli proof");
  EXPECT_EQ(apart["about"], "frames");
  EXPECT_EQ(apart["dimension"], 3);
  EXPECT_EQ(apart["strict"], true);
  EXPECT_EQ(apart["least_distance"], 0.25);
  EXPECT_EQ(apart["steps"], 1);
  EXPECT_EQ(apart["steps_with_a_witness_of_contact"], 0);
  EXPECT_EQ(apart["begin"], 0);
  EXPECT_EQ(apart["end"], 1);
  EXPECT_GT(apart["token_bytes"], 0);
  EXPECT_EQ(apart["open_group"], false);
  EXPECT_EQ(apart["bytes"], std::filesystem::file_size(proof));

  ASSERT_EQ(run_noli({"verify", a, b, c, "--force", "--proof", proof}).exit_code, 1);
  const nlohmann::json refuted = told();
  EXPECT_EQ(refuted["strict"], false);
  EXPECT_EQ(refuted["steps"], 2);
  EXPECT_EQ(refuted["steps_with_a_witness_of_contact"], 1);
  EXPECT_EQ(refuted["end"], 2);

  std::filesystem::resize_file(proof, refuted["bytes"].get<std::uintmax_t>() - 1);
  const nlohmann::json torn = told();
  EXPECT_EQ(torn["open_group"], true);
  EXPECT_EQ(torn["steps"], 1);
}

TEST(Info, RefusesAProofThatIsNone) {
  const Folder folder;
  const std::string a = folder.write("a.ply", two_triangles(2)), proof = folder.path("proof.noli");
  ASSERT_EQ(run_noli({"verify", "--static", a, "--force", "--proof", proof}).exit_code, 0);
  const auto refused = [&](const std::string& words) {
    const Process process = run_noli({"info", proof});
    EXPECT_EQ(process.exit_code, 3) << process.out;
    EXPECT_NE(process.err.find(words), std::string::npos) << process.err;
  };
  const auto size = std::filesystem::file_size(proof);
  std::fstream(proof, std::ios::in | std::ios::out | std::ios::binary).seekp(30).put('\x7f');
  refused("proof.noli: byte 16: ");
  std::filesystem::resize_file(proof, size / 4);
  refused("proof.noli: ends before its claim is committed");
}

TEST(Info, SaysTheSameInText) {
  const Folder folder;
  const Process process =
      run_noli({"info", folder.write("a.ply", two_triangles(2)), folder.write("b.obj", "v 0 0\nv 1 1\nl 1 2\n")});
  EXPECT_EQ(process.exit_code, 0);
  EXPECT_EQ(process.verdict_line(), "DESCRIBED  files 2");
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
