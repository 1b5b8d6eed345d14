// SPDX-License-Identifier: Apache-2.0
//
// Tests that the caller sets the claim: both checkers of `noli check` reject proofs of weaker claims, and witnesses
// against stronger ones.
#include <gtest/gtest.h>

#include <cstring>
#include <iterator>
#include <sstream>

#include "tests/app/process.h"
#include "tests/app/runs/simulate_fixture.h"
#include "tests/app/scene.h"

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
    Words words = {"verify", "--force", "--proof", proof(), "--claim-out", folder.path("claim.json")};
    words.insert(words.end(), options.begin(), options.end());
    words.insert(words.end(), paths.begin(), paths.end());
    return run_noli(words).exit_code;
  }
  static Words requiring(const Words& asked) {
    Words words;
    for (const std::string& field : asked) words.insert(words.end(), {"--require", field});
    return words;
  }
  /// The comparable output: all of it, except for rejections that are not about the claim. Checkers may word those
  /// differently, so only the word REJECTED counts.
  static std::string told_by(const Process& process) {
    const std::string line = process.verdict_of_checker();
    if (process.exit_code != 3) {
      const std::string said = process.out.substr(0, process.out.rfind(" (noli_check"));
      const std::size_t next = said.find("Next: ");  // names the other checker
      return next == std::string::npos ? said : said.substr(0, next) + said.substr(said.find('\n', next) + 1);
    }
    return line.starts_with("REJECTED  the claim: ") ? line : line.substr(0, line.find(' '));
  }
  /// Runs all checkers that are built, and expects the same output.
  static Process check(Words words) {
    words.insert(words.begin(), "check");
    const Process plain = run_noli(words);
    if (!verified_checker_is_there()) return plain;
    words.emplace_back("--verified");
    const Process verified = run_noli(words);
    EXPECT_EQ(verified.exit_code, plain.exit_code) << plain.out << plain.err << verified.out << verified.err;
    EXPECT_EQ(told_by(verified), told_by(plain));
    return plain;
  }
  Process check(const Words& paths, const Words& asked) const {
    Words words = {proof()};
    words.insert(words.end(), paths.begin(), paths.end());
    const Words more = requiring(asked);
    words.insert(words.end(), more.begin(), more.end());
    return check(words);
  }
  /// Expects a rejection because of this field.
  void expect_rejected(const Words& paths, const Words& asked, const std::string& field) const {
    const Process process = check(paths, asked);
    EXPECT_EQ(process.exit_code, 3) << process.out;
    EXPECT_NE(process.out.find("REJECTED  the claim: " + field + ": "), std::string::npos)
        << process.out << process.err;
    EXPECT_NE(process.out.find("; --require "), std::string::npos) << process.out;
  }
  /// Expects a rejection by default, and this answer if the field is required by name.
  void expect_weaker(const Words& paths, const Words& asked, const std::string& field, int code,
                     const std::string& on_the_line) const {
    expect_rejected(paths, {}, field);
    const Process process = check(paths, asked);
    EXPECT_EQ(process.exit_code, code) << process.out << process.err;
    EXPECT_NE(process.out.find(on_the_line), std::string::npos) << process.out;
  }
  Json asked_claim() const { return Json::parse(read_text(folder.path("claim.json"))); }
  /// Two triangles with a common corner that is listed twice.
  Words glued() const {
    const std::string frame =
        ply_text({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {0, 0, 0}, {-4, 0, 1}, {0, -4, 1}}, {{0, 1, 2}, {3, 4, 5}});
    return frames({frame, frame});
  }
  /// A vertex without a cell that passes through a triangle.
  Words particle() const {
    const auto at = [](double z) { return ply_text({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, z}}, {{0, 1, 2}}); };
    return frames({at(1), at(-1)});
  }
  /// Cuts a block file off after `commits` commits.
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
  expect_weaker(paths, {"motion=rest"}, "motion", 0, "; frames at rest (");
}

TEST_F(Claims, MergedVerticesGlueBodiesTogether) {
  const Words paths = glued();
  ASSERT_EQ(prove(paths, {"--merge-identical"}), 0);
  const std::string cells = "cells=" + asked_claim()["cells"].get<std::string>();
  expect_weaker(paths, {"merged=1", cells}, "merged", 0, "; 1 merged vertices (");
  EXPECT_EQ(check(paths, {"merged=7", cells}).exit_code, 0);
  EXPECT_EQ(check(paths, {"merged=7"}).exit_code, 3);
}

