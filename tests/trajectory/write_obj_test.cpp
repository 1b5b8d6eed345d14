// SPDX-License-Identifier: Apache-2.0
#include "trajectory/formats/write_obj.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <system_error>

#include "support.h"
#include "trajectory/formats/frames.h"

namespace noli {
namespace {

using testing::bits;

TEST(WriteObj, HasTheseLines) {
  Frame frame;
  frame.mesh.vertex_count = 5;
  frame.mesh.faces = {{0, 1, 2}};
  frame.mesh.edges = {{3, 0}};
  frame.mesh.points = {4};
  frame.positions = {{0.1, 2, -3}, {0, 0, 1e-300}, {1, 1, 1}, {2, 2, 2}, {3, 3, 3}};
  EXPECT_EQ(format_obj(frame),
            "v 0.10000000000000001 2 -3\nv 0 0 1e-300\nv 1 1 1\nv 2 2 2\nv 3 3 3\nf 1 2 3\nl 4 1\np 5\n");
}

TEST(WriteObj, IsReadBackBitForBit) {
  std::mt19937_64 random(1);
  Frame frame;
  frame.mesh.vertex_count = 50;
  frame.mesh.faces = {{0, 1, 2}, {2, 1, 0}, {7, 8, 9}};
  frame.mesh.edges = {{4, 3}};
  frame.mesh.points = {6, 5};
  for (std::size_t v = 0; v < 50; ++v) {
    Position x{-0.0, 0x1p-1074, 0};
    x[2] = std::ldexp(static_cast<double>(random() >> 11), static_cast<int>(random() % 2000) - 1100);
    frame.positions.push_back(x);
  }
  const test::TemporaryFolder folder;
  write_obj(folder / "a.obj", frame);
  const Frame read = read_frame(folder / "a.obj");
  EXPECT_EQ(read.mesh, frame.mesh);
  EXPECT_EQ(bits(read.positions), bits(frame.positions));
  EXPECT_THROW(write_obj(folder / "no/a.obj", frame), std::system_error);
}

}  // namespace
}  // namespace noli
