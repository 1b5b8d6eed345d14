// SPDX-License-Identifier: Apache-2.0
//
// The claim belongs to who asks: `noli check` accepts no proof of less, and no witness against more, by either checker.
#include <gtest/gtest.h>

#include <cstring>

#include "noli/tests/app/process.h"
#include "noli/tests/app/scene.h"
#include "noli/tests/app/simulate_fixture.h"

namespace noli::app_tests {
namespace {

using Words = std::vector<std::string>;

class Claims : public Simulate {
 protected:
  Words frames(const std::vector<std::string>& texts) const {
    Words paths;
    for (const std::string& text : texts) {
      paths.push_back(folder.write("f" + std::to_string(paths.size()) + ".ply", text));
    }
    return paths;
  }
  Words triangles(const std::vector<double>& heights) const {
    std::vector<std::string> texts;
    for (const double height : heights) texts.push_back(two_triangles(height));
    return frames(texts);
  }
  std::string proof() const { return folder.path("proof.noli"); }

  int prove(const Words& paths, const Words& options) const {
    Words words = {"verify", "--proof", proof()};
    words.insert(words.end(), options.begin(), options.end());
    words.insert(words.end(), paths.begin(), paths.end());
    return run_noli(words).exit_code;
  }
  static Words requiring(const Words& asked) {
    Words words;
    for (const std::string& field : asked) words.insert(words.end(), {"--require", field});
    return words;
  }
  /// What the checkers that are there say: the same words, but for those of a rejection.
  static Process check(Words words) {
    words.insert(words.begin(), "check");
    const Process plain = run_noli(words);
    if (!verified_checker_is_there()) return plain;
    words.emplace_back("--verified");
    const Process verified = run_noli(words);
    EXPECT_EQ(verified.exit_code, plain.exit_code) << plain.out << plain.err << verified.out << verified.err;
    if (plain.exit_code != 3) EXPECT_EQ(verified.out, plain.out);
    return plain;
  }
  Process check(const Words& paths, const Words& asked) const {
    Words words = {proof()};
    words.insert(words.end(), paths.begin(), paths.end());
    const Words more = requiring(asked);
    words.insert(words.end(), more.begin(), more.end());
    return check(words);
  }
  /// Cuts a block file off behind so many commits.
  static void cut(const fs::path& file, int commits) {
    const std::string bytes = bytes_of(file);
    std::size_t at = 16;
    while (commits > 0) {
      std::uint64_t length;
      std::memcpy(&length, bytes.data() + at + 4, 8);
      if (bytes.compare(at, 4, "CMIT") == 0) --commits;
      at += 16 + length;
    }
    fs::resize_file(file, at);
  }
};

TEST_F(Claims, AtRestSaysNothingOfWhatHappensBetweenFrames) {
  const Words paths = triangles({1, -1});
  ASSERT_EQ(prove(paths, {"--static"}), 0);
  EXPECT_EQ(check(paths, {}).exit_code, 3);
}

TEST_F(Claims, MergedVerticesGlueBodiesTogether) {
  const std::string glued = ply_text({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {0, 0, 0}, {-4, 0, 1}, {0, -4, 1}},
                                     {{0, 1, 2}, {3, 4, 5}});
  const Words paths = frames({glued, glued});
  ASSERT_EQ(prove(paths, {"--merge-identical"}), 0);
  EXPECT_EQ(check(paths, {}).exit_code, 3);
}

TEST_F(Claims, OneCellWithAParticleThatFliesThroughItIsEmpty) {
  const auto above = [](double z) { return ply_text({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, z}}, {{0, 1, 2}}); };
  const Words paths = frames({above(1), above(-1)});
  ASSERT_EQ(prove(paths, {}), 0);
  EXPECT_EQ(check(paths, {}).exit_code, 3);
}

TEST_F(Claims, AWitnessInThePlaneRefutesNothingAboutFramesInSpace) {
  const Words paths = triangles({1, 0.5});
  ASSERT_EQ(prove(paths, {"--dimension", "2"}), 1);
  EXPECT_EQ(check(paths, {}).exit_code, 3);
}

TEST_F(Claims, ARunThatIsCutOffLacksWindows) {
  Json sheet = hanging_sheet();
  sheet["duration"] = 0.2;
  const std::string run = run_path("run");
  ASSERT_EQ(run_noli({"simulate", scene(sheet), "-o", run}).exit_code, 0);
  EXPECT_EQ(check(Words{run}).exit_code, 0);
  for (const char* const file : {"trajectory.blocks", "proof.blocks"}) cut(fs::path(run) / file, 1 + 5);
  EXPECT_EQ(check(Words{run}).exit_code, 3);
}

}  // namespace
}  // namespace noli::app_tests
