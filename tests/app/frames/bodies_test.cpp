// SPDX-License-Identifier: Apache-2.0
//
// `noli verify --body NAME=FRAMES --obstacle FRAME`: several bodies are one mesh, and contacts are told by body.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <regex>

#include "tests/app/audits/libraries.h"
#include "tests/app/process.h"
#include "tests/app/scene.h"

namespace noli::app_tests {
namespace {

using Json = nlohmann::json;
using Points = std::vector<Position>;
using Faces = std::vector<std::array<VertexId, 3>>;

const Faces one_face = {{0, 1, 2}}, two_faces = {{0, 1, 2}, {3, 4, 5}};

/// A triangle at a height, moved along x.
Points triangle(double x, double z, double size = 1) {
  return {{x - size, -size, z}, {x + size, -size, z}, {x, size, z}};
}

Points together(Points a, const Points& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

/// A shirt of two triangles that comes down on a man's face in step 3, above a floor.
class Bodies : public testing::Test {
 protected:
  static constexpr std::size_t frames = 4;
  static Points shirt(std::size_t k) {
    return together(triangle(9, 5), triangle(0, 2.5 - static_cast<double>(k), 0.25));
  }
  static Points man(std::size_t k) { return together(triangle(-9, 0), triangle(0.0625 * static_cast<double>(k), 0)); }
  static Points floor() { return triangle(0, -5, 20); }

  Bodies() {
    for (std::size_t k = 0; k < frames; ++k) {
      folder.write(fmt::format("shirt_{}.ply", k), ply_text(shirt(k), two_faces));
      folder.write(fmt::format("man_{}.ply", k), ply_text(man(k), two_faces));
      folder.write(fmt::format("all_{}.ply", k),
                   ply_text(together(together(shirt(k), man(k)), floor()),
                            {{0, 1, 2}, {3, 4, 5}, {6, 7, 8}, {9, 10, 11}, {12, 13, 14}}));
    }
    folder.write("floor.ply", ply_text(floor(), one_face));
  }

  Words bodies(const std::string& which = "*") const {
    return {"--body",     "shirt=" + folder.path("shirt_" + which + ".ply"),
            "--body",     "man=" + folder.path("man_" + which + ".ply"),
            "--obstacle", folder.path("floor.ply")};
  }
  /// Without what tells bodies, and what differs from run to run.
  static Json without(Json json) {
    if (json.is_object()) {
      for (const char* const member : {"inputs", "notes", "timing", "order", "bodies", "own", "names", "proof"})
        json.erase(member);
    }
    for (Json& part : json) {
      if (part.is_structured()) part = without(part);
    }
    return json;
  }

  Folder folder;
};

TEST_F(Bodies, AreOneMesh) {
  const std::string proof = folder.path("p.noli"), other = folder.path("q.noli");
  const Json joined = json_of(Words{"verify", "--keep-going", "--proof", proof} + bodies(), 1);
  const Json one = json_of({"verify", "--keep-going", "--proof", other, folder.path("all_*.ply")}, 1);
  EXPECT_EQ(without(joined), without(one));
  EXPECT_TRUE(test::read_text(proof) == test::read_text(other));
  EXPECT_EQ(joined["statement"]["frames"], frames);
  EXPECT_EQ(run_noli(Words{"check", proof} + bodies()).exit_code, 1) << "both checkers take one for the other";
  EXPECT_EQ(run_noli(Words{"check", "--verified", other} + bodies()).exit_code, 1);
  EXPECT_EQ(run_noli({"check", proof, folder.path("all_*.ply")}).exit_code, 1);
}

TEST_F(Bodies, ApartAreProved) {
  const std::string proof = folder.path("p.noli");
  const Process process = run_noli(Words{"verify", "--proof", proof} + bodies("[0-2]"));
  EXPECT_EQ(process.exit_code, 0) << process.out << process.err;
  EXPECT_NE(process.out.find("PROVED  3 frames, 2 steps"), std::string::npos) << process.out;
  EXPECT_EQ(run_noli(Words{"check", proof} + bodies("[0-2]")).exit_code, 0);
  EXPECT_EQ(run_noli({"check", proof, folder.path("all_[0-2].ply")}).exit_code, 0);
  EXPECT_EQ(run_noli(Words{"check", proof} + bodies("[1-3]")).exit_code, 3);
}

TEST_F(Bodies, AreNamedWithTheirOwnNumbers) {
  const Process process = run_noli(Words{"verify"} + bodies());
  EXPECT_NE(process.out.find("vertex shirt[3] × face man[1] at ("), std::string::npos) << process.out;
  const Json json = json_of(Words{"verify"} + bodies(), 1);
  const Json& first = json["first"];
  EXPECT_EQ(first["bodies"], Json::parse(R"(["shirt", "man"])"));
  EXPECT_EQ(first["features"], Json::parse("[[3], [9, 10, 11]]"));
  EXPECT_EQ(first["own"], Json::parse(R"({"features": [[3], [3, 4, 5]], "face": 1})"));
  EXPECT_EQ(json["statement"]["bodies"][2], Json::parse(R"({"name": "floor", "first_vertex": 12, "vertices": 3,
                                                            "first_face": 4, "faces": 1, "still": true})"));
  EXPECT_EQ(json["inputs"].size(), 2 * frames + 1);
  EXPECT_EQ(json["inputs"][frames]["body"], "man");
  folder.write("r.json", json.dump());
  const Process shown = run_noli({"export", folder.path("r.json"), "-o", folder.path("hits.vtu")});
  EXPECT_EQ(shown.exit_code, 0) << shown.err;
}

TEST_F(Bodies, NameCellsThatAreTooNear) {
  const Words near = Words{"verify", "--min-distance", "1e3"} + bodies("[0-2]");
  const Json names = json_of(near, 1)["near"]["names"];
  ASSERT_EQ(names.size(), 2u);
  for (const Json& name : names) {
    EXPECT_TRUE(std::regex_match(name.get<std::string>(), std::regex(R"(face (shirt|man|floor)\[[01]\])"))) << name;
  }
  const Process process = run_noli(near);
  const std::string pair = names[0].get<std::string>() + " × " + names[1].get<std::string>();
  EXPECT_NE(process.verdict_line().find(pair), std::string::npos) << process.out;
}

TEST_F(Bodies, ThatMayTouchAreNamedToo) {
  const std::string ignore = folder.write("ignore.json", R"({"ignore": [["shirt", "man"]]})");
  const Process process = run_noli(Words{"verify", "--ignore", ignore} + bodies("[0-3]"));
  EXPECT_EQ(process.exit_code, 0) << process.out << process.err;
  EXPECT_NE(process.out.find("shirt"), std::string::npos) << "the verdict says what it leaves out: " << process.out;
  folder.write("ignore.json", R"({"ignore": [["shirt", "woman"]]})");
  expect_refused(Words{"verify", "--ignore", ignore} + bodies(), "there is no group woman");
  folder.write("ignore.json", R"({"groups": {"a": [0]}, "ignore": [["a", "a"]]})");
  expect_refused(Words{"verify", "--ignore", ignore} + bodies(), "the bodies are the groups");
  expect_refused(
      {"verify", "--ignore", folder.write("i.json", R"({"ignore": [["a", "b"]]})"), folder.path("all_*.ply")},
      "expected an object: names and vertices");
}

TEST_F(Bodies, AreRefusedWhenTheyDoNotGoTogether) {
  const std::string shirt = "shirt=" + folder.path("shirt_*.ply");
  expect_refused({"verify", "--body", shirt, "--body", "man=" + folder.path("man_[0-2].ply")},
                 "has 3 frames, but shirt has 4");
  expect_refused({"verify", "--body", shirt, "--body", shirt}, "two bodies shirt");
  expect_refused({"verify", "--body", "shirt"}, "expected a name and its files");
  expect_refused({"verify", "--body", shirt, "--obstacle", folder.path("man_*.ply")},
                 "expected one frame for an obstacle");
  expect_refused({"verify", "--obstacle", folder.path("floor.ply")}, "--body");
  expect_refused({"verify", "--body", shirt, folder.path("floor.ply")}, "--body");
  expect_refused({"verify"}, "needs FRAMES, bodies (--body) or the folder of a run");
  folder.write("shirt_2.ply", ply_text(man(2), {{0, 1, 2}, {3, 5, 4}}));
  expect_refused(Words{"verify"} + bodies(), "shirt_2.ply");
}

}  // namespace
}  // namespace noli::app_tests