TEST_F(Claims, OneCellWithAParticleThatFliesThroughItIsEmpty) {
  const Words paths = particle();
  ASSERT_EQ(prove(paths, {}), 0);
  expect_weaker(paths, {"empty"}, "empty", 0, "; the claim is empty (");
}

TEST_F(Claims, AWitnessInThePlaneRefutesNothingAboutFramesInSpace) {
  const Words paths = triangles({1, 0.5});
  ASSERT_EQ(prove(paths, {"--dimension", "2"}), 1);
  expect_weaker(paths, {"dimension=2"}, "dimension", 1, "; z does not count (");
}

TEST_F(Claims, ARunThatIsCutOffLacksWindows) {
  Json sheet = hanging_sheet();
  sheet["duration"] = 0.2;
  const std::string run = run_path("run");
  ASSERT_EQ(run_noli({"simulate", scene(sheet), "-o", run}).exit_code, 0);
  EXPECT_EQ(check(Words{run}).exit_code, 0);
  for (const char* const file : {"proof.blocks", "trajectory.blocks"}) {
    cut(fs::path(run) / file, 1 + 5);
    const Process less = check(Words{run});
    EXPECT_EQ(less.exit_code, 3);
    EXPECT_NE(less.out.find("REJECTED  the claim: steps: the proof says 5, asked was "), std::string::npos) << less.out;
    const Process asked = check(Words{run, "--require", "steps=5"});
    EXPECT_EQ(asked.exit_code, 0) << asked.out << asked.err;
    EXPECT_EQ(asked.out.find("; the first 5 steps") != std::string::npos, file == std::string("proof.blocks"));
  }
}

/// Any remaining line proves that the windows before it existed.
TEST_F(Claims, ADamagedLogHidesNoMissingWindows) {
  Json sheet = hanging_sheet();
  sheet["duration"] = 0.2;
  const std::string run = run_path("run");
  ASSERT_EQ(run_noli({"simulate", scene(sheet), "-o", run}).exit_code, 0);
  const fs::path log = fs::path(run) / "log.jsonl";
  std::vector<std::string> lines;
  std::istringstream text(bytes_of(log));
  for (std::string line; std::getline(text, line);) lines.push_back(line);
  // First keeps only the line of the last window, then none of the windows' lines.
  const auto keep = [&](const std::vector<std::string>& events) {
    std::ofstream out(log, std::ios::binary);
    for (const std::string& line : lines) {
      const bool window = line.find("\"event\":\"window\"") != std::string::npos;
      const bool kept = std::ranges::any_of(events, [&](const auto& e) { return line.find(e) != std::string::npos; });
      if (!window || kept) out << line << '\n';
    }
  };
  const std::vector<std::vector<std::string>> damages = {{"\"window\":19"}, {}};
  for (const auto& kept : damages) {
    keep(kept);
    EXPECT_EQ(check(Words{run}).exit_code, 0);
  }
  for (const char* const file : {"proof.blocks", "trajectory.blocks"}) cut(fs::path(run) / file, 1 + 19);
  for (const auto& kept : damages) {
    keep(kept);
    const Process less = check(Words{run});
    EXPECT_EQ(less.exit_code, 3) << less.out;
    EXPECT_NE(less.out.find("steps: the proof says 19, asked was 20"), std::string::npos) << less.out;
    EXPECT_EQ(run_noli({"verify", run}).exit_code, 3);
  }
}

TEST_F(Claims, FewerStepsThanThereAre) {
  const Words paths = triangles({1, 0.5, 0.25, -1});
  const Words some(paths.begin(), paths.end() - 1);
  ASSERT_EQ(prove(some, {}), 0);
  expect_weaker(paths, {"steps=2"}, "steps", 0, "; the first 2 steps (");
  EXPECT_EQ(check(paths, {"steps=3"}).exit_code, 3);
}

TEST_F(Claims, AWitnessBehindTheStepsThatWereAsked) {
  const Words paths = triangles({1, 0.5, -1});
  ASSERT_EQ(prove(paths, {}), 1);
  EXPECT_EQ(check(paths, {}).exit_code, 1);
  EXPECT_EQ(check(paths, {"steps=2"}).exit_code, 1);
  const Process first = check(paths, {"steps=1"});
  EXPECT_EQ(first.exit_code, 0) << first.out;
  EXPECT_NE(first.out.find("ACCEPTED  nothing touches; the first 1 steps ("), std::string::npos) << first.out;
}

