// SPDX-License-Identifier: Apache-2.0
//
// One motion in every form that frames have: the same verdict, the same JSON, the same proof.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <limits>

#include "tests/app/audits/libraries.h"
#include "tests/app/process.h"
#include "tests/app/scene.h"
#include "tests/app/worked_example.h"
#include "tests/support/numpy.h"
#ifdef NOLI_SERIES
#include "tests/support/vtkhdf.h"
#endif

namespace noli::app_tests {
namespace {

using Json = nlohmann::json;
using test::NumpyArray;

constexpr std::size_t frame_count = 60, vertex_count = 6;

/// A small triangle over a large one, which it comes nearer to, or goes through in the middle.
Position position(std::size_t k, std::size_t v, bool through) {
  static const Position corners[] = {{-2, -2, 0}, {2, -2, 0}, {0, 2, 0}, {-0.5, -0.5, 2}, {0.5, -0.5, 2}, {0, 0.5, 2}};
  Position x = corners[v];
  if (v >= 3) x[2] -= static_cast<double>(k) / (through ? 16 : 64);
  return x;
}

class FrameSources : public testing::TestWithParam<bool> {
 protected:
  NumpyArray array(std::size_t first, std::size_t count, const std::string& type = "<f8", bool fortran = false) const {
    NumpyArray positions{type, {count, vertex_count, 3}, {}, fortran};
    for (std::size_t k = first; k < first + count; ++k) {
      for (std::size_t v = 0; v < vertex_count; ++v) {
        const Position x = position(k, v, GetParam());
        positions.numbers.insert(positions.numbers.end(), x.begin(), x.end());
      }
    }
    return positions;
  }
  NumpyArray frame(std::size_t k) const {
    NumpyArray one = array(k, 1);
    one.shape = {vertex_count, 3};
    return one;
  }

  std::string npz(const std::string& name, const NumpyArray& positions, const NumpyArray& cells) const {
    return folder.write(name,
                        test::stored_zip({{"vertices_seq.npy", positions.bytes()}, {"faces.npy", cells.bytes()}}));
  }

  /// Each way to name the motion: words for the command line, and what standard input is.
  struct Form {
    Words words;
    std::string input = {};
  };
  std::vector<Form> forms() const {
    std::vector<Form> all;
    for (const char* const name : {"f", "ply"}) std::filesystem::create_directories(folder.path(name));
    Words ply, npy = {folder.write("f/faces.npy", faces.bytes())};
    std::string stream = faces.bytes();
    for (std::size_t k = 0; k < frame_count; ++k) {
      std::vector<Position> x;
      for (std::size_t v = 0; v < vertex_count; ++v) x.push_back(position(k, v, GetParam()));
      ply.push_back(folder.write(fmt::format("ply/{}.ply", k), ply_text(x, {{0, 1, 2}, {3, 4, 5}})));
      npy.push_back(folder.write(fmt::format("f/frame_{}.npy", k), frame(k).bytes()));
      stream += frame(k).bytes();
    }
    all.push_back({ply});
    all.push_back({{folder.path("ply")}});
    all.push_back({npy});
    for (const char* const type : {"<f8", ">f8", "<f4", ">f4"}) {
      for (const bool fortran : {false, true}) {
        NumpyArray cells = faces;
        cells.fortran = fortran;
        const std::string name = fmt::format("{}{}{}.npz", type[0] == '<' ? "l" : "b", type[2], fortran ? "f" : "c");
        all.push_back({{npz(name, array(0, frame_count, type, fortran), cells)}});
      }
    }
    all.push_back({{folder.write("motion.npy", array(0, frame_count).bytes()), npy[0]}});
#ifdef NOLI_SERIES
    for (const auto& [name, type] : {std::pair("l8.vtkhdf", H5T_IEEE_F64LE), std::pair("b4.hdf", H5T_IEEE_F32BE)}) {
      test::write_vtkhdf(folder.path(name), array(0, frame_count).numbers, frame_count, {{0, 1, 2}, {3, 4, 5}}, type);
      all.push_back({{folder.path(name)}});
    }
#endif
    all.push_back({{"-"}, folder.write("stream.bin", stream)});
    all.push_back({{folder.path("motion.frames")}});
    return all;
  }

  std::pair<std::string, int> noli(const std::string& command, const Form& form, const std::string& more) const {
    std::string line = std::string(NOLI_COMMAND) + " " + command;
    for (const std::string& word : form.words) line += " '" + word + "'";
    return shell(line + " " + more + (form.input.empty() ? " </dev/null" : " <" + form.input) + " 2>&1");
  }
  static Json without(Json json) {
    for (const char* const member : {"inputs", "notes", "timing"}) json.erase(member);
    for (const char* const member : {"notes", "order"}) json["statement"].erase(member);
    return json;
  }

