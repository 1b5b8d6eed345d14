// SPDX-License-Identifier: Apache-2.0
#include "trajectory/formats/ply.h"

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "support.h"

namespace noli {
namespace {

using testing::bits;

TEST(Ply, AsciiWithEverythingThatIsAllowed) {
  const Frame frame = parse_ply(
      "ply\r\nformat ascii 1.0\r\ncomment made by hand\r\nobj_info and this\r\n"
      "element camera 1\r\nproperty float a\r\nproperty list uchar float b\r\n"
      "element vertex 6\r\nproperty uchar red\r\nproperty double x\r\nproperty float quality\r\nproperty double y\r\n"
      "property list int short neighbours\r\nproperty double z\r\n"
      "element face 4\r\nproperty float area\r\nproperty list uchar int vertex_indices\r\nproperty list uchar float "
      "uv\r\n"
      "element edge 2\r\nproperty int vertex2\r\nproperty int vertex1\r\nproperty int crease\r\nend_header\r\n"
      "nan 2 0.5 inf\r\n"
      "255 0 nan 0 0 0\r\n7 1.5 1 -2e-3 3 1 2 3 +4\r\n0 0 0 0 0 1e300\r\n0 1 0 0 0 -0\r\n0 5 0 5 0 5\r\n0 6 0 6 0 6\r\n"
      "\r\n"
      "1 4 0 1 2 3 2 0.5 0.5\r\n0 3 1 2 3 0\r\n0\t2  4 5 0\r\n0 1 4 0\r\n"
      "2 0 9\r\n1 5 9\r\n",
      "all.ply");
  EXPECT_EQ(frame.mesh.vertex_count, 6u);
  EXPECT_EQ(bits(frame.positions),
            bits({{0, 0, 0}, {1.5, -2e-3, 4}, {0, 0, 1e300}, {1, 0, -0.0}, {5, 5, 5}, {6, 6, 6}}));
  EXPECT_EQ(frame.mesh.faces, (decltype(Mesh::faces){{0, 1, 2}, {0, 2, 3}, {1, 2, 3}}));
  EXPECT_EQ(frame.mesh.edges, (decltype(Mesh::edges){{4, 5}, {5, 1}})) << "edge 0-2 is one of the fan's";
  EXPECT_TRUE(frame.mesh.points.empty()) << "point 4 is an end of a loose edge";
}

TEST(Ply, WithoutZAndWithoutFaces) {
  const Frame frame = parse_ply(
      "ply\nformat ascii 1.0\nelement vertex 2\nproperty int y\nproperty int x\nend_header\n1 2\n3 -4", "flat.ply");
  EXPECT_EQ(bits(frame.positions), bits({{2, 1, 0}, {-4, 3, 0}}));
  EXPECT_EQ(frame.mesh.cell_count(), 0u);
}

TEST(Ply, NoVerticesAtAll) {
  const Frame frame = parse_ply(
      "ply\nformat binary_little_endian 1.0\nelement vertex 0\nproperty float x\nproperty float y\nend_header\n",
      "none.ply");
  EXPECT_EQ(frame.mesh.vertex_count, 0u);
  EXPECT_TRUE(frame.positions.empty());
}

TEST(Ply, DeclaredTypeIsReadInAsciiToo) {
  const auto x_of = [](const std::string& type, const std::string& value) {
    return parse_ply("ply\nformat ascii 1.0\nelement vertex 1\nproperty " + type + " x\nproperty int y\nend_header\n" +
                         value + " 0\n",
                     "t")
        .positions[0][0];
  };
  EXPECT_EQ(x_of("float", "0.1"), static_cast<double>(0.1f));
  EXPECT_EQ(x_of("float32", "0.1"), static_cast<double>(0.1f));
  EXPECT_EQ(x_of("double", "0.1"), 0.1);
  EXPECT_EQ(x_of("float64", "0.1000000000000000055511151231257827021181583404541015625"), 0.1);
  EXPECT_EQ(x_of("double", "4.9406564584124654e-324"), 0x1p-1074);
  EXPECT_EQ(x_of("char", "-128"), -128);
  EXPECT_EQ(x_of("uint64", "18446744073709549568"), 18446744073709549568.0);
  EXPECT_EQ(x_of("int64", "-9223372036854775808"), -0x1p63);
}

/// Builds a binary file in either byte order, value by value.
class BinaryPly {
 public:
  BinaryPly(std::endian order, const std::string& elements)
      : order_(order),
        bytes_(std::string("ply\nformat binary_") + (order == std::endian::big ? "big" : "little") + "_endian 1.0\n" +
               elements + "end_header\n") {}

