// SPDX-License-Identifier: Apache-2.0
//
// Names that stand for many frames: folders, patterns, lists.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include <noli/errors.h>
#include "tests/support/temporary_folder.h"
#include "trajectory/formats/frame_names.h"

namespace noli {
namespace {

namespace fs = std::filesystem;

class NamedFrames : public ::testing::Test {
 protected:
  fs::path file(const std::string& name) const {
    fs::create_directories((folder.path() / name).parent_path());
    folder.write(name, "");
    return folder.path() / name;
  }
  /// The names of the files that something stands for, relative to the folder.
  std::vector<std::string> named(const std::string& name) const {
    return relative(named_frames({folder.path() / name}));
  }
  std::vector<std::string> relative(const std::vector<fs::path>& files) const {
    std::vector<std::string> names;
    for (const fs::path& path : files) names.push_back(path.lexically_relative(folder.path()).string());
    return names;
  }
  void expect_refused(const fs::path& name, const std::string& because) const {
    try {
      named_frames({name});
      FAIL() << "expected a refusal: " << because;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(because), std::string::npos) << error.what();
    }
  }

  test::TemporaryFolder folder;
};

using Names = std::vector<std::string>;

TEST_F(NamedFrames, OfAFolderAreItsFramesByNumber) {
  for (const char* name : {"f/cloth_10.ply", "f/cloth_2.ply", "f/cloth_1.PLY", "f/notes.txt", "f/.hidden.ply"})
    file(name);
  fs::create_directories(folder.path() / "f/more.ply");
  EXPECT_EQ(named("f"), (Names{"f/cloth_1.PLY", "f/cloth_2.ply", "f/cloth_10.ply"}));
  file("f/body.obj");
  expect_refused(folder.path() / "f", "has frames of two formats, body.obj and cloth_1.PLY");
}

TEST_F(NamedFrames, FoldersOfRunsAndFoldersWithoutFramesStay) {
  file("run/trajectory.blocks"), file("run/frame.ply");
  fs::create_directories(folder.path() / "empty");
  EXPECT_EQ(named("run"), Names{"run"});
  EXPECT_EQ(named("empty"), Names{"empty"});
}

TEST_F(NamedFrames, OfAPatternAreTheFilesThatMatch) {
  for (const char* name : {"a_10.obj", "a_9.obj", "b_1.obj", "a_x.obj.bak"}) file(name);
  EXPECT_EQ(named("a_*.obj"), (Names{"a_9.obj", "a_10.obj"}));
  EXPECT_EQ(named("[ab]_?.obj"), (Names{"a_9.obj", "b_1.obj"}));
  expect_refused(folder.path() / "c_*.obj", "c_*.obj: matches no file");
  expect_refused(folder.path() / "nowhere/c_*.obj", "cannot be listed");
}

TEST_F(NamedFrames, OfANumberAreThoseWithSoManyDigits) {
  for (const char* name : {"0009.ply", "0010.ply", "10011.ply", "12.ply", "00013.ply", "x0014.ply"}) file(name);
  EXPECT_EQ(named("%04d.ply"), (Names{"0009.ply", "0010.ply", "10011.ply"}));
  EXPECT_EQ(named("%d.ply"), (Names{"12.ply", "10011.ply"}));
}

TEST_F(NamedFrames, AFileThatIsThereIsNoPattern) {
  file("a[1].ply"), file("a1.ply"), file("50%d.ply");
  EXPECT_EQ(named("a[1].ply"), Names{"a[1].ply"});
  EXPECT_EQ(named("50%d.ply"), Names{"50%d.ply"});
  EXPECT_EQ(named("plain.ply"), Names{"plain.ply"}) << "whoever opens it says that it is not there";
}

TEST_F(NamedFrames, OfAListAreItsLinesInTheirOrder) {
  folder.write("list.txt", "# by hand\n f/b.ply \r\n\nf/a.ply\nf/b.ply\n");
  const std::string list = "@" + (folder.path() / "list.txt").string();
  EXPECT_EQ(relative(named_frames({list})), (Names{"f/b.ply", "f/a.ply", "f/b.ply"}));
  folder.write("list.txt", "# nothing\n");
  expect_refused(list, "names no frame");
  expect_refused("@" + (folder.path() / "none.txt").string(), "cannot be opened");
}

TEST_F(NamedFrames, StandBesideOthers) {
  for (const char* name : {"f/2.ply", "f/1.ply", "a.ply"}) file(name);
  EXPECT_EQ(relative(named_frames({folder.path() / "a.ply", folder.path() / "f"})),
            (Names{"a.ply", "f/1.ply", "f/2.ply"}));
}

}  // namespace
}  // namespace noli
