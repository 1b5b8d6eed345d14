// SPDX-License-Identifier: Apache-2.0
#include "trajectory/formats/vtk/write_vtu.h"

#include <gtest/gtest.h>

#include <system_error>

#include "support.h"

namespace noli {
namespace {

Frame sample_frame() {
  Frame frame;
  frame.mesh.vertex_count = 4;
  frame.mesh.faces = {{0, 1, 2}};
  frame.mesh.edges = {{2, 3}};
  frame.mesh.points = {3};
  frame.positions = {{0, 0, 0}, {1, 0, 0}, {0, 0.1, 0}, {5, 6, 7}};
  return frame;
}

TEST(WriteVtu, WholeFile) {
  const std::string points =
      "YAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAADwPwAAAAAAAAAAAAAAAAAA"
      "AAAAAAAAAAAAAJqZmZmZmbk/AAAAAAAAAAAAAAAAAAAUQAAAAAAAABhAAAAAAAAAHEA=";
  const std::string connectivity = "MAAAAAAAAAAAAAAAAAAAAAEAAAAAAAAAAgAAAAAAAAACAAAAAAAAAAMAAAAAAAAAAwAAAAAAAAA=";
  const std::string offsets = "GAAAAAAAAAADAAAAAAAAAAUAAAAAAAAABgAAAAAAAAA=", types = "AwAAAAAAAAAFAwE=";
  EXPECT_EQ(format_vtu(sample_frame()), R"(<?xml version="1.0"?>
<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian" header_type="UInt64">
  <UnstructuredGrid>
    <Piece NumberOfPoints="4" NumberOfCells="3">
      <Points>
        <DataArray type="Float64" Name="Points" NumberOfComponents="3" format="appended" offset="0"/>
      </Points>
      <Cells>
        <DataArray type="Int64" Name="connectivity" format="appended" offset="140"/>
        <DataArray type="Int64" Name="offsets" format="appended" offset="216"/>
        <DataArray type="UInt8" Name="types" format="appended" offset="260"/>
      </Cells>
    </Piece>
  </UnstructuredGrid>
  <AppendedData encoding="base64">
_)" + points + connectivity + offsets + types +
                                            R"(
  </AppendedData>
</VTKFile>
)");
}

/// Decodes base64; written from RFC 4648, independently of the writer.
std::string decoded(std::string_view text) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  unsigned group = 0;
  int bits = 0;
  for (const char c : text) {
    if (c == '=') break;
    group = group << 6 | static_cast<unsigned>(digits.find(c));
    if ((bits += 6) < 8) continue;
    bits -= 8;
    bytes += static_cast<char>(group >> bits & 0xff);
  }
  return bytes;
}

/// The array that begins at `offset` after the underscore: its length is its first eight bytes.
std::string appended_array(const std::string& file, std::size_t offset) {
  const std::size_t begin = file.find("<AppendedData encoding=\"base64\">\n_") + 34 + offset;
  std::uint64_t size = 0;
  const std::string head = decoded(file.substr(begin, 12));
  for (int i = 7; i >= 0; --i) size = size << 8 | static_cast<unsigned char>(head[static_cast<std::size_t>(i)]);
  return decoded(file.substr(begin, (8 + size + 2) / 3 * 4)).substr(8);
}

std::size_t offset_of(const std::string& file, const std::string& name) {
  const std::size_t array = file.find("Name=\"" + name + "\"");
  return std::stoul(file.substr(file.find("offset=\"", array) + 8));
}

template <class T>
std::vector<T> numbers(const std::string& bytes) {
  std::vector<T> values(bytes.size() / sizeof(T));
  std::copy(bytes.begin(), bytes.end(), reinterpret_cast<char*>(values.data()));
  return values;
}

TEST(WriteVtu, AppendedArraysAreWhereTheFileSays) {
  const std::string file = format_vtu(sample_frame());
  const auto array = [&](const char* name) { return appended_array(file, offset_of(file, name)); };
  EXPECT_EQ(numbers<double>(array("Points")), (std::vector<double>{0, 0, 0, 1, 0, 0, 0, 0.1, 0, 5, 6, 7}));
  EXPECT_EQ(numbers<std::int64_t>(array("connectivity")), (std::vector<std::int64_t>{0, 1, 2, 2, 3, 3}));
  EXPECT_EQ(numbers<std::int64_t>(array("offsets")), (std::vector<std::int64_t>{3, 5, 6}));
  EXPECT_EQ(array("types"), "\5\3\1");
}

TEST(WriteVtu, EveryLengthOfBase64) {
  for (std::size_t points = 0; points < 7; ++points) {
    Frame frame;
    frame.mesh.vertex_count = 1;
    frame.mesh.points.assign(points, 0);
    frame.positions.resize(1);
    const std::string file = format_vtu(frame);
    EXPECT_EQ(appended_array(file, offset_of(file, "types")), std::string(points, '\1'));
  }
}

TEST(WriteVtu, EmptyMesh) {
  EXPECT_NE(format_vtu({}).find("NumberOfPoints=\"0\" NumberOfCells=\"0\""), std::string::npos);
}

TEST(WritePvd, NamesFilesAndTimes) {
  const PvdEntry entries[] = {{0, "a/0.vtu"}, {0.1, "a<b>&\"c\".vtu"}};
  EXPECT_EQ(format_pvd(entries), R"(<?xml version="1.0"?>
<VTKFile type="Collection" version="1.0" byte_order="LittleEndian">
  <Collection>
    <DataSet timestep="0" part="0" file="a/0.vtu"/>
    <DataSet timestep="0.10000000000000001" part="0" file="a&lt;b&gt;&amp;&quot;c&quot;.vtu"/>
  </Collection>
</VTKFile>
)");
}

TEST(WriteVtu, Files) {
  const test::TemporaryFolder folder;
  write_vtu(folder / "a.vtu", sample_frame());
  EXPECT_EQ(test::read_text(folder / "a.vtu"), format_vtu(sample_frame()));
  write_pvd(folder / "a.pvd", {});
  EXPECT_EQ(test::read_text(folder / "a.pvd"), format_pvd({}));
  EXPECT_THROW(write_vtu(folder / "no/a.vtu", sample_frame()), std::system_error);
}

}  // namespace
}  // namespace noli