  template <class T>
  BinaryPly& put(T value) {
    auto raw = std::bit_cast<std::array<char, sizeof(T)>>(value);
    if (order_ != std::endian::native) std::reverse(raw.begin(), raw.end());
    bytes_.append(raw.data(), raw.size());
    return *this;
  }
  const std::string& bytes() const { return bytes_; }

 private:
  std::endian order_;
  std::string bytes_;
};

class PlyByteOrder : public ::testing::TestWithParam<std::endian> {};
INSTANTIATE_TEST_SUITE_P(Both, PlyByteOrder, ::testing::Values(std::endian::little, std::endian::big));

/// Reads one vertex (1, 2, -3) with coordinates of type T, and a face (0, 0, 0). Its counts and indices have type T too
/// if T is an integer type.
template <class T>
void expect_type(std::endian order, const std::string& type) {
  const std::string index = std::is_integral_v<T> ? type : "int";
  BinaryPly ply(order, "element vertex 1\nproperty " + type + " x\nproperty " + type + " y\nproperty " + type +
                           " z\nelement face 1\nproperty list " + index + " " + index + " vertex_index\n");
  ply.put(T{1}).put(T{2}).put(static_cast<T>(std::is_unsigned_v<T> ? 3 : -3));
  using Index = std::conditional_t<std::is_integral_v<T>, T, std::int32_t>;
  ply.put(Index{3}).put(Index{0}).put(Index{0}).put(Index{0});
  const Frame frame = parse_ply(ply.bytes(), "binary.ply");
  EXPECT_EQ(bits(frame.positions), bits({{1, 2, std::is_unsigned_v<T> ? 3.0 : -3.0}})) << type;
  EXPECT_EQ(frame.mesh.faces, (decltype(Mesh::faces){{0, 0, 0}})) << type;
}

TEST_P(PlyByteOrder, EveryType) {
  expect_type<std::int8_t>(GetParam(), "char");
  expect_type<std::int8_t>(GetParam(), "int8");
  expect_type<std::uint8_t>(GetParam(), "uchar");
  expect_type<std::uint8_t>(GetParam(), "uint8");
  expect_type<std::int16_t>(GetParam(), "short");
  expect_type<std::int16_t>(GetParam(), "int16");
  expect_type<std::uint16_t>(GetParam(), "ushort");
  expect_type<std::uint16_t>(GetParam(), "uint16");
  expect_type<std::int32_t>(GetParam(), "int");
  expect_type<std::int32_t>(GetParam(), "int32");
  expect_type<std::uint32_t>(GetParam(), "uint");
  expect_type<std::uint32_t>(GetParam(), "uint32");
  expect_type<std::int64_t>(GetParam(), "int64");
  expect_type<std::uint64_t>(GetParam(), "uint64");
  expect_type<float>(GetParam(), "float");
  expect_type<float>(GetParam(), "float32");
  expect_type<double>(GetParam(), "double");
  expect_type<double>(GetParam(), "float64");
}

TEST_P(PlyByteOrder, ExtraPropertiesAndElementsAreSkipped) {
  BinaryPly ply(GetParam(),
                "element material 2\nproperty list uchar double w\nproperty short s\n"
                "element vertex 2\nproperty uchar red\nproperty float x\nproperty list ushort int more\n"
                "property double y\nelement face 1\nproperty int flag\nproperty list uint ushort vertex_indices\n"
                "element edge 1\nproperty uchar vertex1\nproperty uchar vertex2\nelement end 1\nproperty char c\n");
  ply.put(std::uint8_t{2}).put(1.0).put(std::nan("")).put(std::int16_t{5});
  ply.put(std::uint8_t{0}).put(std::int16_t{5});
  ply.put(std::uint8_t{9}).put(0.1f).put(std::uint16_t{1}).put(std::int32_t{-7}).put(0.1);
  ply.put(std::uint8_t{9}).put(-0.0f).put(std::uint16_t{0}).put(0x1p-1074);
  ply.put(std::int32_t{0}).put(std::uint32_t{1}).put(std::uint16_t{1});
  ply.put(std::uint8_t{1}).put(std::uint8_t{1}).put(std::int8_t{0});
  const Frame frame = parse_ply(ply.bytes(), "binary.ply");
  EXPECT_EQ(bits(frame.positions), bits({{static_cast<double>(0.1f), 0.1, 0}, {-0.0, 0x1p-1074, 0}}));
  EXPECT_TRUE(frame.mesh.faces.empty() && frame.mesh.points.empty());
  EXPECT_EQ(frame.mesh.edges, (decltype(Mesh::edges){{1, 1}}));
}

TEST_P(PlyByteOrder, EveryTruncationAndEveryByteMoreIsAnError) {
  BinaryPly ply(GetParam(),
                "element vertex 2\nproperty float x\nproperty double y\nelement face 1\n"
                "property list uchar int vertex_indices\nproperty short s\n");
  ply.put(1.0f).put(2.0).put(3.0f).put(4.0);
  ply.put(std::uint8_t{3}).put(std::int32_t{0}).put(std::int32_t{1}).put(std::int32_t{1}).put(std::int16_t{0});
  ASSERT_EQ(parse_ply(ply.bytes(), "whole.ply").mesh.faces.size(), 1u);
  for (std::size_t size = 0; size < ply.bytes().size(); ++size) {
    EXPECT_THROW(parse_ply(ply.bytes().substr(0, size), "cut.ply"), InputError) << size << " bytes";
  }
  EXPECT_EQ(
      testing::input_error([&] { parse_ply(ply.bytes() + "x", "more.ply"); }),
      "more.ply: byte " + std::to_string(ply.bytes().size()) + ": expected the end of the file, found 1 more bytes");
}

TEST_P(PlyByteOrder, ErrorsNameTheByteOfTheValue) {
  const std::string header = "element vertex 1\nproperty double x\nproperty double y\n";
  const std::string faces = "element face 1\nproperty list char int vertex_indices\n";
  const auto message = [](const BinaryPly& ply) { return testing::input_error([&] { parse_ply(ply.bytes(), "b"); }); };
  BinaryPly plain(GetParam(), header), meshed(GetParam(), header + faces);
  const auto place = [](const BinaryPly& ply, std::size_t offset) {
    return "b: byte " + std::to_string(ply.bytes().size() + offset) + ": ";
  };
  const std::string second = place(plain, 8), corner = place(meshed, 17), list = place(meshed, 16);

  EXPECT_EQ(message(BinaryPly(plain).put(1.0).put(std::nan(""))), second + "expected a finite number, found nan");
  EXPECT_EQ(message(BinaryPly(plain).put(1.0).put(-HUGE_VAL)), second + "expected a finite number, found -inf");
  BinaryPly vertex = meshed;
  vertex.put(1.0).put(2.0);
  const std::string range = " is out of range, the file has 1 vertices, counted from 0";
  EXPECT_EQ(message(BinaryPly(vertex).put(std::int8_t{1}).put(std::int32_t{1})), corner + "vertex index 1" + range);
  EXPECT_EQ(message(BinaryPly(vertex).put(std::int8_t{1}).put(std::int32_t{-1})), corner + "vertex index -1" + range);
  EXPECT_EQ(message(BinaryPly(vertex).put(std::int8_t{-1}).put(std::int32_t{0})),
            list + "expected the length of a list, found -1");
  EXPECT_EQ(message(BinaryPly(vertex).put(std::int8_t{0})), list + "a face without vertices");
  EXPECT_EQ(message(BinaryPly(vertex).put(std::int8_t{3}).put(std::int32_t{0})),
            list + "truncated: a list of 3 items, but only 4 bytes remain");
}

}  // namespace
}  // namespace noli
