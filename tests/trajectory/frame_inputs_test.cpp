// SPDX-License-Identifier: Apache-2.0
#include "trajectory/formats/frame_inputs.h"
#include "trajectory/stop.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>
#include <sys/stat.h>

#include "support.h"
#include "trajectory/formats/frames.h"
#include "trajectory/formats/obj.h"
#include "trajectory/formats/open_frames.h"
#include "trajectory/formats/write_ply.h"

namespace noli {
namespace {

using Paths = std::vector<std::filesystem::path>;
using test::TemporaryFolder;
using testing::input_error;

const std::string triangle_obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

Frame triangle(double z) {
  return {.mesh = {.vertex_count = 3, .faces = {{0, 1, 2}}, .edges = {}, .points = {}},
          .positions = {{0, 0, z}, {1, 0, z}, {0, 1, z}}};
}

std::string ply(double z, PlyEncoding encoding) { return format_ply(triangle(z), encoding); }

/// The error message of looking at all frames.
std::string refusal(const Paths& frames, PolygonRule rule = PolygonRule::fan) {
  return input_error([&] {
    FrameInputs inputs(frames, rule);
    for (std::size_t k = 0; k < frames.size(); ++k) inputs.look_at(k);
  });
}

/// All are looked at, then read.
struct Taken : FrameInputs {
  explicit Taken(const Paths& frames) : FrameInputs(frames) {
    for (std::size_t k = 0; k < frames.size(); ++k) look_at(k);
    for (std::size_t k = 0; k < frames.size(); ++k) read(k);
  }
};

TEST(FrameInputs, MayBeSkippedUnlessTheyHavePolygons) {
  const TemporaryFolder folder;
  const auto a = folder.write("a.obj", triangle_obj), b = folder.write("b.obj", triangle_obj);
  const auto quad = folder.write("quad.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n");
  EXPECT_TRUE(Taken({a, b}).may_skip());
  EXPECT_FALSE(Taken({quad}).may_skip());
  const auto cut = folder.write("cut.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\n");
  FrameInputs of_two({cut, quad});  // the same cells
  for (const std::size_t k : {std::size_t{0}, std::size_t{1}}) of_two.look_at(k);
  of_two.read(0);
  EXPECT_FALSE(of_two.may_skip());
  const auto joined = [&](const std::filesystem::path& still) {
    FrameReading reading;
    reading.bodies = {{"moving", {a, b}, false}, {"still", {still}, true}};
    const auto source = open_frames({}, reading);
    for (const std::size_t k : {std::size_t{0}, std::size_t{1}}) source->look_at(k);
    source->read(0);
    return source->may_skip();
  };
  EXPECT_TRUE(joined(a));
  EXPECT_FALSE(joined(quad));
}

TEST(FrameInputs, SaysWhatWasRead) {
  const TemporaryFolder folder;
  const auto a = folder.write("a.obj", "v 0 0 0.500000\nv 12.25 0 0\nv 0 1 0\nv 3 3 3\nf 1 2 3\np 4\n");
  const FrameFacts obj = Taken({a}).facts()[0];
  EXPECT_EQ(obj.file, a);
  EXPECT_EQ(obj.bytes, 55u);
  EXPECT_EQ(obj.sha256, sha256(test::read_text(a)));
  EXPECT_EQ(obj.numbers, "text with 6 digits, 6 decimals");
  EXPECT_EQ(obj.vertices, 4u);
  EXPECT_EQ(obj.cells, 2u);
  const auto b = folder.write("b.ply", ply(1, PlyEncoding::binary_little_endian));
  EXPECT_EQ(Taken({b}).facts()[0].numbers, "float64");
  EXPECT_EQ(Taken({b}).facts()[0].vertices, 3u);
  EXPECT_FALSE(Taken({b}).facts()[0].rounded_at);
  EXPECT_TRUE(Taken({b}).notes().empty());
}

const std::string ascii_header =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty TYPE x\nproperty TYPE y\nelement face 1\nproperty list uchar "
    "int "
    "vertex_indices\nend_header\n";

std::string ascii(const std::string& type, const std::string& body) {
  std::string text = ascii_header;
  for (std::size_t at = 0; (at = text.find("TYPE")) != std::string::npos;) text.replace(at, 4, type);
  return text + body;
}

TEST(FrameInputs, TextThatMayHaveBeenRoundedEarnsANote) {
  const TemporaryFolder folder;
  const auto note = [&](const std::string& name, const std::string& text) {
    const auto notes = Taken({folder.write(name, text)}).notes();
    return notes.empty() ? "" : notes[0];
  };
  EXPECT_EQ(note("a.obj", "v 0.123456 0.000000\nv 1.000000 0.000000\nv 0.000000 1.000000\nf 1 2 3\n"),
            "coordinates are text with 6 decimals: the verdict is exact for these numbers; their rounding may "
            "decide gaps below 5e-07");
  EXPECT_EQ(
      note("a.obj", "v 1234.56 0.001\nv 1 0\nv 0 1\nf 1 2 3\n"),
      "coordinates are text with 6 digits, 3 decimals: the verdict is exact for these numbers; their rounding may "
      "decide gaps below 5e-03");
  EXPECT_EQ(note("a.obj", "v 0.10000000000000001 0.2\nv 1 0\nv 0 1\nf 1 2 3\n"), "");
  EXPECT_EQ(note("a.ply", ascii("double", "0.1234567 0\n1.0000000 0\n0 1\n3 0 1 2\n")),
            "coordinates are text with 7 decimals: the verdict is exact for these numbers; their rounding may "
            "decide gaps below 5e-08");
  EXPECT_EQ(note("a.ply", ascii("float", "0.123456789 0\n1 0\n0 1\n3 0 1 2\n")), "") << "9 digits tell every float";
  EXPECT_EQ(
      note("a.ply", ascii("double", "0.123456789 0\n1 0\n0 1\n3 0 1 2\n")),
      "coordinates are text with 9 digits, 9 decimals: the verdict is exact for these numbers; their rounding may "
      "decide gaps below 5e-09")
      << "9 digits of the largest number, 1";
  EXPECT_EQ(note("a.obj", "v 4 0 0.000001\nv 1 0 0.000000\nv 0 1 0.000000\nf 1 2 3\n"),
            "coordinates are text with 6 decimals: the verdict is exact for these numbers; their rounding may "
            "decide gaps below 5e-07");
  EXPECT_EQ(note("a.ply", ascii("int", "7 0\n1 0\n0 1\n3 0 1 2\n")), "") << "whole numbers are what they are";
}

TEST(FrameInputs, TheCoarsestTextOfAllCounts) {
  const TemporaryFolder folder;
  const auto a = folder.write("a.obj", "v 0.5000 0\nv 1.0000 0\nv 0 1\nf 1 2 3\n");
  const auto b = folder.write("b.obj", "v 0.50 0\nv 1.00 0\nv 0 1\nf 1 2 3\n");
  EXPECT_EQ(Taken({a, b, a}).notes()[0],
            "coordinates are text with 2 decimals: the verdict is exact for these numbers; their rounding may "
            "decide gaps below 5e-03");
}

TEST(FrameInputs, PolygonsEarnANote) {
  const TemporaryFolder folder;
  const std::string quad = "v 0 0 0\nv 4 0 0\nv 4 4 0\nv 0 1 ";
  const auto flat = folder.write("0.obj", quad + "0\nf 1 2 3 4\n"),
             bent = folder.write("1.obj", quad + "3\nf 1 2 3 4\n");
  const auto other = folder.write("2.obj", quad + "3\nf 2 3 4 1\n");
  EXPECT_EQ(
      Taken({flat, flat}).notes().back(),
      "1 polygon of more than three corners is cut into fans of triangles; largest non-planarity in all frames: 0");
  EXPECT_EQ(
      Taken({flat, bent}).notes().back(),
      "1 polygon of more than three corners is cut into fans of triangles; largest non-planarity in all frames: 3");
  EXPECT_EQ(Taken({other}).polygons(), 1u);
  EXPECT_NE(Taken({other}).non_planarity(), 3) << "another plane";
  EXPECT_GT(Taken({other}).non_planarity(), 0);
  EXPECT_EQ(
      input_error([&] {
        Taken({flat, other});
      }),
      other.string() + ": face 0 has vertices [1, 2, 3], but " + flat.string() +
          " has [0, 1, 2] there; all frames must have the same mesh; --body is for several bodies (frame 2 of 2)");
  FrameInputs one({flat, bent});
  one.look_at(0);
  one.look_at(1);
  one.read(0);
  EXPECT_EQ(one.notes().back(),
            "1 polygon of more than three corners is cut into fans of triangles; largest non-planarity in the 1 frames "
            "that were read: 0");
}

struct OtherFrame {
  const char* name;
  std::string file, text, problem;  ///< NAME stands for the first file
  friend void PrintTo(const OtherFrame& bad, std::ostream* out) { *out << bad.name; }
};
const std::string v3 = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
const OtherFrame other_frames[] = {
    {"vertices", "b.obj", v3 + "v 1 1 1\nf 1 2 3\n",
     "has 4 vertices, but NAME has 3; all frames must have the same mesh; --body is for several bodies"},
    {"faces", "b.obj", triangle_obj + "f 1 3 2\n",
     "has 2 faces, but NAME has 1; all frames must have the same mesh; --body is for several bodies"},
    {"corners", "b.obj", v3 + "f 2 3 1\n",
     "face 0 has vertices [1, 2, 0], but NAME has [0, 1, 2] there; all frames must have the same mesh; --body is for "
     "several bodies"},
    {"relative", "b.obj", v3 + "f -1 -2 -3\n",
     "face 0 has vertices [2, 1, 0], but NAME has [0, 1, 2] there; all frames must have the same mesh; --body is for "
     "several bodies"},
    {"extension", "b.stl", "solid\n",
     "expected a file that ends in .ply, .obj, .vtu or .vtp, found '.stl'; " + conversion_advice("b.stl")},
    {"packed", "b.obj.gz", "\x1f\x8b",
     "expected a file that ends in .ply, .obj, .vtu or .vtp, found '.gz'; unpack it: gunzip -k b.obj.gz"},
    {"header", "b.ply", "ply\nformat ascii 2.0\n", "line 2: expected version 1.0, found '2.0'"},
    {"truncated", "b.ply", ply(0, PlyEncoding::binary_little_endian).substr(0, 200),
     "byte 173: truncated: the header promises 3 entries of 'vertex', at least 24 bytes each, but only 27 bytes "
     "remain"},
    {"no_vertices", "b.ply", "ply\nformat ascii 1.0\nend_header\n", "the header declares no element 'vertex'"},
    {"empty", "b.ply", "", "is empty"},
};

class FrameInputsRefuse : public ::testing::TestWithParam<OtherFrame> {};
INSTANTIATE_TEST_SUITE_P(All, FrameInputsRefuse, ::testing::ValuesIn(other_frames),
                         [](const auto& bad) { return bad.param.name; });

TEST_P(FrameInputsRefuse, WithTheNumberOfTheFrame) {
  const TemporaryFolder folder;
  const auto a = folder.write("a.obj", triangle_obj), b = folder.write(GetParam().file, GetParam().text);
  std::string problem = GetParam().problem;
  if (const auto at = problem.find("NAME"); at != std::string::npos) problem.replace(at, 4, a.string());
  EXPECT_EQ(refusal({a, a, b, a}), b.string() + ": " + problem + " (frame 3 of 4)");
}

TEST(FrameInputs, OtherSpellingsOfTheSameCellsAreTaken) {
  const TemporaryFolder folder;
  const auto a = folder.write("a.obj", triangle_obj);
  const Paths all = {a,
                     folder.write("b.obj", v3 + "f 1/1 2/2 3/3\n"),
                     folder.write("c.obj", v3 + "f -3 -2 -1\n"),
                     folder.write("d.obj", "# by hand\r\n\tv 0 0 \\\n0\nv 1 0 0\nv 0 1 0\ng x\nf 1 \\\n2 3\n"),
                     folder.write("e.ply", ply(2, PlyEncoding::ascii)),
                     folder.write("f.ply", ascii("double", "0 0\n1 0\n0 1\n\n3   0 1 2")),
                     folder.write("g.ply", ply(4, PlyEncoding::binary_little_endian)),
                     folder.write("h.ply", ascii("float", "\n0 0\n1 0\n\n0 1\n3 0 1 2\n"))};
  for (const auto& first : all) {
    const Taken inputs({first, all[0], all[1], all[2], all[3], all[4], all[5], all[6], all[7]});
    for (const FrameFacts& facts : inputs.facts()) EXPECT_EQ(facts.cells, 1u) << facts.file;
  }
}

/// Whether both are valid meshes that differ.
bool differ(const std::string& a, const std::string& b) {
  try {
    return parse_obj(a, "a.obj").mesh != parse_obj(b, "b.obj").mesh;
  } catch (const InputError&) {
    return false;
  }
}

/// Frames with equal looks have equal meshes. Compares two texts that differ in one statement, or in the order of two.
/// Otherwise a frame of another mesh would be noticed hours later.
RC_GTEST_PROP(FrameLook, EqualLooksAreEqualMeshes, ()) {
  const auto statement = rc::gen::element<std::string>("v 0 0 0\n", "v 1 2 3\n", "f 1 2 3\n", "f -1 -2 -3\n",
                                                       "f 3 2 1\n", "f 1/1 2 3\n", "l 1 2\n", "l -1 -2\n", "p 1\n",
                                                       "p -1\n", "# f 1 2 3\n", "vn 0 0 1\n", "g a\n", "l 2 \\\n1\n");
  auto lines = *rc::gen::container<std::vector<std::string>>(*rc::gen::inRange(1, 8), statement);
  const auto text = [&] {
    std::string all = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    for (const std::string& line : lines) all += line;
    return all;
  };
  const std::string a = text();
  const auto place = *rc::gen::inRange<std::size_t>(0, lines.size());
  if (*rc::gen::arbitrary<bool>()) {
    lines.insert(lines.begin() + static_cast<std::ptrdiff_t>(place), *statement);
  } else {
    std::swap(lines[place], lines[0]);
  }
  const std::string b = text();
  const auto look_a = look_at_frame(a, "a.obj").cells, look_b = look_at_frame(b, "b.obj").cells;
  RC_TAG(look_a && look_a == look_b ? "equal" : "other");
  if (look_a && look_a == look_b) RC_ASSERT(!differ(a, b));
}

TEST(FrameInputs, PolygonsAreRefusedInAnyFrame) {
  const TemporaryFolder folder;
  const std::string v4 = v3 + "v 1 1 0\n";
  const auto triangles = folder.write("0.obj", v4 + "f 1 2 3\nf 1 3 4\n"),
             quad = folder.write("1.obj", v4 + "f 1 2 3 4\n");
  FrameInputs fan({triangles, quad});
  fan.look_at(0);
  fan.look_at(1);
  EXPECT_EQ(refusal({triangles, triangles, quad}, PolygonRule::refuse),
            quad.string() + ": line 5: " + refused_polygon(4) + " (frame 3 of 3)");
}

TEST(FrameInputs, AFileThatChangesInBetweenIsRefused) {
  const TemporaryFolder folder;
  const auto a = folder.write("a.obj", triangle_obj);
  FrameInputs inputs({a});
  inputs.look_at(0);
  folder.write("a.obj", "v 0 0 1\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  EXPECT_NE(input_error([&] { inputs.read(0); }).find("has changed since it was looked at"), std::string::npos);
}

/// Reading ahead gives the same frames, and reports nothing about a frame that was not asked for.
TEST(FrameInputs, AreTheSameReadAhead) {
  const TemporaryFolder folder;
  Paths frames;
  for (int k = 0; k < 6; ++k) {
    const std::string quads = fmt::format("v 0 0 0.{0}5\nv 1 0 0\nv 1 1 0.{0}\nv 0 1 0\nf 1 2 3 4\n", k);
    frames.push_back(folder.write(fmt::format("{}.obj", k), quads));
  }
  FrameInputs one(frames), ahead(frames, PolygonRule::fan, true);
  for (FrameInputs* const inputs : {&one, &ahead}) {
    for (std::size_t k = 0; k < frames.size(); ++k) inputs->look_at(k);
  }
  for (const std::size_t k : {0, 1, 3, 4, 0, 1}) {  // with a gap, then from the beginning
    const auto expected = one.read(k), read = ahead.read(k);
    ASSERT_TRUE(read);
    EXPECT_EQ(read->mesh, expected->mesh);
    EXPECT_EQ(read->positions, expected->positions);
    EXPECT_EQ(ahead.notes(), one.notes());
  }
  EXPECT_FALSE(ahead.read(6));
  EXPECT_EQ(ahead.take_facts().size(), 6u);
}

TEST(FrameInputs, AFaultAheadIsToldWhenItsFrameIsRead) {
  const TemporaryFolder folder;
  const auto a = folder.write("a.obj", triangle_obj), b = folder.write("b.obj", triangle_obj);
  FrameInputs inputs({a, b}, PolygonRule::fan, true);
  inputs.look_at(0);
  inputs.look_at(1);
  folder.write("b.obj", "v 0 0 1\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  EXPECT_TRUE(inputs.read(0));
  EXPECT_NE(input_error([&] { inputs.read(1); }).find("b.obj: has changed since it was looked at"), std::string::npos);
}

/// The stop of the thread that asks is also that of the one that reads ahead: here, it waits for a pipe.
TEST(FrameInputs, HearAStopAhead) {
  const TemporaryFolder folder;
  const auto a = folder.write("a.obj", triangle_obj), b = folder.write("b.obj", triangle_obj);
  FrameInputs inputs({a, b}, PolygonRule::fan, true);
  inputs.look_at(0);
  inputs.look_at(1);
  std::filesystem::remove(b);
  ASSERT_EQ(::mkfifo(b.c_str(), 0600), 0);
  std::atomic<bool> stop = false;
  const StopOfThread of_thread(stop);
  EXPECT_TRUE(inputs.read(0));
  stop = true;
  EXPECT_THROW(inputs.read(1), Stopped);
}

TEST(FrameInputs, PipesAreNotTouchedBeforeTheyAreRead) {
  const TemporaryFolder folder;
  const auto a = folder.write("a.obj", triangle_obj), pipe = folder / "pipe.obj";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  FrameInputs inputs({pipe, a});
  inputs.look_at(0);  // reading would wait for a writer
  inputs.look_at(1);
  EXPECT_FALSE(inputs.facts()[0].looked_at);
  EXPECT_TRUE(inputs.facts()[1].looked_at);
}

TEST(FrameFormats, SayWhatToDoWithOthers) {
  EXPECT_EQ(mesh_format("a.PLY"), MeshFormat::ply);
  EXPECT_EQ(mesh_format("a.b.Obj"), MeshFormat::obj);
  for (const char* const name : {"a.h5", "a.mat", "a.abc", "a.usd", "a.usda", "a.usdc", "a.usdz", "a.stl", "a.vtk",
                                 "a.off", "a.gz", "a.glb", "a.gltf", "a.FBX"}) {
    EXPECT_NE(conversion_advice(name), "") << name;
    EXPECT_EQ(conversion_advice(name).find('\n'), std::string::npos);
    EXPECT_NE(input_error([&] { mesh_format(name); }).find(conversion_advice(name)), std::string::npos);
  }
  EXPECT_EQ(conversion_advice("frames/cloth_1.vtk"), "convert it: meshio convert cloth_1.vtk cloth_1.ply");
  EXPECT_EQ(conversion_advice("a.xyz"), "");
}

TEST(FileFacts, OfAnyFile) {
  const TemporaryFolder folder;
  const std::string bytes((std::size_t{1} << 20) + 17, 'x');
  const auto file = folder.write("large", bytes);
  EXPECT_EQ(file_facts(file).bytes, bytes.size());
  EXPECT_EQ(file_facts(file).sha256, sha256(bytes));
  EXPECT_EQ(input_error([&] { file_facts(folder / "none"); }),
            (folder / "none").string() + ": cannot be opened: No such file or directory");
  EXPECT_THROW(file_facts(file, [] { return true; }), ReadInterrupted);
}

}  // namespace
}  // namespace noli
