// SPDX-License-Identifier: Apache-2.0
//
// Frames in arrays of numpy, in files and on standard input; and those that numpy and meshio wrote.
#include "trajectory/formats/arrays/array_frames.h"

#include <limits>
#include <memory>

#include "support.h"
#include "tests/support/numpy.h"
#include "tests/support/text_bytes.h"
#include "trajectory/blocks/sha256.h"
#include "trajectory/formats/arrays/stream_frames.h"
#include "trajectory/formats/open_frames.h"

namespace noli {
namespace {

using test::NumpyArray;
using test::stored_zip;
using testing::bits;
using testing::input_error;

namespace fs = std::filesystem;
using Paths = std::vector<fs::path>;

constexpr std::size_t frame_count = 3, vertex_count = 6;

/// Coordinate c of vertex v in frame k. A multiple of 1/64, so float32 has it.
double x(std::size_t k, std::size_t v, std::size_t c) {
  return static_cast<double>(v * 7 + c * 3) / 4 - static_cast<double>(k) / 64;
}

NumpyArray frame(std::size_t k, std::size_t coordinates = 3) {
  NumpyArray array{"<f8", {vertex_count, coordinates}, {}};
  for (std::size_t v = 0; v < vertex_count; ++v) {
    for (std::size_t c = 0; c < coordinates; ++c) array.numbers.push_back(x(k, v, c));
  }
  return array;
}

NumpyArray motion(std::size_t coordinates = 3) {
  NumpyArray array{"<f8", {frame_count, vertex_count, coordinates}, {}};
  for (std::size_t k = 0; k < frame_count; ++k) {
    const auto numbers = frame(k, coordinates).numbers;
    array.numbers.insert(array.numbers.end(), numbers.begin(), numbers.end());
  }
  return array;
}

const NumpyArray faces = {"<i8", {2, 3}, {0, 1, 2, 3, 4, 5}};

class Arrays : public ::testing::Test {
 protected:
  fs::path npz(const std::vector<std::pair<std::string, NumpyArray>>& arrays, const std::string& name = "m.npz") const {
    std::vector<std::pair<std::string, std::string>> members;
    for (const auto& [key, array] : arrays) members.emplace_back(key + ".npy", array.bytes());
    return folder.write(name, stored_zip(members));
  }
  fs::path npy(const std::string& name, const NumpyArray& array) const { return folder.write(name, array.bytes()); }