  NumpyArray faces = {"<i8", {2, 3}, {0, 1, 2, 3, 4, 5}};
  Folder folder;
};
INSTANTIATE_TEST_SUITE_P(All, FrameSources, testing::Bool(),
                         [](const auto& through) { return through.param ? "through" : "apart"; });

TEST_P(FrameSources, GiveOneAnswer) {
  const int expected_code = GetParam() ? 1 : 0;
  Json expected;
  std::string proof;
  for (const Form& form : forms()) {
    const std::string& name = form.words[0];
    const std::string outputs = fmt::format("--keep-going --json {} --proof {} --trajectory {} --force",
                                            folder.path("r.json"), folder.path("p.noli"), folder.path("out.frames"));
    const auto [out, code] = noli("verify", form, outputs);
    ASSERT_EQ(code, expected_code) << name << out;
    const Json json = without(Json::parse(test::read_text(folder.path("r.json"))));
    const std::string found = test::read_text(folder.path("p.noli"));
    if (expected.is_null()) {
      expected = json;
      proof = found;
      folder.write("motion.frames", test::read_text(folder.path("out.frames")));
      folder.write("first.noli", proof);
      EXPECT_EQ(json["verdict"], GetParam() ? "contact" : "proved");
    }
    EXPECT_EQ(json, expected) << name;
    EXPECT_TRUE(found == proof) << name;
    EXPECT_TRUE(test::read_text(folder.path("out.frames")) == test::read_text(folder.path("motion.frames"))) << name;
    // The proof of the PLY files is checked against this form, by both checkers.
    for (const std::string checker : {"", " --verified"}) {
      if (!form.input.empty() && !checker.empty()) continue;
      const auto [words, verdict] = noli("check" + checker + " " + folder.path("first.noli"), form, "");
      EXPECT_EQ(verdict, expected_code) << name << checker << words;
    }
  }
}

TEST_P(FrameSources, ShowTheFirstContact) {
  for (const Form& form : forms()) {
    if (!form.input.empty() || form.words[0].ends_with("motion.frames")) continue;
    const std::string& name = form.words[0];
    ASSERT_EQ(noli("verify", form, "--json " + folder.path("r.json") + " --force").second, GetParam() ? 1 : 0);
    const Process shown = run_noli({"export", folder.path("r.json"), "-o", folder.path("hits.vtu")});
    if (!GetParam()) {
      EXPECT_EQ(shown.exit_code, 3) << name;
      EXPECT_NE(shown.err.find("lists no contact"), std::string::npos) << name << shown.err;
      continue;
    }
    EXPECT_EQ(shown.exit_code, 0) << name << shown.err;
    std::filesystem::remove(folder.path("hits.vtu"));
  }
}

/// What goes wrong with frames that Noli passes on to a checker.
class StreamedFrames : public testing::Test {
 protected:
  static NumpyArray still(std::size_t frames, double z = 1) {
    NumpyArray array{"<f8", {frames, vertex_count, 3}, {}};
    for (std::size_t k = 0; k < frames; ++k) {
      for (std::size_t v = 0; v < vertex_count; ++v) {
        const Position x = position(0, v, false);
        array.numbers.insert(array.numbers.end(), {x[0], x[1], x[2] * z});
      }
    }
    return array;
  }
  std::string npz(const std::string& name, const NumpyArray& positions) const {
    return folder.write(name, test::stored_zip({{"x.npy", positions.bytes()}, {"f.npy", faces.bytes()}}));
  }
  std::string command(const std::string& words) const { return std::string(NOLI_COMMAND) + " " + words; }

