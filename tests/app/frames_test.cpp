// SPDX-License-Identifier: Apache-2.0
//
// Tests which frames are read and in which order, and the messages of `noli verify` and others about names, files and
// polygons.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <fstream>
#include <thread>

#include "tests/app/audits/libraries.h"
#include "tests/app/process.h"
#include "tests/app/scene.h"
#include "trajectory/blocks/sha256.h"

namespace noli::app_tests {
namespace {

using Json = nlohmann::json;
using Words = std::vector<std::string>;

class Frames : public testing::Test {
 protected:
  static Words with(Words words, const Words& more) {
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }
  static bool has_note(const Json& json, const std::string& text) {
    return std::ranges::any_of(
        json["notes"], [&](const Json& note) { return note.get<std::string>().find(text) != std::string::npos; });
  }
  static void refused(const Words& words, const std::string& complaint) {
    const Process process = run_noli(words);
    EXPECT_EQ(process.exit_code, 3) << process.out;
    EXPECT_NE(process.err.find(complaint), std::string::npos) << process.err;
    EXPECT_EQ(process.out, "");
  }

  /// A small triangle above a large one, or beside it.
  std::string frame(const std::string& name, double x, double z) const {
    return folder.write(
        name, ply_text({{-2, -2, 0}, {2, -2, 0}, {0, 2, 0}, {x - 0.5, -0.5, z}, {x + 0.5, -0.5, z}, {x, 0.5, z}},
                       {{0, 1, 2}, {3, 4, 5}}));
  }
  /// cloth_0 to cloth_11. The triangle comes from the side and passes down through the other one in step 10. In the
  /// shell's order of the files, it goes around the other one.
  Words cloth_in_time() const {
    Words frames;
    for (int k = 0; k < 12; ++k) {
      frames.push_back(frame(fmt::format("cloth_{}.ply", k), k < 3 ? 10 : 0.0625 * k, k < 10 ? 1 : -1));
    }
    return frames;
  }
  Words cloth_in_shell() const {
    Words frames = cloth_in_time();
    std::ranges::sort(frames);
    return frames;
  }