  static void expect_motion(FrameSource& source, std::size_t coordinates = 3) {
    for (std::size_t k = 0; k < frame_count; ++k) expect_frame(source, k, coordinates);
    EXPECT_FALSE(source.read(frame_count));
  }
  static void expect_frame(FrameSource& source, std::size_t k, std::size_t coordinates = 3) {
    const auto found = source.read(k);
    ASSERT_TRUE(found);
    ASSERT_EQ(found->positions.size(), vertex_count);
    for (std::size_t v = 0; v < vertex_count; ++v) {
      for (std::size_t c = 0; c < 3; ++c) EXPECT_EQ(found->positions[v][c], c < coordinates ? x(k, v, c) : 0);
    }
  }
  static std::string refusal_or_none(const Paths& files, const std::vector<std::string>& keys) {
    try {
      const auto source = open_frames(files, {.keys = keys});
      for (std::size_t k = 0; source->read(k); ++k) {
      }
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }
  /// What is said of these files when all of it is read.
  static std::string refusal(const Paths& files, const std::vector<std::string>& keys = {}) {
    return input_error([&] {
      const auto source = open_frames(files, {.keys = keys});
      for (std::size_t k = 0; source->read(k); ++k) {
      }
    });
  }

  test::TemporaryFolder folder;
};

TEST_F(Arrays, HaveEachTypeByteOrderAndOrderOfIndices) {
  for (const char* type : {"<f8", ">f8", "<f4", ">f4"}) {
    for (const bool fortran : {false, true}) {
      NumpyArray array = motion();
      array.type = type;
      array.fortran = fortran;
      NumpyArray cells = faces;
      cells.fortran = fortran;
      const auto source = open_frames({npz({{"vertices_seq", array}, {"faces", cells}})});
      EXPECT_EQ(source->count(), frame_count);
      EXPECT_EQ(source->read(0)->mesh.faces, (std::vector<std::array<VertexId, 3>>{{0, 1, 2}, {3, 4, 5}}));
      expect_motion(*source);
      EXPECT_EQ(source->facts()[0].numbers, type[2] == '8' ? "float64" : "float32");
      expect_frame(*source, 1);
      expect_frame(*source, 2);
      expect_frame(*source, 0);
    }
  }
}

TEST_F(Arrays, OfTwoCoordinatesAreFlat) {
  const auto source = open_frames({npz({{"x", motion(2)}, {"edges", {"|u1", {2, 2}, {0, 1, 2, 3}}}})});
  expect_motion(*source, 2);
  EXPECT_EQ(source->read(0)->mesh.edges, (std::vector<std::array<VertexId, 2>>{{0, 1}, {2, 3}}));
}

TEST_F(Arrays, InFilesOfTheirOwn) {
  const auto cells = npy("faces.npy", faces), all = npy("motion.npy", motion());
  for (const Paths& files : {Paths{cells, all}, Paths{all, cells}}) {
    const auto source = open_frames(files);
    expect_motion(*source);
    EXPECT_EQ(source->name(1), all.string() + "[1]");
    EXPECT_EQ(source->read(0)->mesh.faces.size(), 2U);
  }
  Paths frames = {cells};
  for (std::size_t k = 0; k < frame_count; ++k) frames.push_back(npy("frame_" + std::to_string(k) + ".npy", frame(k)));
  const auto source = open_frames(frames);
  expect_motion(*source);
  expect_frame(*source, 0);
  EXPECT_EQ(source->name(1), frames[2].string());
  EXPECT_EQ(source->facts()[0].frames, 0U) << "the faces";
  EXPECT_EQ(source->facts()[2].frames, 1U);
  expect_motion(*open_frames({all}));  // vertices alone
}

TEST_F(Arrays, AreLookedAt) {
  const auto file = npz({{"x", motion()}, {"f", faces}});
  const auto source = open_frames({file});
  source->look_at(0);
  EXPECT_EQ(source->facts()[0].sha256, sha256(test::read_text(file)));
  EXPECT_EQ(source->facts()[0].bytes, fs::file_size(file));
  EXPECT_EQ(source->facts()[0].frames, frame_count);
  EXPECT_EQ(source->facts()[0].vertices, vertex_count);
  EXPECT_EQ(source->facts()[0].cells, 2U);
  source->read(0);
  folder.write("m.npz", test::read_text(file) + " ");
  EXPECT_NE(input_error([&] { source->read(1); }).find("has changed since it was opened"), std::string::npos);
}

TEST_F(Arrays, AreChosenByNameWhereSeveralFit) {
  const auto file =
      npz({{"x", motion()}, {"v", motion()}, {"f", faces}, {"e", {"<i4", {1, 2}, {0, 3}}}, {"p", {"<i4", {1}, {2}}}});
  EXPECT_EQ(refusal({file}),
            file.string() +
                ": several arrays may be the positions; name them: --keys POSITIONS,FACES; there are x "
                "float64 (3, 6, 3), v float64 (3, 6, 3), f int64 (2, 3), e int32 (1, 2), p int32 (1,)");
  const auto source = open_frames({file}, {.keys = {"x", "e", "p"}});
  EXPECT_EQ(source->read(0)->mesh.edges.size(), 1U);
  EXPECT_EQ(source->read(0)->mesh.points.size(), 1U);
  EXPECT_TRUE(source->read(0)->mesh.faces.empty());
  EXPECT_EQ(refusal({file}, {"y"}).find(file.string() + ": --keys: there is no array 'y'; there are x"), 0U);
  EXPECT_EQ(refusal({file}, {"f"}),
            file.string() + ": f: is int64 (2, 3); expected positions, real numbers of shape (frames, vertices, 3)");
  EXPECT_EQ(refusal({file}, {"x", "v"}),
            file.string() +
                ": v: is float64 (3, 6, 3); expected cells, integers of shape (faces, 3), (edges, 2) or (points,)");
  EXPECT_NE(refusal({npz({{"x", motion()}, {"f", faces}, {"g", faces}})}).find("several arrays may be the faces"),
            std::string::npos);
  EXPECT_NE(refusal({npz({{"f", faces}})}).find("no array has positions"), std::string::npos);
  EXPECT_NE(refusal({folder.write("e.npz", stored_zip({{"a.txt", ""}}))}).find("there are no arrays"),
            std::string::npos);
}

TEST_F(Arrays, ThatCannotBeReadMatterOnlyIfTheyAreWanted) {
  const std::string objects = test::npy("{'descr': '|O', 'fortran_order': False, 'shape': (1,)}", "x");
  const auto file =
      folder.write("o.npz", stored_zip({{"x.npy", motion().bytes()}, {"f.npy", faces.bytes()}, {"o.npy", objects}}));
  const auto more =
      folder.write("p.npz", stored_zip({{"x.npy", motion().bytes()}, {"f.npy", faces.bytes()}, {"faces.npx", "x"}}));
  EXPECT_NE(refusal({more}).find("has the member 'faces.npx', which is not an .npy"), std::string::npos);
  EXPECT_EQ(refusal_or_none({more}, {"x", "f"}), "");
  expect_motion(*open_frames({file}));
  EXPECT_NE(refusal({file}, {"o"}).find("'|O'"), std::string::npos);
}

TEST_F(Arrays, AreRefusedWithTheirPlace) {
  const auto with = [&](const NumpyArray& positions, const NumpyArray& cells) {
    return refusal({npz({{"x", positions}, {"f", cells}})});
  };
  const std::string file = (folder / "m.npz").string();
  NumpyArray bad = motion();
  bad.numbers[(1 * vertex_count + 2) * 3 + 1] = std::numeric_limits<double>::infinity();
  EXPECT_EQ(with(bad, faces), file + "[1]: vertex 2: expected a finite coordinate, found inf");
  EXPECT_EQ(with(motion(), {"<i8", {1, 3}, {0, 1, 6}}), file + ": f: cell 0 has vertex 6; expected 0 to 5");
  EXPECT_EQ(with(motion(), {"<i8", {1, 3}, {0, -1, 2}}), file + ": f: cell 0 has vertex -1; expected 0 to 5");
  bad = motion();
  bad.numbers.pop_back();
  EXPECT_NE(with(bad, faces).find("m.npz: x: is float64 (3, 6, 3), which takes"), std::string::npos)
      << with(bad, faces);
  EXPECT_NE(refusal({npy("x.npy", bad)}).find("which takes 432 bytes more"), 0U);
  EXPECT_NE(with({"<f8", {0, 6, 3}, {}}, faces).find("expected at least one frame"), std::string::npos);
  EXPECT_NE(refusal({npy("a.npy", frame(0)), npy("b.npy", {"<f8", {1, 3}, {0, 0, 0}})})
                .find("all frames must have the same vertices"),
            std::string::npos);
  EXPECT_NE(refusal({npy("a.npy", frame(0)), folder.write("b.ply", "ply")}).find("is not an .npy file"),
            std::string::npos);
  EXPECT_NE(refusal({folder.write("t.npz", "no archive")}).find("cannot be read as an archive"), std::string::npos);
  EXPECT_NE(refusal({folder / "missing.npz"}).find("No such file"), std::string::npos);
}

/// What is not read may be the motion that is meant.
TEST_F(Arrays, OfOtherTypesAreNotOverlooked) {
  NumpyArray half = motion();
  std::string text = half.bytes();
  text.replace(text.find("<f8"), 3, "<f2");
  const auto file =
      folder.write("h.npz", stored_zip({{"x.npy", text}, {"v.npy", motion().bytes()}, {"f.npy", faces.bytes()}}));
  EXPECT_NE(refusal({file}).find("several arrays may be the positions"), std::string::npos);
  const auto alone = folder.write("a.npz", stored_zip({{"x.npy", text}, {"f.npy", faces.bytes()}}));
  EXPECT_EQ(refusal({alone}), alone.string() + ": x: is an array of type '<f2'; expected float32, float64 or integers");
  const auto both = npz({{"x", motion()}, {"f", faces}, {"e", {"<i4", {1, 2}, {0, 3}}}});
  EXPECT_NE(refusal({both}).find("e may be cells too; name the arrays that count"), std::string::npos);
  const auto source = open_frames({both}, {.keys = {"x", "f"}});
  EXPECT_EQ(source->facts()[0].arrays, (std::vector<std::string>{"x", "f"}));
  EXPECT_EQ(source->notes(), std::vector<std::string>{"positions are the array x, cells f"});
  EXPECT_NE(
      refusal({npz({{"x", motion()}, {"f", faces}, {"q", {"<i4", {1, 4}, {0, 1, 2, 3}}}})}).find("q may be cells"),
      std::string::npos);
  EXPECT_NE(
      refusal({npz({{"x", motion()}, {"f", faces}, {"i", {"<i4", {1, 1, 3}, {0, 1, 2}}}})}).find("i may be positions"),
      std::string::npos);
  EXPECT_EQ(
      open_frames({npz({{"x", motion()}, {"f", faces}, {"n", frame(0)}, {"t", {"<f8", {3}, {0, 1, 2}}}})})->count(),
      frame_count)
      << "real numbers for each vertex, and times";
}

TEST_F(Arrays, BehindADamagedEntryOfTheDirectoryAreMissed) {
  const auto file = npz({{"x", motion()}, {"f", faces}});
  std::string text = test::read_text(file);
  text[text.rfind("PK\1\2")] = 'Q';
  EXPECT_NE(refusal({folder.write("d.npz", text)}).find("damaged directory"), std::string::npos);
}

TEST_F(Arrays, WithAFlippedBitAreRefused) {
  for (const bool fortran : {false, true}) {
    NumpyArray positions = motion();
    positions.fortran = fortran;
    const std::string whole = test::read_text(npz({{"x", positions}, {"f", faces}}));
    for (std::size_t begin = 0; (begin = whole.find("\x93NUMPY", begin)) != std::string::npos; ++begin) {
      const std::size_t end = whole.find("PK", begin);
      for (std::size_t at = begin; at < end; ++at) {
        std::string other = whole;
        other[at] = static_cast<char>(other[at] ^ 1);
        EXPECT_NE(refusal({folder.write("other.npz", other)}), "") << at;
      }
    }
  }
}

// --- standard input --------------------------------------------------------------------------------------------------

StreamFrames stream(const std::string& text) { return StreamFrames(std::make_unique<test::TextBytes>(text)); }

std::string all_frames() {
  std::string text;
  for (std::size_t k = 0; k < frame_count; ++k) text += frame(k).bytes();
  return text;
}

TEST_F(Arrays, OnAStreamComeOneAfterAnother) {
  const std::string text = faces.bytes() + NumpyArray{"<i4", {1, 2}, {0, 3}}.bytes() + all_frames();
  StreamFrames source = stream(text);
  EXPECT_FALSE(source.count());
  EXPECT_FALSE(source.can_begin_again());
  expect_motion(source);
  EXPECT_EQ(source.facts()[0].frames, frame_count);
  EXPECT_EQ(source.facts()[0].bytes, text.size());
  EXPECT_EQ(source.facts()[0].sha256, sha256(text));
  EXPECT_EQ(source.facts()[0].cells, 3U);
}

TEST_F(Arrays, OnAStreamAreRefusedWithTheirNumber) {
  const auto wrong = [](const std::string& text) {
    return input_error([&] {
      StreamFrames source = stream(text);
      for (std::size_t k = 0; source.read(k); ++k) {
      }
    });
  };
  EXPECT_EQ(wrong(""), "standard input: ends before its first frame; expected cells, then positions");
  EXPECT_EQ(wrong(faces.bytes()), "standard input: ends before its first frame; expected cells, then positions");
  EXPECT_EQ(wrong(all_frames() + faces.bytes()),
            "standard input, array 4: is int64 (2, 3); expected the positions of a frame, real numbers of shape "
            "(vertices, 3)");
  EXPECT_EQ(wrong(all_frames() + NumpyArray{"<f8", {1, 3}, {0, 0, 0}}.bytes()),
            "standard input, array 4: is float64 (1, 3), but frame 0 has 6 vertices; all frames must have the same");
  EXPECT_EQ(wrong(all_frames() + "\n"),
            "standard input, array 4: is not an array of numpy: it does not begin with \\x93NUMPY");
  EXPECT_EQ(wrong(faces.bytes() + NumpyArray{"<f8", {1, 3}, {0, 0, 0}}.bytes()),
            "standard input, array 1: cell 0 has vertex 1; expected 0 to 0");
  const std::string whole = all_frames();
  EXPECT_EQ(wrong(whole.substr(0, whole.size() - 1)),
            "standard input, array 3: ends before its last number; the file was cut off");
}

// --- files of others -------------------------------------------------------------------------------------------------

/// tests/data/frames/make.py made them.
TEST(FramesOfOthers, AllHaveTheSameMotion) {
  const fs::path data = fs::path(NOLI_SOURCE_DIR) / "tests" / "data" / "frames";
  const auto expected = [](std::size_t k) {
    const double z = k == 0 ? 1 : k == 1 ? 0.5 : 0.25;
    return std::vector<Position>{{0, 0, 0},       {2, 0, 0},       {0, 2, 0},
                                 {0.25, 0.25, z}, {0.75, 0.25, z}, {0.25, 0.75, z + 1.0 / 64}};
  };
  std::vector<std::unique_ptr<FrameSource>> sources;
  for (const char* name : {"numpy.npz", "deflated.npz", "fortran.npz", "zip64.npz"})
    sources.push_back(open_frames({data / name}));
  sources.push_back(open_frames({data / "positions.npy", data / "faces.npy"}));
  sources.push_back(open_frames({data / "meshio_0.ply", data / "meshio_1.ply", data / "meshio_2.ply"}));
  sources.push_back(std::make_unique<StreamFrames>(std::make_unique<FileBytes>(data / "stream.bin")));
  for (const std::string name :
       {"text_%.vtu", "base64_%.vtp", "zlib_%.vtu", "appended_%.vtu", "raw_%.vtp", "single_%.vtu", "meshio_%.vtu"}) {
    const std::size_t percent = name.find('%');
    Paths frames;
    for (const char* const k : {"0", "1", "2"}) {
      frames.push_back(data / (name.substr(0, percent) + k + name.substr(percent + 1)));
    }
    sources.push_back(open_frames(frames));
  }
  for (const auto& source : sources) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto found = source->read(k);
      ASSERT_TRUE(found) << source->name(k);
      EXPECT_EQ(bits(found->positions), bits(expected(k))) << source->name(k);
      EXPECT_EQ(found->mesh.faces, (std::vector<std::array<VertexId, 3>>{{0, 1, 2}, {3, 4, 5}}));
    }
    EXPECT_FALSE(source->read(3));
  }
}

}  // namespace
}  // namespace noli
