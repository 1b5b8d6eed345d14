// SPDX-License-Identifier: Apache-2.0
//
// Tests valid runs and every violation of their format, and frames as PLY and OBJ (proofs/FORMAT.md, section 9).
#include "run_writer.h"
#include "support.h"

namespace noli::checker::test {
namespace {

using namespace token;
namespace fc = noli::checker;

TEST(Runs, AreAccepted) {
  EXPECT_ACCEPTED(RunProof{}.check());
  RunProof proof;
  for (const std::string& s :
       {S(-mpz_class(1) << 60, 0, 0), T + mx + mx, T + T + mx + mx + T + mx + mx, P(0, {-1, 0, 0}, 0, -16, 0)}) {
    proof.tokens = {N + F + s + F};
    EXPECT_ACCEPTED(proof.check());
  }
}

/// Points of many groups, or all scripted: their pairs would be too many to list.
TEST(Runs, PairsOfLabelsAreCounted) {
  RunProof proof;
  const std::size_t points = 65536;
  proof.run.cells.clear();
  proof.run.labels.assign(points, '\1');
  proof.run.pairs = {{0, 1}};
  for (std::uint32_t v = 0; v < points; ++v) {
    proof.run.cells.push_back({v});
    proof.run.groups.push_back(static_cast<std::uint16_t>(v));
  }
  EXPECT_REJECTED(proof.check(), "other pairs");
  proof.run.labels.assign(points, '\0');
  EXPECT_REJECTED(proof.check(), "other pairs");
  proof.claim.excluded = {{0, 2}};
  EXPECT_REJECTED(proof.check(), "other cells");  // the claim's cells have no labels
}

TEST(Runs, HaveTheirOwnLabels) {
  const RunProof proof;
  EXPECT_REJECTED(proof.check(proof.run.blocks(), {{"LABL", raw(1u) + raw(2u)}}), "labels of a run");
}

TEST(Runs, TheBreakpointsBetweenCount) {
  RunProof proof;
  for (const double x : {0.0, -1.0}) {
    proof.run.windows[0][2].x[1][0] = x;
    for (const std::string& s :
         {mx, S(-mpz_class(1) << 60, 0, 0), T + mx + mx, P(0, {-1, 0, 0}, 0, -16, 0), T + T + mx + mx + T + mx + mx}) {
      proof.tokens = {N + F + s + F};
      EXPECT_REJECTED(proof.check(), "does not separate");
    }
  }
}

TEST(Runs, TheirHead) {
  const RunProof proof;
  EXPECT_REJECTED(proof.with_run([](auto& r) { r.mode = 1; }), "frames alone");
  EXPECT_REJECTED(proof.with_run([](auto& r) { r.length = 0; }), "window length");
  EXPECT_REJECTED(proof.with([](auto& b) { b[0][0].second[0] = 4; }), "expected dimension 2 or 3");
  EXPECT_REJECTED(proof.with([](auto& b) { b[0][0].second[0] = 2; }), "another dimension");
  EXPECT_REJECTED(proof.with([](auto& b) { b[0][0].second += "x"; }), "expected the end");
  EXPECT_REJECTED(proof.with([](auto& b) { b[0][1].second += "x"; }), "expected the end");
  EXPECT_REJECTED(proof.with([](auto& b) { b[0][2].second += '\0'; }), "label for each");
  EXPECT_REJECTED(proof.with([](auto& b) { b[0][2].second[0] = 2; }), "not 0 or 1");
  EXPECT_REJECTED(proof.with([](auto& b) { std::swap(b[0][0], b[0][1]); }), "expected a block HEAD");
  EXPECT_REJECTED(proof.with([](auto& b) { b[0].pop_back(); }), "expected a block LABL");
  EXPECT_REJECTED(proof.with([](auto& b) { b[0].emplace_back("MORE", ""); }), "expected a block EXCL");
  EXPECT_REJECTED(proof.with([](auto& b) { b[0][1].second.replace(0, 8, raw(std::uint64_t{0})); }),
                  "number of vertices");
  EXPECT_REJECTED(proof.with([](auto& b) { b[0][1].second.replace(0, 8, raw(std::uint64_t{1} << 33)); }),
                  "number of vertices");
  EXPECT_REJECTED(proof.with([](auto& b) { b[0][1].second.replace(0, 8, raw(std::uint64_t{3})); }), "is not there");
  EXPECT_REJECTED(proof.with([](auto& b) { b[0][1].second.replace(16, 8, raw(std::uint64_t{1} << 61)); }), "announced");
}

TEST(Runs, ArePlane) {
  RunProof proof;
  proof.run.dimension = 2;
  EXPECT_ACCEPTED(proof.check());
}

TEST(Runs, TheirWindows) {
  const RunProof proof;
  EXPECT_REJECTED(proof.with([](auto& b) { b[1][0].second[0] = 1; }), "wrong number");
  EXPECT_REJECTED(proof.with([](auto& b) { b[1][0].second += "x"; }), "expected the end");
  EXPECT_REJECTED(proof.with([](auto& b) { b[1][0].second.replace(16, 8, raw(0.0)); }), "ends before it begins");
  EXPECT_REJECTED(proof.with([](auto& b) { b[1][0].first = "WINX"; }), "expected a block WIND");
  EXPECT_REJECTED(proof.with([](auto& b) { b[1][1].first = "HASH"; }), "expected a block LINE");
  EXPECT_REJECTED(proof.with([](auto& b) { b[1][2].first = "STAT"; }), "expected a block VELO");
  EXPECT_REJECTED(proof.with([](auto& b) { b[1][3].first = "VELO"; }), "expected a block STAT");
  EXPECT_REJECTED(proof.with([](auto& b) { b[1].emplace_back("STAT", ""); }), "expected a commit");
  EXPECT_REJECTED(proof.with([](auto& b) { b[1][1].second += std::string(8, '\0'); }), "expected the end");
  EXPECT_REJECTED(proof.with([](auto& b) { b[1][1].second[0] = 1; }), "fewer than two");
  EXPECT_REJECTED(proof.with([](auto& b) { b[1][1].second[3] = 1; }), "announced");
  EXPECT_REJECTED(proof.with_run([](auto& r) { r.windows[0][2].times[1] = 2; }), "do not ascend");
  EXPECT_REJECTED(proof.with_run([](auto& r) { r.windows[0][0].times[0] = 0.5; }), "begin and end with its window");
  EXPECT_REJECTED(proof.with_run([](auto& r) { r.windows[0][0].times[0] = -0.0; }), "begin and end with its window");
  EXPECT_REJECTED(proof.with_run([](auto& r) { r.windows[0][0].times[1] = 1; }), "begin and end with its window");
  EXPECT_REJECTED(proof.with_run([](auto& r) { r.windows[0][0].x[1][0] = NAN; }), "finite");
  EXPECT_REJECTED(proof.with([](auto& b) { b.push_back(b[1]); }), "wrong number");
  EXPECT_REJECTED(proof.with([](auto& b) {
    b[1][3].second += "x", b[1][1].second[8] ^= 0;
    b.push_back(Blocks{});
  }),
                  "expected a block WIND");
}

TEST(Runs, WindowsFollowEachOther) {
  RunProof proof;
  RunFile& run = proof.run;
  run.windows.push_back(run.windows[0]);
  for (Line& line : run.windows[1]) {
    for (double& t : line.times) t += 2;
  }
  run.times = {0, 2, 4};
  proof.tokens.push_back(proof.tokens[0]);
  EXPECT_ACCEPTED(proof.check());
  EXPECT_REJECTED(proof.with_run([](auto& r) { r.windows[1][1].x[0][2] = 1; }), "does not begin where");
  EXPECT_REJECTED(proof.with_run([](auto& r) { r.windows[1][1].x[0][2] = -0.0; }), "does not begin where");
  EXPECT_REJECTED(proof.with([](auto& b) { b[2][0].second.replace(8, 8, raw(2.5)); }), "one before ends");
  EXPECT_REJECTED(proof.with([](auto& b) { b.push_back(b[2]), b.back()[0].second[0] = 2; }), "one before ends");
  RunProof short_one = proof;
  short_one.run.windows.pop_back();
  EXPECT_REJECTED(short_one.check(proof.run.blocks()), "goes on");
}

TEST(Runs, LabelsAndExclusions) {
  RunProof proof;
  proof.run.labels = std::string("\1\1\0\1", 4);
  proof.labels = {1, 0};
  proof.claim.excluded = {{1, 1}};
  EXPECT_ACCEPTED(proof.check());
  proof.tokens = {N + X + mx + F};
  EXPECT_ACCEPTED(proof.check());
  proof.tokens = {X};
  EXPECT_REJECTED(proof.check(), "several labels");
  proof.tokens = {B + L + X};
  EXPECT_REJECTED(proof.check(), "several labels");
  proof.tokens = {B + R + X};
  EXPECT_REJECTED(proof.check(), "several labels");
  proof.tokens = {N + X + X};
  EXPECT_REJECTED(proof.check(), "not an excluded pair");
  proof.claim.excluded = {};
  EXPECT_REJECTED(proof.check(), "other pairs");
  proof.claim.excluded = {{0, 1}, {1, 1}};
  EXPECT_REJECTED(proof.check(), "other pairs");
  proof.run.pairs = {{2, 3}, {2, 7}};
  proof.run.groups = {2, 2, 3, 3};
  proof.labels = {5, 6};
  proof.claim.excluded = {{5, 5}, {5, 6}};
  proof.tokens = {N + F + X + F};
  EXPECT_ACCEPTED(proof.check());
  EXPECT_REJECTED(proof.with_run([](auto& r) { r.groups[3] = 2; }), "of two groups");
  EXPECT_REJECTED(proof.with_run([](auto& r) { r.pairs = {{2, 7}, {2, 3}}; }), "not in order");
  EXPECT_REJECTED(proof.with_run([](auto& r) { r.pairs = {{2, 3}, {2, 3}}; }), "not in order");
  EXPECT_REJECTED(proof.with_run([](auto& r) { r.pairs = {{3, 2}}; }), "not in order");
  EXPECT_REJECTED(proof.with([](auto& b) { b[0][3].second += "x"; }), "expected the end");
  EXPECT_REJECTED(proof.with([](auto& b) { b[0][3].second = std::string(4, '\0') + b[0][3].second.substr(12); }),
                  "expected a pair");
  EXPECT_REJECTED(proof.with([](auto& b) { b[0].push_back(b[0][3]); }), "expected a commit");
}

TEST(Runs, TheirProofs) {
  RunProof proof;
  proof.claim.flags = 2;
  EXPECT_REJECTED(proof.check(), "flag");
  proof.claim.flags = 1;
  EXPECT_REJECTED(proof.check(), "not strict");
  proof.claim.flags = 0;
  proof.claim.merged = {{1, 0}};
  EXPECT_REJECTED(proof.check(), "no merged vertices");
  ClaimFields c;
  c.source = 2;
  c.hash = std::string(32, 'h');
  const Folder folder;
  EXPECT_REJECTED(verdict(folder.write("proof", block_file("PROF", {{{"CLAM", c.encode()}}})), {"a", "b"}), "one file");
}

TEST(Runs, AWitnessHasOneSegment) {
  RunProof proof;
  for (const std::size_t v : {2u, 3u}) proof.run.windows[0][v].x[1][0] = -2;
  // x of the edge 2-3 is 8 - 10 t: 0 at 4/5.
  const auto witness = [&](int l, int u) {
    proof.witness = raw(0u) + raw(1u) + bytes({2}) + raw(0u) + poly({1}) + raw(1u) + poly({1}) + bytes({2}) + raw(2u) +
                    poly({1}) + raw(3u) + poly({1}) + poly({-64, 5}) + uint(0) + sint(l) +
                    sint(u);  // times are in 1/16
    return proof.check();
  };
  EXPECT_VERDICT(witness(12, 13), 1, "meet");
  EXPECT_VERDICT(witness(0, 16), 1, "meet");
  EXPECT_REJECTED(witness(12, 17), "breakpoint between");
}

Frame read(const std::string& name, const std::string& text) {
  const Folder folder;
  return read_frame(folder.write(name, text));
}
std::string wrong(const std::string& name, const std::string& text) {
  try {
    read(name, text);
  } catch (const Rejected& r) {
    return r.where.substr(r.where.rfind('/') + 1) + ": " + r.why;
  }
  return "";
}
#define EXPECT_WRONG(name, text, why) EXPECT_NE(wrong(name, text).find(why), std::string::npos) << wrong(name, text)

Lists lists(const Frame& frame) {
  Lists result;
  for (const fc::Cell& c : frame.cells) result.emplace_back(c.begin(), c.end());
  return result;
}

TEST(Frames, HaveTheSameMesh) {
  const Folder folder;
  const Proof proof = two_edges();
  const std::string file = folder.write("proof", block_file("PROF", proof.groups())),
                    first = folder.write("0.obj", obj(proof.frames[0], proof.cells));
  EXPECT_REJECTED(verdict(file, {first, folder.write("1.obj", obj(proof.frames[1], {{0, 1}, {3, 2}}))}),
                  "another mesh");
  auto more = proof.frames[1];
  more.push_back({});
  EXPECT_REJECTED(verdict(file, {first, folder.write("1.obj", obj(more, proof.cells))}), "another mesh");
  EXPECT_REJECTED(verdict(file, {first}), "more frames");
  EXPECT_REJECTED(verdict(file, {first, folder.write("1.txt", "")}), ".ply or .obj");
  EXPECT_REJECTED(verdict(file, {first, folder.write("1.obj", "")}), "not empty");
  EXPECT_REJECTED(verdict(file, {first, folder.write("obj", "v")}), ".ply or .obj");
}

/// The groups of a block file of frames.
std::vector<Blocks> frames_file(const Proof& proof) {
  std::array<std::uint64_t, 4> counts = {proof.frames[0].size(), 0, 0, 0};
  std::string cells;
  for (const auto& cell : proof.cells) {
    ++counts[4 - cell.size()];
    for (const auto v : cell) cells += raw(v);
  }
  std::vector<Blocks> groups = {{{"MESH", raw(counts) + cells}}};
  for (std::size_t k = 0; k < proof.frames.size(); ++k) {
    std::string x;
    for (const auto& p : proof.frames[k]) x += raw(p);
    groups.push_back({{"FRAM", raw(static_cast<double>(k)) + x}});
  }
  return groups;
}

TEST(Frames, OfABlockFile) {
  const Folder folder;
  const Proof proof = two_edges();
  const std::string file = folder.write("proof", block_file("PROF", proof.groups()));
  const auto of = [&](const std::vector<Blocks>& groups, const std::string& content = "FRMS") {
    return verdict(file, {folder.write("motion.frames", block_file(content, groups))});
  };
  EXPECT_ACCEPTED(of(frames_file(proof)));
  Proof other = proof;
  other.frames[1][2][0] -= 1;
  EXPECT_REJECTED(of(frames_file(other)), "another motion");
  other = proof;
  other.cells = {{2, 3}, {0, 1}};
  EXPECT_REJECTED(of(frames_file(other)), "other cells");
  other.cells = {{0, 1}, {2, 3}, {3, 2}, {1}};
  EXPECT_ACCEPTED(of(frames_file(other)));  // redundant cells are left out
  auto groups = frames_file(proof);
  EXPECT_REJECTED(of(groups, "TRAJ"), "another content");
  std::swap(groups[1], groups[2]);
  EXPECT_REJECTED(of(groups), "the wrong number");
  groups.pop_back();
  groups[1] = frames_file(proof)[1];
  EXPECT_REJECTED(of(groups), "more frames");
  groups.push_back({{"FRAM", groups[1][0].second + raw(0.0)}});
  EXPECT_REJECTED(of(groups), "the wrong number");
  groups[2] = {{"FRAM", raw(1.0) + groups[1][0].second.substr(8) + raw(0.0)}};
  EXPECT_REJECTED(of(groups), "expected the end");
  groups[2] = {{"ENDP", raw(1.0)}};
  EXPECT_REJECTED(of(groups), "expected a block FRAM");
  std::string far = groups[1][0].second.substr(8);
  far.replace(0, 8, raw(std::numeric_limits<double>::infinity()));
  groups[2] = {{"FRAM", raw(1.0) + far}};
  EXPECT_REJECTED(of(groups), "finite");
  Proof at_rest = proof;
  at_rest.claim.source = 1;
  const std::string rest = folder.write("rest", block_file("PROF", at_rest.groups()));
  EXPECT_REJECTED(verdict(rest, {folder.write("none.frames", block_file("FRMS", {groups[0]}))}), "more frames");
  groups[0] = {{"MESH", raw(std::uint64_t{1} << 32) + raw(std::array<std::uint64_t, 3>{})}};
  EXPECT_REJECTED(of(groups), "more is announced here than is left");
  groups[0] = {{"MESH", raw(std::uint64_t{0}) + raw(std::array<std::uint64_t, 3>{})}};
  EXPECT_REJECTED(of(groups), "impossible number");
}

TEST(Frames, Obj) {
  const std::string vertices = "v 0 0 0\nv 1 0 0\r\nv +2 0 0 1\nv 3 1e-3 0 1 1 1\nv 4 0 0 1 1 1 1\n";
  const Frame frame =
      read("a.OBJ", vertices +
                        "# nothing\n\ng 5 6\nusemtl a#b \\\nf 1/1/1 2//2 3 -1\nl 1 2 4 \\\n 5 # and so on \\\n"
                        "p 1 5\np 5\nl 2 1\nl 5 4\n");
  EXPECT_EQ(lists(frame), (Lists{{0, 1, 2}, {0, 2, 4}, {1, 3}, {3, 4}}));
  EXPECT_EQ(frame.x[3], (Position{3, 1e-3, 0}));
  EXPECT_EQ(lists(read("a.obj", vertices + "p 1 5 1\np 3")), (Lists{{0}, {4}, {2}}));
  EXPECT_EQ(lists(read("a.obj", "f 1 2 3\n" + vertices)), (Lists{{0, 1, 2}}));
  EXPECT_EQ(lists(read("a.obj", vertices + "l 1 1\\")), (Lists{{0, 0}}));
  for (const char* words : {"v 1", "v 1 2 3 4 5", "v 1 2 3 4 5 6 7 8"})
    EXPECT_WRONG("a.obj", words, "line 1: expected 2, 3");
  for (const char* words : {"v 1 x", "v 1 1e400", "v 1 1e-400", "v 1 +-1", "v 1 0x1", "v 1 1,", "f 1 2 x",
                            "f 1 2 99999999999999999999", "f 1 2 /1"})
    EXPECT_WRONG("a.obj", words, "line 1: expected a number");
  for (const char* words : {"v 1 inf", "v nan 1"}) EXPECT_WRONG("a.obj", words, "finite");
  for (const char* words : {"f 1 2 0", "f 1 2 -6", "f 1 2 4294967296"})
    EXPECT_WRONG("a.obj", vertices + words, "line 6: an index");
  for (const char* words : {"f 1 2", "l 1", "p"}) EXPECT_WRONG("a.obj", vertices + words, "too few");
  EXPECT_WRONG("a.obj", vertices + "f 1 2 6", "is not there");
  EXPECT_WRONG("a.obj", "vertex 1 2 3", "expected a statement");
  EXPECT_EQ(read("a.obj", "v 1 2\nv 3 4\nl 1 2\n").x[1], (Position{3, 4, 0}));
  EXPECT_WRONG("a.obj", vertices + "v 1 2", "line 6: some vertices have 2 coordinates, and others have 3");
  EXPECT_WRONG("a.obj", "v 1 2\nv 1 2 3", "line 2: some vertices have 2 coordinates");
}

std::string ply(const std::string& format, const std::string& elements, const std::string& body) {
  return "ply\nformat " + format + " 1.0\ncomment of ours\nobj_info\n" + elements + "end_header\n" + body;
}
const std::string xyz = "element vertex 4\nproperty float x\nproperty double y\nproperty int8 z\n",
                  face = "element face 1\nproperty list uchar uint vertex_indices\n",
                  positions = "0 0 0\n\n1 0.1 1\n0 1 0\n-1 -1 -1\n";

TEST(Frames, PlyInAscii) {
  const Frame frame =
      read("a.ply", ply("ascii",
                        xyz + "property uchar red\n" + face +
                            "element edge 2\nproperty int vertex2\nproperty int vertex1\nelement other 1\nproperty "
                            "list int float a\n",
                        "0 0 0 7\n\n0.1 0.1 1 7\r\n0 1 0 x\n-1 -1 -1 7\n4 0 1 2 3\n1 2\n3 1\n2 x y\n \n"));
  EXPECT_EQ(lists(frame), (Lists{{0, 1, 2}, {0, 2, 3}, {1, 3}}));
  EXPECT_EQ(frame.x[1], (Position{0.1f, 0.1, 1}));
}

TEST(Frames, PlyInBinary) {
  std::string little, big;
  const auto put = [&](const auto& value) {
    std::string text = raw(value);
    little += text;
    std::ranges::reverse(text);
    big += text;
  };
  const auto entries = [&](const auto&... values) { (put(values), ...); };
  entries(0.5f, 1.5, std::int8_t{-1}, std::int16_t{-2}, std::uint16_t{3}, std::int64_t{5}, std::uint64_t{1} << 63,
          std::uint8_t{2}, 1.f, 2.f);
  entries(std::uint8_t{3}, 0, 0, 0);
  const std::string header =
      "element vertex 1\nproperty float x\nproperty double a\nproperty int8 b\nproperty short c\nproperty ushort "
      "d\nproperty int64 e\nproperty uint64 y\n"
      "property list uchar float f\nelement face 1\nproperty list uchar int vertex_index\n";
  for (const auto& [format, body] : {std::pair("binary_little_endian", little), std::pair("binary_big_endian", big)}) {
    const Frame frame = read("a.ply", ply(format, header, body));
    EXPECT_EQ(frame.x[0], (Position{0.5, 0x1p63, 0}));
    EXPECT_EQ(lists(frame), (Lists{{0, 0, 0}}));
    EXPECT_WRONG("a.ply", ply(format, header, body + "x"), "byte");
    for (std::size_t n = 0; n < body.size(); ++n)
      EXPECT_WRONG("a.ply", ply(format, header, body.substr(0, n)), "expected more bytes");
  }
  EXPECT_WRONG(
      "a.ply",
      ply("binary_little_endian", "element vertex 1\nproperty float x\nproperty float y\n", raw(1.f) + raw(float(NAN))),
      "finite");
  EXPECT_WRONG("a.ply",
               ply("binary_little_endian", "element vertex 1\nproperty float x\nproperty double y\n",
                   raw(1.f) + raw(double(INFINITY))),
               "finite");
  EXPECT_WRONG("a.ply",
               ply("binary_little_endian", "element vertex 1\nproperty float x\nproperty uint64 y\n",
                   raw(1.f) + raw((std::uint64_t{1} << 63) + 1)),
               "finite double");
  EXPECT_WRONG("a.ply",
               ply("binary_little_endian", "element vertex 4294967296\nproperty float x\nproperty float y\n", ""),
               "too many");
  EXPECT_WRONG("a.ply",
               ply("binary_little_endian", "element vertex 1000000000\nproperty float x\nproperty float y\n", "abc"),
               "expected more");
}

TEST(Frames, PlyHeaders) {
  const auto header = [](const std::string& elements) {
    return wrong("a.ply", ply("ascii", elements, positions + "3 0 1 2\n"));
  };
  EXPECT_EQ(header(xyz + face), "");
  const auto expect = [&](const std::string& elements, const std::string& why) {
    EXPECT_NE(header(elements).find(why), std::string::npos) << elements << header(elements);
  };
  EXPECT_WRONG("a.ply", "plx\n", "line 1: expected ply");
  EXPECT_WRONG("a.ply", "ply\nformat ascii 1.0\n" + xyz, "end_header");
  for (const char* line : {"format ascii 1.1", "format ascii", "element vertex"})
    EXPECT_WRONG("a.ply", std::string("ply\n") + line + "\nend_header\n", "a line of a header");
  EXPECT_WRONG("a.ply", "ply\nend_header\n", "expected a format");
  EXPECT_WRONG("a.ply", ply("binary", xyz + face, positions), "expected a format");
  expect("format ascii 1.0\n" + xyz + face, "a line of a header");
  expect(xyz + "\n" + face, "empty line");
  expect(face, "element vertex");
  expect("property float x\n" + xyz, "a line of a header");
  expect(xyz + "proprety float w\n", "a line of a header");
  expect(xyz + xyz, "an element is there twice");
  expect(xyz + "property float x\n", "a property is there twice");
  expect(xyz + "property float\n", "expected a property");
  expect(xyz + "property\n", "expected a property");
  expect(xyz + "property list int int\n", "expected a property");
  expect(xyz + "property real w\n", "name of a type");
  expect(xyz + "property list float int w\n", "integer type for a length");
  expect("element vertex 4\nproperty list int float x\nproperty float y\n", "is a list");
  expect(xyz + "element face 1\nproperty int vertex_index\n", "is a list");
  expect(xyz + "element face 1\nproperty list uchar float vertex_index\n", "integer type for a vertex");
  expect(xyz + "element edge 1\nproperty float vertex1\n", "integer type for a vertex");
  expect("element vertex 4\nproperty float x\n", "expected x and y");
  expect("element vertex 4\nproperty float y\n", "expected x and y");
  expect(xyz + "element edge 1\nproperty int vertex1\n", "expected vertex1");
  expect(xyz + "element edge 1\nproperty int vertex2\n", "expected vertex1");
  expect(xyz + "element face 1\nproperty int other\n", "one list");
  expect(xyz + face + "property list uchar int vertex_index\n", "one list");
  expect(xyz + "element other 1\n", "without properties");
  expect(xyz + "element tristrips 1\nproperty int a\n", "strips");
  expect("element vertex -4\n", "a number");
  EXPECT_EQ(header(xyz + "element tristrips 0\nelement other 0\nelement edge 0\n" + face), "");
}

TEST(Frames, PlyEntries) {
  const auto body = [](const std::string& text, const std::string& why) {
    EXPECT_WRONG("a.ply", ply("ascii", xyz + face, text), why);
  };
  body(positions, "ends within an element");
  body(positions + "3 0 1\n", "ends within an entry");
  body(positions + "3 0 1 2 3\n", "end of the line");
  body(positions + "3 0 1 2\nx\n", "line 18: expected the end of the file");
  body(positions + "3 0 1 4\n", "is not there");
  body(positions + "3 0 1 -1\n", "expected a number");
  body(positions + "0\n", "without vertices");
  body(positions + "-1\n", "expected a number");
  body("0 0 0\n1 0 1\n0 1 0\n1 2 128\n3 0 1 2\n", "expected a number");
  body("0 0 0\n1 0 1\n0 1 0\n1 inf 2\n3 0 1 2\n", "finite");
  body("0 0 0\n1 0 1\n0 1 0\n1e-60 0 2\n3 0 1 2\n", "expected a number");
  EXPECT_WRONG("a.ply", ply("ascii", xyz + "element face 1\nproperty list char int vertex_index\n", positions + "-1\n"),
               "impossible length");
  EXPECT_WRONG("a.ply",
               ply("ascii", xyz + "element face 1\nproperty list char int vertex_index\n", positions + "1 -1\n"),
               "is not there");
}

}  // namespace
}  // namespace noli::checker::test
