// SPDX-License-Identifier: Apache-2.0
//
// Frames of VTK: what Noli writes comes back bit for bit, kinds of cells, and what is damaged.
#include <algorithm>
#include <limits>

#include "support.h"
#include "trajectory/formats/frames.h"
#include "trajectory/formats/vtk/pvd.h"
#include "trajectory/formats/vtk/vtu.h"
#include "trajectory/formats/vtk/write_vtu.h"

namespace noli {
namespace {

using test::TemporaryFolder;
using testing::bits;
using testing::input_error;

using Faces = std::vector<std::array<VertexId, 3>>;
using Edges = std::vector<std::array<VertexId, 2>>;

/// A grid of eight points on a line, with these cells, as text.
std::string grid(const std::string& connectivity, const std::string& offsets, const std::string& types) {
  const auto cells = 1 + std::count(types.begin(), types.end(), ' ');
  return R"(<?xml version="1.0"?>
<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian"><UnstructuredGrid>
<Piece NumberOfPoints="8" NumberOfCells=")" +
         std::to_string(cells) + R"("><Points><DataArray type="Float64" NumberOfComponents="3" format="ascii">
0 0 0 1 0 0 2 0 0 3 0 0 4 0 0 5 0 0 6 0 0 7 0.1 -1e-3
</DataArray></Points><Cells>
<DataArray type="Int32" Name="connectivity" format="ascii">)" +
         connectivity + R"(</DataArray><DataArray type="Int64" Name="offsets" format="ascii">)" + offsets +
         R"(</DataArray><DataArray type="UInt8" Name="types" format="ascii">)" + types +
         "</DataArray></Cells></Piece></UnstructuredGrid></VTKFile>\n";
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

Mesh cells(const std::string& connectivity, const std::string& offsets, const std::string& types) {
  return parse_vtk(grid(connectivity, offsets, types), "a.vtu").mesh;
}

TEST(Vtk, GivesTheBitsThatNoliWrote) {
  Frame frame;
  frame.mesh = {.vertex_count = 5, .faces = {{0, 1, 2}}, .edges = {{2, 3}}, .points = {4}};
  const double tiny = std::numeric_limits<double>::denorm_min();
  frame.positions = {{0, -0.0, 1e308}, {1, tiny, 0.1}, {0, 1, 1.0 / 3}, {-2, 3, 4}, {5, 6, 7}};
  for (const bool marked : {false, true}) {
    const std::optional<CellData> data = marked ? std::optional(CellData{"contact", {1, 2, 0}}) : std::nullopt;
    const Frame read = parse_vtk(format_vtu(frame, data), "a.vtu");
    EXPECT_EQ(read.mesh, frame.mesh);
    EXPECT_EQ(bits(read.positions), bits(frame.positions));
  }
}

TEST(Vtk, HasCellsOfManyKinds) {
  EXPECT_EQ(cells("0 1 2 2 1 3", "3 6", "5 5").faces, (Faces{{0, 1, 2}, {2, 1, 3}}));
  EXPECT_EQ(cells("0 1 2 3", "4", "9").faces, (Faces{{0, 1, 2}, {0, 2, 3}})) << "a quad";
  EXPECT_EQ(cells("0 1 2 3", "4", "8").faces, (Faces{{0, 1, 3}, {0, 3, 2}})) << "a pixel";
  EXPECT_EQ(cells("0 1 2 3 4", "5", "7").faces, (Faces{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}})) << "a polygon";
  EXPECT_EQ(cells("0 1 2 3 4", "5", "6").faces, (Faces{{0, 1, 2}, {1, 3, 2}, {2, 3, 4}})) << "a strip";
  EXPECT_EQ(cells("0 1 1 2", "2 4", "3 3").edges, (Edges{{0, 1}, {1, 2}}));
  EXPECT_EQ(cells("0 1 2", "3", "4").edges, (Edges{{0, 1}, {1, 2}})) << "a line of several";
  EXPECT_EQ(cells("3 5 6", "1 3", "1 2").points, (std::vector<VertexId>{3, 5, 6}));
  EXPECT_EQ(cells("0 1 2 0", "3 3 4", "5 0 1").cell_count(), 1U) << "nothing, and a corner of a face";
  Polygons polygons{PolygonRule::refuse};
  EXPECT_NE(input_error([&] { parse_vtk(grid("0 1 2 3", "4", "9"), "a.vtu", &polygons); }).find("cell 0: "),
            std::string::npos);
  Polygons fans;
  parse_vtk(grid("0 1 2 3", "4", "9"), "a.vtu", &fans);
  EXPECT_EQ(fans.fans.size(), 1U);
}

TEST(Vtk, TextIsRoundedCorrectly) {
  const Frame frame = parse_vtk(grid("0 1 2", "3", "5"), "a.vtu");
  EXPECT_EQ(frame.positions[7], (Position{7, 0.1, -1e-3}));
  EXPECT_EQ(parse_vtk(replaced(grid("0 1 2", "3", "5"), "Float64", "Float32"), "a.vtu").positions[7][1], double{0.1F});
}

TEST(Vtk, HasPieces) {
  const std::string one = grid("0 1 2", "3", "5");
  const std::size_t begin = one.find("<Piece"), end = one.find("</UnstructuredGrid>");
  const std::string two = one.substr(0, end) + one.substr(begin);
  const Frame frame = parse_vtk(two, "a.vtu");
  EXPECT_EQ(frame.mesh.faces, (Faces{{0, 1, 2}, {8, 9, 10}}));
  EXPECT_EQ(frame.positions.size(), 16U);
}

TEST(Vtk, SaysWhatIsWrong) {
  const std::string good = grid("0 1 2", "3", "5");
  const auto refusal = [](const std::string& text) { return input_error([&] { parse_vtk(text, "a.vtu"); }); };
  const auto with = [&](const std::string& from, const std::string& to) { return refusal(replaced(good, from, to)); };
  EXPECT_EQ(refusal("").substr(0, 13), "a.vtu: byte 0");
  EXPECT_NE(refusal("<VTKFile><a></VTKFile>").find("is not XML"), std::string::npos);
  EXPECT_EQ(with("type=\"UnstructuredGrid\"", "type=\"ImageData\""),
            "a.vtu: is not a VTKFile of type UnstructuredGrid, but of type 'ImageData'");
  EXPECT_EQ(with("version=\"1.0\" byte", "compressor=\"vtkLZ4DataCompressor\" byte"),
            "a.vtu: is compressed by 'vtkLZ4DataCompressor'; expected vtkZLibDataCompressor, or none");
  EXPECT_EQ(with("NumberOfPoints=\"8\"", "NumberOfPoints=\"9\""),
            "a.vtu: DataArray: has 24 numbers, but there are 9 points");
  EXPECT_EQ(with("0.1 -1e-3", "0.1 nan"), "a.vtu: DataArray: number 23: expected a finite number, found 'nan'");
  EXPECT_EQ(with("Float64", "Int32"), "a.vtu: DataArray: has the type 'Int32'; expected Float32 or Float64");
  EXPECT_EQ(with(">0 1 2<", ">0 1 8<"), "a.vtu: Cells: a cell has point 8; expected 0 to 7");
  EXPECT_EQ(with(">0 1 2<", ">0 1 -2<"), "a.vtu: Cells: a cell has point -2; expected 0 to 7");
  EXPECT_EQ(with(">0 1 2<", ">0 1 x<"),
            "a.vtu: DataArray 'connectivity': number 2: expected one of type Int32, found 'x'");
  EXPECT_EQ(with(">3<", ">4<"), "a.vtu: Cells: cell 0 ends at 4 of 3 corners");
  EXPECT_EQ(with(">3<", ">2<"), "a.vtu: Cells: cell 0 of type 5 has 2 points");
  EXPECT_EQ(with(">3<", ">3 3<"), "a.vtu: DataArray 'offsets': has 2 numbers for 1 cells");
  EXPECT_EQ(with(">5<", ">300<"), "a.vtu: DataArray 'types': number 0: expected one of type UInt8, found '300'");
  EXPECT_NE(with(">5<", ">10<").find("cell 0 has type 10; expected points, lines, triangles or polygons"),
            std::string::npos);
  EXPECT_EQ(with("Name=\"offsets\"", "Name=\"ends\""), "a.vtu: Cells: has no DataArray 'offsets'");
  EXPECT_EQ(with("format=\"ascii\">3<", "format=\"text\">3<"),
            "a.vtu: DataArray 'offsets': has the format 'text'; expected ascii, binary or appended");
}

/// What is announced and not there is not allocated.
TEST(Vtk, BelievesNoLength) {
  const std::string good = grid("0 1 2", "3", "5");
  const auto with = [&](const std::string& base64, const std::string& header = "") {
    std::string text = replaced(good, "format=\"ascii\">3<", "format=\"binary\">" + base64 + "<");
    if (!header.empty()) text = replaced(text, "byte_order", header + " byte_order");
    return input_error([&] { parse_vtk(text, "a.vtu"); });
  };
  const std::string where = "a.vtu: DataArray 'offsets': ";
  EXPECT_EQ(with("////fwAAAAA="), where + "announces 2147483647 bytes, and has at most 4");
  EXPECT_EQ(with("//////////8=", "header_type=\"UInt64\""),
            where + "announces 18446744073709551615 bytes, and has at most 0");
  EXPECT_EQ(with("CAAAAAMA"), where + "announces 8 bytes, and has at most 2");
  EXPECT_EQ(with("CAAAA*MA"), where + "has a character that is not base64");
  EXPECT_EQ(with("CAAAAAM"), where + "announces 4 bytes, and has at most 3");
  const std::string compressed = "compressor=\"vtkZLibDataCompressor\"";
  EXPECT_EQ(with("////fwAAAAAAAAAA", compressed), where + "announces 2147483647 compressed blocks");
  EXPECT_EQ(with("AQAAAP///38AAAAABAAAAA==AAAAAA==", compressed),
            where + "unpacks to more than a hundred times the file");
  EXPECT_EQ(with("AQAAAAgAAAAAAAAABAAAAA==AAAAAA==", compressed), where + "has a block that zlib refuses");
}

/// What VTK refuses, or takes otherwise.
TEST(Vtk, RefusesWhatItWouldOverlook) {
  const std::string good = grid("0 1 2 2 1 3", "3 6", "5 5");
  const auto with = [&](const std::string& from, const std::string& to) {
    return input_error([&] { parse_vtk(replaced(good, from, to), "a.vtu"); });
  };
  EXPECT_NE(with("NumberOfCells=\"2\"", "NumberOfCells=\"3\"").find("has 2 cells, but NumberOfCells is 3"),
            std::string::npos);
  EXPECT_NE(with(">3 6<", ">3 <!-- a comment -->6<").find("has more than one text in it"), std::string::npos);
  EXPECT_NE(with(">3 6<", "><b/>3 6<").find("has more than one text in it"), std::string::npos);
  EXPECT_NE(with(">3 6<", "><![CDATA[3 6]]><").find("has more than one text in it"), std::string::npos);
  EXPECT_NE(with(">3 6<", ">3 5<").find("has 2 points"), std::string::npos);
  EXPECT_NE(with("<UnstructuredGrid>", "<UnstructuredGrid TimeValues=\"0 1\">").find("several times"),
            std::string::npos);
  EXPECT_NE(with("<Cells>", "<Cells></Cells><Cells>").find("has two elements Cells"), std::string::npos);
  EXPECT_NE(with("<Points>", "<Points><DataArray type=\"Float64\"/>").find("has two elements DataArray"),
            std::string::npos);
  EXPECT_NE(with("Name=\"connectivity\"", "Name=\"offsets\"").find("is there twice"), std::string::npos);
}

TEST(Vtk, ExpandsNoEntities) {
  const std::string laughs =
      "<?xml version=\"1.0\"?><!DOCTYPE x [<!ENTITY a \"aaaaaaaaaa\"><!ENTITY b \"&a;&a;&a;\">]>";
  const std::string good = grid("0 1 2", "3", "5");
  const std::string text = laughs + replaced(good.substr(good.find("<VTKFile")), ">3<", ">&b;<");
  EXPECT_EQ(input_error([&] { parse_vtk(text, "a.vtu"); }),
            "a.vtu: DataArray 'offsets': number 0: expected one of type Int64, found '&b;'");
}

TEST(Pvd, NamesItsFilesInTheOrderOfTime) {
  const TemporaryFolder folder;
  const auto series = [&](const std::vector<PvdEntry>& entries) { return folder.write("s.pvd", format_pvd(entries)); };
  EXPECT_EQ(files_of_pvd(series({{0, "a/0.vtu"}, {0.5, "b & c.vtu"}})),
            (std::vector<std::filesystem::path>{folder / "a/0.vtu", folder / "b & c.vtu"}));
  const std::string name = (folder / "s.pvd").string();
  EXPECT_EQ(input_error([&] {
              files_of_pvd(series({{0.5, "a.vtu"}, {0.5, "b.vtu"}}));
            }),
            name + ": b.vtu: is at time 0.5, and the file before at 0.5; expected ascending times, one file each");
  EXPECT_EQ(input_error([&] { files_of_pvd(series({})); }), name + ": names no frame");
  EXPECT_EQ(input_error([&] { files_of_pvd(folder.write("s.pvd", grid("0 1 2", "3", "5"))); }),
            name + ": is not a VTKFile of type Collection, but of type 'UnstructuredGrid'");
}

}  // namespace
}  // namespace noli