  Folder folder;
};

/// Each way to name the twelve frames gives the same answer about the same files.
TEST_F(Frames, AreNamedByFolderPatternAndList) {
  const Words frames = cloth_in_time();
  std::string list;
  for (const std::string& file : frames) list += file + '\n';
  const Json expected = json_of(with({"verify"}, frames), 1);
  EXPECT_EQ(expected["first"]["step"], 10);
  for (const std::string& name : {folder.path("cloth_*.ply"), folder.path("cloth_%d.ply"),
                                  "@" + folder.write("list.txt", list), folder.path(".")}) {
    const Json json = json_of({"verify", name}, 1);
    EXPECT_EQ(json["first"], expected["first"]) << name;
    ASSERT_EQ(json["inputs"].size(), 12U) << name;
    for (std::size_t k = 0; k < 12; ++k)
      EXPECT_EQ(json["inputs"][k]["sha256"], expected["inputs"][k]["sha256"]) << name;
  }
  const std::string proof = folder.path("cloth.noli");
  EXPECT_EQ(run_noli({"verify", folder.path("cloth_[0-8].ply"), "--proof", proof, "-q"}).exit_code, 0);
  EXPECT_EQ(run_noli({"check", proof, folder.path("cloth_[0-8].ply")}).exit_code, 0);
  EXPECT_EQ(run_noli({"check", proof, folder.path("cloth_[0-9].ply")}).exit_code, 3) << "one frame more";
  refused({"verify", folder.path("shirt_*.ply")}, "matches no file");
}

TEST_F(Frames, TwelveFramesInTheOrderOfTheShell) {
  const Words verify = with({"verify"}, cloth_in_shell());
  refused(verify,
          fmt::format("{} comes before {}; pass --order natural, or --order given if this is the order you mean",
                      folder.path("cloth_10.ply"), folder.path("cloth_2.ply")));
  const Json natural = json_of(with(verify, {"--order", "natural"}), 1);
  EXPECT_EQ(natural["verdict"], "contact");
  EXPECT_EQ(natural["first"]["step"], 10);
  EXPECT_EQ(natural["statement"]["order"], "sorted by the numbers in the names (--order natural)");
  EXPECT_EQ(natural["inputs"][2]["file"], folder.path("cloth_2.ply"));
  EXPECT_TRUE(has_note(natural, "10 of 12 changed places"));
  EXPECT_TRUE(has_note(natural, "straight lines are assumed there; finer frames show more"));
  const Json given = json_of(with(verify, {"--order", "given"}), 0);
  EXPECT_EQ(given["verdict"], "proved");
  EXPECT_EQ(given["inputs"][2]["file"], folder.path("cloth_10.ply"));
  EXPECT_TRUE(has_note(given, "against their numbers: ")) << given["notes"];
  EXPECT_EQ(given["statement"]["notes"], given["notes"]);
  const Json time = json_of(with({"verify"}, cloth_in_time()), 1);
  EXPECT_EQ(time["first"]["step"], 10);
  EXPECT_EQ(time["inputs"], natural["inputs"]);
  EXPECT_FALSE(has_note(time, "changed places"));
}

TEST_F(Frames, CheckAndAuditAskForTheOrderToo) {
  const Words shell = cloth_in_shell(), time = cloth_in_time();
  const std::string proof = folder.path("proof.noli");
  ASSERT_EQ(run_noli(with({"verify", "--proof", proof, "--order", "given"}, shell)).exit_code, 0);
  refused(with({"check", proof}, shell), "cloth_2.ply; pass --order natural");
  EXPECT_EQ(run_noli(with({"check", proof, "--order", "given"}, shell)).exit_code, 0);
  EXPECT_EQ(run_noli(with({"check", proof, "--order", "natural"}, shell)).exit_code, 3) << "a proof of another motion";
  EXPECT_TRUE(has_note(json_of(with({"check", proof, "--order", "given"}, shell), 0), "against their numbers"));
  ASSERT_EQ(run_noli(with({"verify", "--force", "--proof", proof, "--order", "natural"}, shell)).exit_code, 1);
  EXPECT_EQ(run_noli(with({"check", proof, "--order", "natural"}, shell)).exit_code, 1);
  EXPECT_EQ(run_noli(with({"check", proof}, time)).exit_code, 1);

  const Words audit = {"audit", "ccd", "--library", plugin("noli"), "--frames"};
  refused(with(audit, {time[10], time[9]}), "cloth_9.ply; pass --order natural");
  const Json natural = json_of(with(audit, {time[10], time[9], "--order", "natural"}), 0);
  EXPECT_EQ(natural["inputs"][0]["file"], time[9]);
  EXPECT_TRUE(has_note(natural, "2 of 2 changed places"));
  EXPECT_TRUE(has_note(json_of(with(audit, {time[10], time[9], "--order", "given"}), 0), "against their numbers"));
  refused({"audit", "ccd", "--library", plugin("noli"), "--order", "given", "q.csv"}, "apply to --frames only");
}

TEST_F(Frames, OrderIsOneOfTwoWords) {
  refused({"verify", "--order", "time", "a.ply", "b.ply"}, "time");
  refused({"verify", "--polygons", "cut", "a.ply", "b.ply"}, "cut");
}

TEST_F(Frames, AllHeadersComeBeforeTheFirstStep) {
  Words frames = cloth_in_time();
  frame("cloth_1.ply", -10, -1);  // contact in step 1
  ASSERT_EQ(json_of(with({"verify"}, frames), 1)["first"]["step"], 1);
  const std::string good = test::read_text(frames[10]);
  folder.write("cloth_10.ply",
               ply_text({{-2, -2, 0}, {2, -2, 0}, {0, 2, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}}, {{0, 1, 2}}));
  refused(with({"verify"}, frames),
          fmt::format(
              "{}: has 1 faces, but {} has 2; all frames must have the same mesh; --body is for several bodies (frame "
              "11 of 12)",
              frames[10], frames[0]));
  folder.write("cloth_10.ply", "ply\nformat ascii 3.0\n");
  refused(with({"verify"}, frames), frames[10] + ": line 2: expected version 1.0, found '3.0' (frame 11 of 12)");
  folder.write("cloth_10.ply", good);
  for (const auto& [extension, advice] : {std::pair{".h5", "numpy.savez("},
                                          {".abc", "Blender"},
                                          {".usd", "Blender"},
                                          {".stl", "no shared vertices"},
                                          {".gz", "gunzip -k cloth_10.gz"}}) {
    Words other = frames;
    other[10] = folder.write(std::string("cloth_10") + extension, "x");
    refused(with({"verify"}, other), advice);
  }
  refused({"verify", folder.write("motion.npz", "x")}, "cannot be read as an archive of numpy");
  EXPECT_EQ(run_noli(with({"verify"}, frames)).exit_code, 1);
}

TEST_F(Frames, ResultsSayWhatWasLookedAt) {
  const std::string a = folder.write("0.obj", "v 0 0 0\nv 1 0 0\nv 0 1.25 0\nv 9 9 9\nf 1 2 3\n");
  const std::string b = folder.write("1.obj", "v 0 0 1\nv 1 0 1\nv 0 1.25 1\nv 9 9 9\nf 1 2 3\n");
  const Json json = json_of({"verify", "--strict", a, b}, 0);
  ASSERT_EQ(json["inputs"].size(), 2u);
  EXPECT_EQ(json["inputs"][1], (Json{{"file", b},
                                     {"bytes", test::read_text(b).size()},
                                     {"sha256", hex(sha256(test::read_text(b)))},
                                     {"numbers", "text with 3 digits, 2 decimals"},
                                     {"vertices", 4},
                                     {"cells", 1}}));
  EXPECT_TRUE(
      has_note(json,
               "coordinates are text with 2 decimals: the verdict is exact for these numbers; their rounding may "
               "decide gaps below 5e-03"));
  EXPECT_EQ(json["statement"]["order"], "as given, which is the order of the numbers in the names");
  const std::string text = run_noli({"verify", "--strict", a, b}).out;
  EXPECT_NE(text.find("Note: coordinates are text with 2 decimals"), std::string::npos) << text;
}

TEST_F(Frames, OfFramesBehindAContactHashesAreKnownToo) {
  const Words frames = {frame("0.ply", 0, 1), frame("1.ply", 0, -1), frame("2.ply", 0, -2)};
  const Json json = json_of(with({"verify"}, frames), 1);
  EXPECT_EQ(json["steps"], 1);
  EXPECT_EQ(json["inputs"][2]["sha256"], hex(sha256(test::read_text(frames[2]))));
  EXPECT_EQ(json["inputs"][2]["cells"], 2);
}

TEST_F(Frames, APipeIsLookedAtWhenItIsRead) {
  const std::string pipe = folder.path("0.ply"), content = test::read_text(frame("x.ply", 0, 2));
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  std::thread writer([&] { std::ofstream(pipe) << content; });
  const Json json = json_of({"verify", "--no-check", pipe, frame("1.ply", 0, 1)}, 0);
  writer.join();
  EXPECT_EQ(json["inputs"][0]["sha256"], hex(sha256(content)));
  EXPECT_EQ(json["inputs"][0]["vertices"], 6);
}

TEST_F(Frames, NotesOnFramesThatAreMissingDoubleOrEqual) {
  const Words four = {frame("a_1.ply", 0, 5), frame("a_2.ply", 0, 5), frame("a_3.ply", 0, 4), frame("a_5.ply", 0, 3)};
  const Json json = json_of(with({"verify"}, four), 0);
  EXPECT_TRUE(has_note(json, fmt::format("{} to {}: frame 4 is missing", four[2], four[3]))) << json["notes"];
  EXPECT_TRUE(has_note(json, fmt::format("{} and {} are equal: nothing moves in step 1", four[0], four[1])));
  EXPECT_FALSE(has_note(json, "step 2"));
  const Json twice = json_of({"verify", four[0], four[2], four[2]}, 0);
  EXPECT_TRUE(has_note(twice, four[2] + " is given twice: as frames 2, 3")) << twice["notes"];
  const std::string text = run_noli(with({"verify"}, four)).out;
  EXPECT_NE(text.find("frame 4 is missing.\n"), std::string::npos) << text;
  EXPECT_FALSE(has_note(json_of(with({"verify", "--static"}, four), 0), "nothing moves"));
}

/// A bent quad, and a point that comes down between its two triangulations.
class Polygons : public Frames {
 protected:
  std::string quad(const std::string& name, double z, const std::string& face) const {
    return folder.write(name, fmt::format("v 0 0 0\nv 4 0 2\nv 4 4 0\nv 0 4 2\nv 2 2 {}\n{}\np 5\n", z, face));
  }
};

TEST_F(Polygons, AnotherFirstCornerIsAnotherQuestion) {
  const std::string rule = "p0 p1 ... pn is cut into the triangles (p0, p1, p2), (p0, p2, p3), ..., (p0, pn-1, pn)";
  const auto ask = [&](const std::string& face, int exit_code) {
    return json_of({"verify", quad("0.obj", 3, face), quad("1.obj", 1, face)}, exit_code);
  };
  // One diagonal is at z = 0, the other at z = 2, and the point comes down to 1.
  const Json apart = ask("f 1 2 3 4", 0), touching = ask("f 2 3 4 1", 1);
  for (const Json& json : {apart, touching}) {
    EXPECT_EQ(json["statement"]["polygons"], rule);
    EXPECT_TRUE(has_note(json,
                         "1 polygon of more than three corners is cut into fans of triangles; largest "
                         "non-planarity in all frames: 3.2659"))
        << json["notes"];
  }
}

TEST_F(Polygons, AreRefusedWhenAsked) {
  const std::string a = quad("0.obj", 3, "f 1 2 3 4"), b = quad("1.obj", 1, "f 1 2 3 4");
  refused({"verify", "--polygons", "refuse", a, b}, a + ": line 6: a face of 4 corners; expected triangles");
  EXPECT_EQ(run_noli({"verify", "--polygons", "fan", a, b}).exit_code, 0);
  const std::string c = quad("2.obj", 3, "f 1 2 3"), d = quad("3.obj", 1, "f 1 2 3");
  const Json json = json_of({"verify", "--polygons", "refuse", c, d}, 0);
  EXPECT_EQ(json["statement"]["polygons"], "a face of more than three corners is an error (--polygons refuse)");
  EXPECT_FALSE(has_note(json, "polygon"));
  const Words audit = {"audit", "ccd", "--library", plugin("noli"), "--frames", a, b};
  refused(with(audit, {"--polygons", "refuse"}), "line 6: a face of 4 corners");
  EXPECT_TRUE(has_note(json_of(audit, 0), "1 polygon of more than three corners"));
}

}  // namespace
}  // namespace noli::app_tests
