// SPDX-License-Identifier: Apache-2.0
//
// Tests every error in the text of a PLY file, with the line and words of its message.
#include "support.h"
#include "trajectory/formats/ply.h"
#include "trajectory/text.h"

namespace noli {
namespace {

struct BadPly {
  const char* name;
  std::string text;
  std::string message;  ///< the whole message after the file's name
  friend void PrintTo(const BadPly& bad, std::ostream* out) { *out << bad.name; }
};

const std::string start = "ply\nformat ascii 1.0\n";
const std::string xy = start + "element vertex 2\nproperty double x\nproperty double y\n";     // lines 3 to 5
const std::string one_face = xy + "element face 1\nproperty list uchar int vertex_indices\n";  // 6, 7
const std::string edges = xy + "element edge 1\nproperty int vertex1\nproperty int vertex2\n";

const BadPly bad_plys[] = {
    {"empty", "", "is empty"},
    {"no_ply", "solid\n", "line 1: expected 'ply', this is not a PLY file"},
    {"ends_at_once", "ply", "line 1: the header ends without 'end_header'"},
    {"no_end_header", xy, "line 5: the header ends without 'end_header'"},
    {"no_format", "ply\nelement vertex 0\nend_header\n", "line 3: the header has no 'format' line"},
    {"two_formats", start + "format ascii 1.0\n", "line 3: a second 'format' line"},
    {"unknown_format", "ply\nformat binary 1.0\n",
     "line 2: expected ascii, binary_little_endian or binary_big_endian, found 'binary'"},
    {"version", "ply\nformat ascii 2.0\n", "line 2: expected version 1.0, found '2.0'"},
    {"format_and_more", "ply\nformat ascii 1.0 x\n", "line 2: expected the end of the line, found 'x'"},
    {"keyword", start + "elements vertex 3\n",
     "line 3: expected format, element, property, comment, obj_info or end_header, found 'elements vertex 3'"},
    {"blank_header_line", start + "\n",
     "line 3: expected format, element, property, comment, obj_info or end_header, found ''"},
    {"unnamed_element", start + "element\n", "line 3: expected the name of an element"},
    {"no_count", start + "element vertex\n", "line 3: expected the number of entries of 'vertex', found ''"},
    {"negative_count", start + "element vertex -1\n", "line 3: expected the number of entries of 'vertex', found '-1'"},
    {"count_overflow", start + "element vertex 18446744073709551616\n",
     "line 3: expected the number of entries of 'vertex', found '18446744073709551616'"},
    {"two_elements", xy + "element vertex 2\n", "line 6: a second element 'vertex'"},
    {"early_property", start + "property int x\n", "line 3: a property before the first element"},
    {"type", start + "element vertex 1\nproperty real x\n",
     "line 4: expected a type such as uchar, int, float or double, found 'real'"},
    {"no_property_name", start + "element vertex 1\nproperty int\n", "line 4: expected the name of a property"},
    {"two_properties", xy + "property int x\n", "line 6: a second property 'x' in element 'vertex'"},
    {"real_list_length", start + "element face 1\nproperty list float int vertex_indices\n",
     "line 4: expected an integer type for the length of a list"},
    {"element_without_properties", start + "element nothing 1000000000\nelement vertex 0\nend_header\n",
     "line 3: element 'nothing' has no properties"},
    {"no_vertices", start + "element face 0\nend_header\n", "the header declares no element 'vertex'"},
    {"no_x", start + "element vertex 1\nproperty int y\nend_header\n1\n",
     "line 3: element 'vertex' has no property 'x' that is a number"},
    {"no_y", start + "element vertex 1\nproperty int x\nend_header\n1\n",
     "line 3: element 'vertex' has no property 'y' that is a number"},
    {"list_y", start + "element vertex 1\nproperty int x\nproperty list int int y\nend_header\n1 0\n",
     "line 3: element 'vertex' has no property 'y' that is a number"},
    {"list_z", start + "element vertex 1\nproperty int x\nproperty int y\nproperty list int int z\nend_header\n1 0 0\n",
     "line 3: element 'vertex' has no property 'z' that is a number"},
    {"no_corners", xy + "element face 1\nproperty int a\nend_header\n1 1\n2 2\n3\n",
     "line 6: element 'face' has no list vertex_indices or vertex_index"},
    {"scalar_corners", xy + "element face 1\nproperty int vertex_index\nend_header\n1 1\n2 2\n3\n",
     "line 6: element 'face' has no list vertex_indices or vertex_index"},
    {"both_corners", one_face + "property list uchar int vertex_index\nend_header\n1 1\n2 2\n1 0 1 0\n",
     "line 6: faces have both vertex_indices and vertex_index"},
    {"real_corners", xy + "element face 1\nproperty list uchar float vertex_index\nend_header\n1 1\n2 2\n1 0\n",
     "line 6: property 'vertex_index' must be of an integer type"},
    {"real_edge", xy + "element edge 1\nproperty int vertex1\nproperty float vertex2\nend_header\n1 1\n2 2\n0 1\n",
     "line 6: property 'vertex2' must be of an integer type"},
    {"half_edge", xy + "element edge 1\nproperty int vertex1\nend_header\n1 1\n2 2\n0\n",
     "line 6: element 'edge' has no property 'vertex2' that is a number"},
    {"strips", xy + "element tristrips 1\nproperty list int int vertex_indices\nend_header\n1 1\n2 2\n2 0 1\n",
     "line 6: triangle strips are not supported, expected element 'face'"},
    {"billion_vertices", start + "element vertex 1000000000\nproperty double x\nproperty double y\nend_header\n1 2\n",
     "line 7: truncated: the header promises 1000000000 entries of 'vertex', at least 2 bytes each, but only 4 bytes "
     "remain"},
    {"too_many_vertices", start + "element vertex 4294967296\nproperty double x\nproperty double y\nend_header\n1 2\n",
     "line 3: 4294967296 vertices are more than the 2^32 - 1 that indices can tell apart"},
    {"one_vertex_missing", xy + "end_header\n1.25 2\n", "line 7: truncated: the file ends before entry 1 of 'vertex'"},
    {"only_blank_lines", xy + "end_header\n1.25 2\n\n  \n",
     "line 9: truncated: the file ends before entry 1 of 'vertex'"},
    {"short_line", xy + "end_header\n1 2\n3\n", "line 8: the line ends within an entry of 'vertex'"},
    {"long_line", xy + "end_header\n1 2 3\n4 5\n",
     "line 7: expected the end of the line after an entry of 'vertex', found '3'"},
    {"after_the_end", xy + "end_header\n1 2\n3 4\n\n5 6\n", "line 10: expected the end of the file, found '5 6'"},
    {"nan", xy + "end_header\n1 2\n3 nan\n", "line 8: expected a finite number, found 'nan'"},
    {"infinity", xy + "end_header\n1 2\n-inf 4\n", "line 8: expected a finite number, found '-inf'"},
    {"overflow", xy + "end_header\n1 2\n1e309 4\n", "line 8: '1e309' is outside the range of double"},
    {"underflow", xy + "end_header\n1 2\n1e-330 4\n", "line 8: '1e-330' is outside the range of double"},
    {"comma", xy + "end_header\n1,5 2\n3 4\n", "line 7: expected a number, found '1,5'"},
    {"hexadecimal", xy + "end_header\n0x10 2\n3 4\n", "line 7: expected a number, found '0x10'"},
    {"unprintable", xy + "end_header\n1\xff 2\n3 4\n", "line 7: expected a number, found '1?'"},
    {"endless_word", xy + "end_header\n" + std::string(60, 'a') + " 2\n3 4\n",
     "line 7: expected a number, found '" + std::string(40, 'a') + "...'"},
    {"float_overflow", start + "element vertex 1\nproperty float x\nproperty int y\nend_header\n1e39 1\n",
     "line 7: '1e39' is outside the range of float"},
    {"integer_coordinate", start + "element vertex 1\nproperty int x\nproperty int y\nend_header\n1.5 1\n",
     "line 7: expected a whole number, found '1.5'"},
    {"char_overflow", start + "element vertex 1\nproperty char x\nproperty int y\nend_header\n128 1\n",
     "line 7: '128' does not fit the type declared in the header"},
    {"integer_no_double",
     start + "element vertex 1\nproperty int64 x\nproperty int y\nend_header\n9007199254740993 1\n",
     "line 7: the integer 9007199254740993 is not exactly a double"},
    {"index_out_of_range", one_face + "end_header\n1 1\n2 2\n3 0 1 2\n",
     "line 11: vertex index 2 is out of range, the file has 2 vertices, counted from 0"},
    {"negative_index", one_face + "end_header\n1 1\n2 2\n3 0 1 -1\n",
     "line 11: vertex index -1 is out of range, the file has 2 vertices, counted from 0"},
    {"no_corner", one_face + "end_header\n1 1\n2 2\n0\n", "line 11: a face without vertices"},
    {"long_list", one_face + "end_header\n1 1\n2 2\n200 0 1 1\n",
     "line 11: truncated: a list of 200 items, but only 10 bytes remain"},
    {"short_list", one_face + "end_header\n1 1\n2 2\n4 0 1 1\n", "line 11: the line ends within an entry of 'face'"},
    {"huge_index",
     xy + "element face 1\nproperty list uchar uint64 vertex_index\nend_header\n1 1\n2 2\n1 18446744073709551615\n",
     "line 11: the number 18446744073709551615 is too large"},
    {"edge_out_of_range", edges + "end_header\n1 1\n2 2\n1 2\n",
     "line 12: vertex index 2 is out of range, the file has 2 vertices, counted from 0"},
};

class PlyErrors : public ::testing::TestWithParam<BadPly> {};
INSTANTIATE_TEST_SUITE_P(All, PlyErrors, ::testing::ValuesIn(bad_plys), [](const auto& bad) { return bad.param.name; });

TEST_P(PlyErrors, SaysWhatAndWhere) {
  EXPECT_EQ(testing::input_error([] { parse_ply(GetParam().text, "bad.ply"); }), "bad.ply: " + GetParam().message);
}

TEST(PlyFiles, MissingEmptyAndFolder) {
  const test::TemporaryFolder folder;
  const auto message = [](const std::filesystem::path& path) {
    return testing::input_error([&] { parse_ply(read_whole_file(path), path.string()); });
  };
  EXPECT_EQ(message(folder / "none.ply"),
            (folder / "none.ply").string() + ": cannot be opened: No such file or directory");
  EXPECT_EQ(message(folder.write("empty.ply", "")), (folder / "empty.ply").string() + ": is empty");
  EXPECT_EQ(message(folder.path()), folder.path().string() + ": is a folder, expected a file");
}

TEST(PlyFiles, BillionElementsInBinaryAreNotAllocated) {
  const std::string header =
      "ply\nformat binary_little_endian 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
      "element face 4000000000\nproperty list uchar int vertex_index\nend_header\n";
  EXPECT_EQ(testing::input_error([&] { parse_ply(header + std::string(8, '\0') + "xyz", "b"); }),
            "b: byte " + std::to_string(header.size() + 8) +
                ": truncated: the header promises 4000000000 entries of 'face', at least 1 bytes each, but only 3 "
                "bytes remain");
}

}  // namespace
}  // namespace noli
