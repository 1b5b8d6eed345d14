// SPDX-License-Identifier: Apache-2.0
#include "trajectory/formats/write_ply.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <system_error>

#include "support.h"
#include "trajectory/cells.h"
#include "trajectory/formats/frames.h"
#include "trajectory/formats/ply.h"

namespace noli {
namespace {

using testing::bits;

const Frame sample{
    .mesh = {.vertex_count = 7, .faces = {{0, 1, 2}, {2, 1, 0}}, .edges = {{4, 3}}, .points = {6, 5}},
    .positions = {{0.1, -0.0, 1e300}, {0x1p-1074, 1.0 / 3, 5}, {1, 2, 3}, {4, 5, 6}, {7, 8, 9}, {0, 0, 0}, {1, 1, 1}}};

TEST(WritePly, IsReadBackBitForBit) {
  for (const PlyEncoding encoding : {PlyEncoding::ascii, PlyEncoding::binary_little_endian}) {
    const Frame read = parse_ply(format_ply(sample, encoding), "round trip");
    EXPECT_EQ(read.mesh, sample.mesh);
    EXPECT_EQ(bits(read.positions), bits(sample.positions));
  }
}

TEST(WritePly, Ascii) {
  const Frame frame{.mesh = {.vertex_count = 2, .faces = {}, .edges = {{0, 1}}, .points = {}},
                    .positions = {{0.1, 2, -3}, {0, 0, 1e-300}}};
  EXPECT_EQ(format_ply(frame, PlyEncoding::ascii),
            "ply\nformat ascii 1.0\nelement vertex 2\nproperty double x\nproperty double y\nproperty double z\n"
            "element face 0\nproperty list uchar uint vertex_indices\n"
            "element edge 1\nproperty uint vertex1\nproperty uint vertex2\nend_header\n"
            "0.10000000000000001 2 -3\n0 0 1e-300\n0 1\n");
}

TEST(WritePly, EmptyMesh) {
  for (const PlyEncoding encoding : {PlyEncoding::ascii, PlyEncoding::binary_little_endian}) {
    EXPECT_EQ(parse_ply(format_ply({}, encoding), "nothing").mesh, Mesh{});
  }
}

RC_GTEST_PROP(WritePly, RoundTrip, ()) {
  const std::size_t count = *rc::gen::inRange<std::size_t>(1, 12);
  const auto id = rc::gen::inRange<VertexId>(0, static_cast<VertexId>(count));
  const auto real =
      rc::gen::map(rc::gen::pair(rc::gen::inRange<std::int64_t>(-(1LL << 53), 1LL << 53), rc::gen::inRange(-1126, 970)),
                   [](const auto& p) { return std::ldexp(static_cast<double>(p.first), p.second); });
  Frame frame;
  frame.mesh.vertex_count = count;
  frame.positions = *rc::gen::container<std::vector<Position>>(count, rc::gen::container<Position>(real));
  frame.mesh.faces =
      *rc::gen::container<std::vector<std::array<VertexId, 3>>>(rc::gen::container<std::array<VertexId, 3>>(id));
  frame.mesh.edges =
      *rc::gen::container<std::vector<std::array<VertexId, 2>>>(rc::gen::container<std::array<VertexId, 2>>(id));
  frame.mesh.points = *rc::gen::container<std::vector<VertexId>>(id);
  drop_redundant_cells(frame.mesh);
  for (const PlyEncoding encoding : {PlyEncoding::ascii, PlyEncoding::binary_little_endian}) {
    const Frame read = parse_ply(format_ply(frame, encoding), "round trip");
    RC_ASSERT(read.mesh == frame.mesh);
    RC_ASSERT(bits(read.positions) == bits(frame.positions));
  }
}

TEST(WritePly, Files) {
  const test::TemporaryFolder folder;
  write_ply(folder / "a.ply", sample, PlyEncoding::binary_little_endian);
  EXPECT_EQ(read_frame(folder / "a.ply").mesh, sample.mesh);
  EXPECT_THROW(write_ply(folder / "no/a.ply", sample, PlyEncoding::ascii), std::system_error);
  if (std::filesystem::exists("/dev/full")) {
    EXPECT_THROW(write_ply("/dev/full", sample, PlyEncoding::ascii), std::system_error);
  } else {
    std::puts("skipped: a full disk, there is no /dev/full");
  }
}

}  // namespace
}  // namespace noli