TEST_F(Claims, AWitnessBetweenFramesRefutesNothingAboutFramesAtRest) {
  const Words paths = triangles({1, -1});
  ASSERT_EQ(prove(paths, {}), 1);
  EXPECT_EQ(check(paths, {}).exit_code, 1);
  EXPECT_EQ(check(paths, {"motion=rest"}).exit_code, 3);
  const Words touching = triangles({1, 0, 1});
  ASSERT_EQ(prove(touching, {"--static"}), 1);
  for (const Words& asked : {Words{}, Words{"motion=rest"}}) EXPECT_EQ(check(touching, asked).exit_code, 1);
}

TEST_F(Claims, FeaturesOfOneCellWhereTheyWereAsked) {
  const Words paths = triangles({1, 0.5});
  ASSERT_EQ(prove(paths, {}), 0);
  expect_rejected(paths, {"strict"}, "strict");
  ASSERT_EQ(prove(paths, {"--strict"}), 0);
  for (const Words& asked : {Words{}, Words{"strict"}}) EXPECT_EQ(check(paths, asked).exit_code, 0);
  // A face that folds onto a line, next to another one.
  const auto folding = [](double y) {
    return ply_text({{0, 0, 0}, {2, 0, 0}, {1, y, 0}, {0, 0, 5}, {2, 0, 5}, {1, 1, 6}}, {{0, 1, 2}, {3, 4, 5}});
  };
  const Words folded = frames({folding(1), folding(-1)});
  ASSERT_EQ(prove(folded, {"--strict"}), 1);
  expect_weaker(folded, {"strict"}, "strict", 1, "; features of one cell count (");
}

TEST_F(Claims, VerticesWithoutACellWhereTheyWereAsked) {
  const Words paths = triangles({1, 0.5});
  ASSERT_EQ(prove(paths, {}), 0);
  expect_rejected(paths, {"points"}, "points");
  const Words through = particle();
  ASSERT_EQ(prove(through, {"--points"}), 1);
  expect_weaker(through, {"points"}, "points", 1, "; vertices without a cell count (");
}

TEST_F(Claims, TheLeastDistanceInBothDirections) {
  const Words paths = triangles({1, 0.5});
  ASSERT_EQ(prove(paths, {}), 0);
  expect_rejected(paths, {"distance=0.25"}, "distance");
  ASSERT_EQ(prove(paths, {"--min-distance", "0.25"}), 0);
  for (const char* const asked : {"distance=0", "distance=0.125", "distance=0.25"}) {
    EXPECT_EQ(check(paths, {asked}).exit_code, 0) << asked;
  }
  expect_rejected(paths, {"distance=0.375"}, "distance");
  ASSERT_EQ(prove(paths, {"--min-distance", "0.75"}), 1);
  expect_weaker(paths, {"distance=0.75"}, "distance", 1, " are too near; least distance 0.75, ring 1 (");
  expect_rejected(paths, {"distance=0.625"}, "distance");
  EXPECT_EQ(check(paths, {"distance=1"}).exit_code, 1);
  const Words touching = triangles({1, -1});
  ASSERT_EQ(prove(touching, {"--min-distance", "0.25"}), 1);
  EXPECT_EQ(check(touching, {}).exit_code, 1);
}

TEST_F(Claims, TheRing) {
  const Words paths = triangles({1, 0.5});
  ASSERT_EQ(prove(paths, {"--min-distance", "0.25", "--min-distance-from-ring", "3"}), 0);
  EXPECT_EQ(check(paths, {}).exit_code, 0);
  expect_rejected(paths, {"distance=0.25"}, "ring");
  expect_rejected(paths, {"distance=0.25", "ring=2"}, "ring");
  for (const char* const ring : {"ring=3", "ring=4"}) EXPECT_EQ(check(paths, {"distance=0.25", ring}).exit_code, 0);
  ASSERT_EQ(prove(paths, {"--min-distance", "0.75", "--min-distance-from-ring", "2"}), 1);
  for (const char* const ring : {"ring=1", "ring=2"}) EXPECT_EQ(check(paths, {"distance=0.75", ring}).exit_code, 1);
  expect_rejected(paths, {"distance=0.75", "ring=3"}, "ring");
}