  NumpyArray faces = {"<i8", {2, 3}, {0, 1, 2, 3, 4, 5}};
  Folder folder;
};

/// The checker waits for a motion that nobody gives it.
TEST_F(StreamedFrames, ThatCannotBeReadEndTheCheck) {
  const std::string good = npz("good.npz", still(3)), proof = folder.path("p.noli");
  const std::string first = folder.path("first.noli");
  ASSERT_EQ(run_noli({"verify", good, "--proof", proof}).exit_code, 0);
  ASSERT_EQ(run_noli({"verify", npz("two.npz", still(2)), "--proof", first}).exit_code, 0);
  for (const std::size_t bad : {0U, 1U, 2U}) {
    NumpyArray positions = still(3);
    positions.numbers[bad * 3 * vertex_count + 1] = std::numeric_limits<double>::quiet_NaN();
    const Process process = run_noli({"check", proof, npz("bad.npz", positions), "--time-limit", "20s"});
    EXPECT_EQ(process.exit_code, 3) << bad << process.out;
    EXPECT_NE(process.err.find(fmt::format("bad.npz[{}]: vertex 0: expected a finite coordinate", bad)),
              std::string::npos)
        << process.err;
    const Process one = run_noli({"check", first, folder.path("bad.npz"), "--require", "steps=1"});
    EXPECT_EQ(one.exit_code, bad == 2 ? 0 : 3)
        << "frames behind the proof's steps do not matter: " << one.out << one.err;
  }
  EXPECT_EQ(run_noli({"check", proof, npz("more.npz", still(4))}).exit_code, 3);
  EXPECT_EQ(run_noli({"check", folder.write("no.noli", "no proof"), good}).exit_code, 3);
}

/// Without --require steps= it is asked of all frames, and one more cannot be read.
TEST_F(StreamedFrames, BehindAProofThatCannotBeReadEndTheCheckToo) {
  const std::string first = folder.path("first.noli");
  ASSERT_EQ(run_noli({"verify", npz("two.npz", still(2)), "--proof", first}).exit_code, 0);
  NumpyArray positions = still(3);
  positions.numbers.back() = std::numeric_limits<double>::infinity();
  const Process process = run_noli({"check", first, npz("bad.npz", positions)});
  EXPECT_EQ(process.exit_code, 3) << process.out;
  EXPECT_NE(process.err.find("bad.npz[2]"), std::string::npos) << process.err;
}

TEST_F(StreamedFrames, OutputsDoNotReplaceWhatNamesThem) {
  const std::string list = folder.write("l.txt", npz("m.npz", still(2)) + "\n");
  EXPECT_EQ(run_noli({"verify", "@" + list, "--json", list, "--force"}).exit_code, 3);
  EXPECT_EQ(run_noli({"verify", "@" + list, "--trajectory", folder.path("m.npz"), "--force"}).exit_code, 3);
  const std::string part = folder.write("x.part", "mine");
  EXPECT_EQ(run_noli({"verify", "@" + list, "--trajectory", folder.path("x")}).exit_code, 0);
  EXPECT_EQ(test::read_text(part), "mine");
}

/// Nobody knows whether another frame would have come.
TEST_F(StreamedFrames, OfAStreamThatIsStoppedAreUndecided) {
  std::string text = faces.bytes();
  for (int k = 0; k < 3; ++k) {
    NumpyArray one = still(1);
    one.shape = {vertex_count, 3};
    text += one.bytes();
  }
  const std::string file = folder.write("s.bin", text);
  for (const std::string more : {"", " --no-check", " --static"}) {
    const auto [out, code] =
        shell("(cat " + file + "; sleep 3) | " + command("verify - --time-limit 1s" + more) + " 2>&1");
    EXPECT_EQ(code, 2) << more << out;
    EXPECT_NE(out.find("UNDECIDED"), std::string::npos) << out;
    EXPECT_EQ(shell("cat " + file + " | " + command("verify -" + more) + " 2>&1").second, 0) << more;
  }
  const std::string out = folder.path("out.frames");
  shell("(cat " + file + "; sleep 3) | " + command("verify - --time-limit 1s --trajectory " + out) + " 2>&1");
  EXPECT_FALSE(std::filesystem::exists(out)) << "a part of the motion is no motion";
  EXPECT_FALSE(std::filesystem::exists(out + ".part"));
}

TEST_F(StreamedFrames, GoWithTheOptionsThatFilesHave) {
  const std::string file = npz("m.npz", still(3));
  for (const Words& more : {Words{"--static"}, {"--merge-identical"}, {"--min-distance", "0.5"}, {"--strict"}}) {
    const Process process = run_noli(Words{"verify", file} + more);
    EXPECT_EQ(process.exit_code, 0) << more[0] << process.out << process.err;
    EXPECT_NE(process.out.find("PROVED"), std::string::npos) << more[0] << process.out;
  }
  const Process near = run_noli({"verify", file, "--min-distance", "5"});
  EXPECT_EQ(near.exit_code, 1) << near.out;
  EXPECT_EQ(shell(command("verify - --merge-identical </dev/null 2>&1")).second, 3);
}

/// What `noli export` writes of a run: files of ParaView, its series, and PLY.
TEST(ExportedFrames, AreTheSameInEachFormat) {
  const Folder folder;
  const std::string run = folder.path("run");
  const std::string scene = std::string(NOLI_SOURCE_DIR) + "/scenes/swinging_cloth.json";
  ASSERT_EQ(run_noli({"simulate", scene, "--short", "--until", "0.1", "-o", run, "-q"}).exit_code, 0);
  for (const char* const pattern : {"v_%02d.vtu", "p_%02d.ply"}) {
    ASSERT_EQ(run_noli({"export", run, "--fps", "50", "-o", folder.path(pattern)}).exit_code, 0);
  }
  std::string expected;
  for (const char* const name : {"p_%02d.ply", "v_%02d.vtu", "v.pvd"}) {
    const std::string proof = folder.path("p.noli");
    const Process process = run_noli({"verify", folder.path(name), "--proof", proof, "--force"});
    EXPECT_EQ(process.exit_code, 0) << process.out << process.err;
    if (expected.empty()) expected = test::read_text(proof);
    EXPECT_TRUE(test::read_text(proof) == expected) << name;
  }
}

}  // namespace
}  // namespace noli::app_tests
