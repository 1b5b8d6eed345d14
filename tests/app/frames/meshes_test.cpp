// SPDX-License-Identifier: Apache-2.0
//
// Tests `noli verify --static` of files with different meshes: one verdict each, and one for all.
#include <gtest/gtest.h>

#include "tests/app/process.h"
#include "tests/app/scene.h"

namespace noli::app_tests {
namespace {

using Words = std::vector<std::string>;

class Meshes : public testing::Test {
 protected:
  std::string triangle() const {
    return folder.write("triangle.ply", ply_text({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}));
  }
  std::string apart() const { return folder.write("two.ply", two_triangles(1)); }
  std::string crossing() const {
    return folder.write("crossing.obj",
                        "v 0 0 0\nv 4 0 0\nv 0 4 0\nv 1 1 -1\nv 1 1 1\nv 2 2 1\nv 9 9 9\nf 1 2 3\nf 4 5 6\n");
  }
  static Process verify(Words files, const Words& more = {}) {
    files.insert(files.begin(), {"verify", "--static"});
    files.insert(files.end(), more.begin(), more.end());
    return run_noli(files);
  }

  Folder folder;
};

TEST_F(Meshes, EachHasAVerdictAndAllHaveOne) {
  const Process good = verify({triangle(), apart()});
  EXPECT_EQ(good.exit_code, 0) << good.err;
  EXPECT_EQ(good.verdict_line(),
            "PROVED  2 meshes at rest: nothing touches in any; in 1 nothing can be compared (each accepted by the "
            "checker)");
  const Process bad = verify({triangle(), crossing(), apart()});
  EXPECT_EQ(bad.exit_code, 1) << bad.err;
  EXPECT_EQ(bad.verdict_line(), "CONTACT  in 1 of 3 meshes something touches; the first is " + crossing());
  EXPECT_NE(bad.out.find(crossing() + "\n  CONTACT  frame 1 ("), std::string::npos) << bad.out;
  EXPECT_NE(bad.out.find(apart() + "\n  PROVED  1 frame at rest: nothing touches"), std::string::npos) << bad.out;
  const Process unchecked = verify({triangle(), apart()}, {"--no-check"});
  EXPECT_EQ(unchecked.exit_code, 0);
  EXPECT_TRUE(unchecked.verdict_line().starts_with("NO CONTACT  2 meshes at rest")) << unchecked.out;
}

TEST_F(Meshes, TheResultHasThatOfEach) {
  const std::string bad = crossing(), good = apart();
  const Json both = json_of({"verify", "--static", good, bad}, 1);
  EXPECT_EQ(both["schema"], "noli-verify-meshes");
  EXPECT_EQ(both["verdict"], "contact");
  ASSERT_EQ(both["meshes"].size(), 2U);
  for (const auto& [file, code, k] : {std::tuple(good, 0, 0), std::tuple(bad, 1, 1)}) {
    Json alone = json_of({"verify", "--static", file}, code);
    Json among = both["meshes"][static_cast<std::size_t>(k)];
    EXPECT_EQ(among["file"], file);
    for (const char* const member : {"schema", "version", "noli", "timing"}) alone.erase(member);
    among["result"].erase("timing");
    EXPECT_EQ(among["result"], alone) << file;
  }
}

TEST_F(Meshes, TheFirstThatTouchesIsExported) {
  const std::string result = folder.path("result.json"), alone = folder.path("alone.vtu"),
                    among = folder.path("among.vtu");
  ASSERT_EQ(verify({crossing()}, {"--json", result}).exit_code, 1);
  ASSERT_EQ(run_noli({"export", result, "-o", alone}).exit_code, 0);
  ASSERT_EQ(verify({triangle(), crossing(), apart()}, {"--json", result, "--force"}).exit_code, 1);
  ASSERT_EQ(run_noli({"export", result, "-o", among}).exit_code, 0);
  EXPECT_EQ(read_text(among), read_text(alone));
  ASSERT_EQ(verify({triangle(), apart()}, {"--json", result, "--force"}).exit_code, 0);
  const Process none = run_noli({"export", result, "-o", alone, "--force"});
  EXPECT_EQ(none.exit_code, 3);
  EXPECT_NE(none.err.find("is about meshes in which nothing touches"), std::string::npos) << none.err;
}

TEST_F(Meshes, WhatIsAboutOneMeshIsRefused) {
  for (const Words& option : std::vector<Words>{{"--proof", folder.path("p.noli")},
                                                {"--claim-out", folder.path("c.json")},
                                                {"--junit", folder.path("j.xml")},
                                                {"--only-new"},
                                                {"--merge-identical"}}) {
    const Process process = verify({triangle(), apart()}, option);
    EXPECT_EQ(process.exit_code, 3) << option[0];
    EXPECT_NE(process.err.find("are about one mesh, but " + apart()), std::string::npos) << process.err;
  }
}

TEST_F(Meshes, OfAMotionStayAnError) {
  const Process process = run_noli({"verify", triangle(), apart()});
  EXPECT_EQ(process.exit_code, 3);
  EXPECT_NE(process.err.find("all frames must have the same mesh; --body is for several bodies"), std::string::npos)
      << process.err;
  EXPECT_EQ(verify({triangle(), folder.write("bad.ply", "ply\n")}).exit_code, 3);
}

}  // namespace
}  // namespace noli::app_tests