TEST_F(Claims, PairsThatAreNotCompared) {
  const Words paths = triangles({1, -1});
  const std::string groups =
      folder.write("groups.json", R"({"groups": {"a": [[0, 2]], "b": [[3, 5]]}, "ignore": [["a", "b"]]})");
  ASSERT_EQ(prove(paths, {"--ignore", groups}), 0);
  const Json claim = asked_claim();
  const std::string cells = "cells=" + claim["cells"].get<std::string>();
  EXPECT_EQ(claim["excluded"], Json::parse("[[1, 2]]"));
  EXPECT_TRUE(claim["empty"].get<bool>());
  expect_rejected(paths, {}, "excluded");
  expect_rejected(paths, {"empty"}, "excluded");
  expect_rejected(paths, {"excluded=1-1", cells, "empty"}, "excluded");
  expect_rejected(paths, {"excluded=1-2", cells}, "empty");
  expect_rejected(paths, {"excluded=1-2", "cells=" + std::string(64, '0'), "empty"}, "cells");
  EXPECT_EQ(check(paths, {"excluded=1-2", "empty"}).exit_code, 3);
  EXPECT_EQ(check(paths, {"excluded=1-2", cells, "empty"}).exit_code, 0);
  EXPECT_EQ(check(paths, {"excluded=1-1,1-2", cells, "empty"}).exit_code, 0);
}

TEST_F(Claims, InSpaceWhereThePlaneWasAsked) {
  const Words paths = triangles({1, 0.5});
  ASSERT_EQ(prove(paths, {}), 0);
  expect_rejected(paths, {"dimension=2"}, "dimension");
}

TEST_F(Claims, AWitnessOfOneClaimAgainstMergedVertices) {
  const Words paths = glued();
  ASSERT_EQ(prove(paths, {}), 1);
  EXPECT_EQ(check(paths, {}).exit_code, 1);
  expect_rejected(paths, {"merged=1", "cells=" + asked_claim()["cells"].get<std::string>()}, "merged");
}

/// `noli check` accepts everything that `noli verify` proves or refutes, under the same claim, and reports that claim.
TEST_F(Claims, AsVerifyWritesThem) {
  const std::vector<Words> all = {{},
                                  {"--static"},
                                  {"--strict"},
                                  {"--points"},
                                  {"--merge-identical"},
                                  {"--dimension", "2"},
                                  {"--min-distance", "0.25"},
                                  {"--min-distance", "0.75", "--min-distance-from-ring", "2"}};
  for (const Words& options : all) {
    const Words paths = triangles({1, 0.5});
    const int code = prove(paths, options);
    Words words = {proof()};
    words.insert(words.end(), paths.begin(), paths.end());
    words.insert(words.end(), {"--claim", folder.path("claim.json")});
    EXPECT_EQ(check(words).exit_code, code) << (options.empty() ? "" : options[0]);
    words.insert(words.begin(), "check");
    const Json said = json_of(words, code), claim = asked_claim();
    for (const auto& [key, value] : claim.items()) {
      if (key == "schema" || key == "version") continue;
      EXPECT_EQ(said["claim"][key], value) << key;
      EXPECT_TRUE(said["asked"].contains(key)) << key;
    }
    EXPECT_EQ(said["checker"]["name"], "noli_check");
    EXPECT_NE(said["checker"]["commit"], "");
  }
}

TEST_F(Claims, VerifySaysWhatItAskedAndWhatWeakensIt) {
  const Words paths = particle();
  Words words = {"verify"};
  words.insert(words.end(), paths.begin(), paths.end());
  const Json empty = json_of(words, 0);
  EXPECT_EQ(empty["verdict"], "proved");
  EXPECT_TRUE(empty["claim"]["empty"].get<bool>());
  EXPECT_EQ(empty["claim"]["weaker"], Json::parse(R"(["the claim is empty"])"));
  EXPECT_EQ(empty["checker"]["name"], "noli_check");
  EXPECT_NE(run_noli(words).out.find("The claim is empty: fewer than two cells"), std::string::npos);
  const Words rest = triangles({1, -1});
  Words at_rest = {"verify", "--static", "--force", "--proof", proof()};
  at_rest.insert(at_rest.end(), rest.begin(), rest.end());
  EXPECT_EQ(json_of(at_rest, 0)["claim"]["weaker"], Json::parse(R"(["frames at rest"])"));
  // The printed command checks the proof again.
  const std::string out = run_noli(at_rest).out, before = "ask for what it claims: noli ";
  const std::size_t at = out.find(before);
  ASSERT_NE(at, std::string::npos) << out;
  std::istringstream told(out.substr(at + before.size(), out.find('\n', at) - at - before.size()));
  EXPECT_EQ(run_noli(Words{std::istream_iterator<std::string>(told), {}}).exit_code, 0);
}

TEST_F(Claims, AFileThatIsNoClaimIsRefused) {
  const Words paths = triangles({1, 0.5});
  ASSERT_EQ(prove(paths, {}), 0);
  const Json good = asked_claim();
  const auto by = [&](const std::string& text) {
    Words words = {"check", proof(), "--claim", folder.write("other.json", text)};
    words.insert(words.end(), paths.begin(), paths.end());
    return run_noli(words);
  };
  EXPECT_EQ(by(good.dump()).exit_code, 0);
  EXPECT_EQ(by(R"({"schema": "noli-claim", "version": 1})").exit_code, 0);
  const auto with = [&](const char* key, const Json& value) {
    Json json = good;
    json[key] = value;
    return json.dump();
  };
  for (const std::string& bad : {std::string("{"),        std::string("[]"),
                                 std::string("{}"),       with("schema", "noli-result"),
                                 with("version", 2),      with("version", "1"),
                                 with("more", 1),         with("from", 0),
                                 with("motion", 1),       with("motion", "still"),
                                 with("dimension", "2"),  with("dimension", 4),
                                 with("steps", 0),        with("steps", -1),
                                 with("strict", 0),       with("distance", "0"),
                                 with("distance", -1),    with("ring", 0),
                                 with("merged", true),    with("cells", 7),
                                 with("cells", "00"),     with("excluded", {{2, 1}}),
                                 with("excluded", "1-2"), with("empty", Json(nullptr))}) {
    const Process process = by(bad);
    EXPECT_EQ(process.exit_code, 3) << bad;
    EXPECT_NE(process.err, "") << bad;
  }
  EXPECT_EQ(by(with("steps", 2)).exit_code, 3);
  EXPECT_EQ(run_noli({"check", proof(), paths[0], paths[1], "--claim", folder.path("nowhere.json")}).exit_code, 3);
  // The command line takes precedence over the file.
  Words words = {"check", proof(), "--claim", folder.write("two.json", with("steps", 2)), "--require", "steps=1"};
  words.insert(words.end(), paths.begin(), paths.end());
  EXPECT_EQ(run_noli(words).exit_code, 0);
}

TEST_F(Claims, WordsThatNobodyCanAskAreAFaultOfTheCommandLine) {
  const Words paths = triangles({1, 0.5});
  ASSERT_EQ(prove(paths, {}), 0);
  for (const char* const word :
       {"motion", "motion=still", "steps=0", "nothing", "distance=-1", "ring=2", "excluded=1-2"}) {
    const Process process = check(paths, {word});
    EXPECT_EQ(process.exit_code, 3) << word;
    EXPECT_EQ(process.out, "") << word;
    EXPECT_NE(process.err.find(std::string("--require ") + std::string(word).substr(0, 4)), std::string::npos)
        << process.err;
  }
}

TEST_F(Claims, OfARun) {
  const std::string run = run_path("run");
  ASSERT_EQ(run_noli({"simulate", scene(hanging_sheet()), "-o", run, "--until", "0.05"}).exit_code, 0);
  ASSERT_EQ(prove({run}, {}), 0);
  EXPECT_EQ(asked_claim()["motion"], "run");
  EXPECT_EQ(asked_claim()["steps"], 5);
  EXPECT_EQ(check(Words{proof(), run, "--claim", folder.path("claim.json")}).exit_code, 0);
  EXPECT_EQ(check(Words{run, "--claim", folder.path("claim.json")}).exit_code, 0);
  for (const char* const asked :
       {"motion=linear", "motion=rest", "steps=6", "strict", "distance=1e-9", "dimension=2"}) {
    EXPECT_EQ(check(Words{run, "--require", asked}).exit_code, 3) << asked;
  }
  const Json said = json_of({"verify", run}, 0);
  EXPECT_EQ(said["claim"]["weaker"], Json::array());
  EXPECT_EQ(said["claim"]["from"], 0);
}

}  // namespace
}  // namespace noli::app_tests
