// SPDX-License-Identifier: Apache-2.0
//
// Every fault that frames may have, in every form that frames have: exit code 3, and a message that names the file.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <fstream>
#include <functional>
#include <limits>
#include <optional>

#include "tests/app/process.h"
#include "tests/app/scene.h"
#include "tests/app/worked_example.h"
#include "tests/support/numpy.h"
#ifdef NOLI_SERIES
#include "tests/support/vtkhdf.h"
#endif

namespace noli::app_tests {
namespace {

using test::NumpyArray;

/// Frames, and the faces of each.
struct Motion {
  std::vector<std::vector<double>> frames;
  std::vector<std::vector<std::array<std::int64_t, 3>>> faces;

  bool one_mesh() const {
    return frames[0].size() == frames[1].size() && frames[0].size() == frames[2].size() && faces[0] == faces[2];
  }
};

Motion good_motion() {
  Motion motion;
  for (const double z : {1.0, 0.75, 0.5}) {
    motion.frames.push_back({0, 0, 0, 4, 0, 0, 0, 4, 0, 1, 1, z, 2, 1, z, 1, 2, z});
    motion.faces.push_back({{0, 1, 2}, {3, 4, 5}});
  }
  return motion;
}

/// How a motion is named on the command line: words; the file at fault if its bytes are damaged; standard input.
struct Named {
  std::vector<std::string> words;
  std::string file, input = {};
};

struct Source {
  const char* name;
  std::function<std::optional<Named>(const Folder&, const Motion&)> write;  ///< nothing: cannot be written in this form
  friend void PrintTo(const Source& source, std::ostream* out) { *out << source.name; }
};

NumpyArray faces_of(const Motion& motion, std::size_t k = 0) {
  NumpyArray array{"<i8", {motion.faces[k].size(), 3}, {}};
  for (const auto& face : motion.faces[k]) array.numbers.insert(array.numbers.end(), face.begin(), face.end());
  return array;
}

NumpyArray positions_of(const std::vector<double>& frame) { return {"<f8", {frame.size() / 3, 3}, frame}; }

NumpyArray all_positions(const Motion& motion) {
  NumpyArray array{"<f8", {motion.frames.size(), motion.frames[0].size() / 3, 3}, {}};
  for (const auto& frame : motion.frames) array.numbers.insert(array.numbers.end(), frame.begin(), frame.end());
  return array;
}

std::string vtu_text(const std::vector<double>& frame, const std::vector<std::array<std::int64_t, 3>>& faces) {
  std::string points, corners, ends, types;
  for (const double x : frame) points += fmt::format("{} ", x);
  for (std::size_t i = 0; i < faces.size(); ++i) {
    corners += fmt::format("{} {} {} ", faces[i][0], faces[i][1], faces[i][2]);
    ends += fmt::format("{} ", 3 * i + 3);
    types += "5 ";
  }
  return fmt::format(
      "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\"><UnstructuredGrid>"
      "<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\"><Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" "
      "format=\"ascii\">{}</DataArray></Points><Cells><DataArray type=\"Int64\" Name=\"connectivity\" "
      "format=\"ascii\">{}</DataArray><DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">{}</DataArray>"
      "<DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">{}</DataArray></Cells></Piece></UnstructuredGrid>"
      "</VTKFile>",
      frame.size() / 3, faces.size(), points, corners, ends, types);
}

std::optional<Named> as_npz(const Folder& folder, const Motion& motion) {
  if (!motion.one_mesh()) return std::nullopt;
  const std::string file = folder.write(
      "m.npz", test::stored_zip({{"x.npy", all_positions(motion).bytes()}, {"f.npy", faces_of(motion).bytes()}}));
  return Named{{file}, file};
}

std::optional<Named> as_npy(const Folder& folder, const Motion& motion) {
  if (motion.faces[0] != motion.faces[2]) return std::nullopt;
  Named named{{folder.write("faces.npy", faces_of(motion).bytes())}, ""};
  for (std::size_t k = 0; k < motion.frames.size(); ++k) {
    named.words.push_back(folder.write(fmt::format("x_{}.npy", k), positions_of(motion.frames[k]).bytes()));
  }
  named.file = named.words.back();
  return named;
}

std::optional<Named> as_stream(const Folder& folder, const Motion& motion) {
  if (motion.faces[0] != motion.faces[2]) return std::nullopt;
  std::string bytes = faces_of(motion).bytes();
  for (const auto& frame : motion.frames) bytes += positions_of(frame).bytes();
  const std::string file = folder.write("stream.bin", bytes);
  return Named{{"-"}, file, file};
}

std::optional<Named> as_vtu(const Folder& folder, const Motion& motion) {
  Named named;
  for (std::size_t k = 0; k < motion.frames.size(); ++k) {
    named.words.push_back(folder.write(fmt::format("m_{}.vtu", k), vtu_text(motion.frames[k], motion.faces[k])));
  }
  named.file = named.words.back();
  return named;
}

#ifdef NOLI_SERIES
std::optional<Named> as_vtkhdf(const Folder& folder, const Motion& motion) {
  if (motion.one_mesh()) {
    const std::string file = folder.path("m.vtkhdf");
    test::write_vtkhdf(file, all_positions(motion).numbers, motion.frames.size(), motion.faces[0], H5T_IEEE_F64LE);
    return Named{{file}, file};
  }
  Named named;
  for (std::size_t k = 0; k < motion.frames.size(); ++k) {
    named.words.push_back(folder.path(fmt::format("m_{}.vtkhdf", k)));
    test::write_vtkhdf(named.words.back(), motion.frames[k], 1, motion.faces[k], H5T_IEEE_F64LE);
  }
  named.file = named.words.back();
  return named;
}
#endif

/// What Noli itself writes: only its bytes can be at fault.
std::optional<Named> as_block_file(const Folder& folder, const Motion& motion) {
  if (motion.frames != good_motion().frames || motion.faces != good_motion().faces) return std::nullopt;
  std::vector<std::string> words = {"verify", "--force", "--no-check", "-q", "--trajectory", folder.path("m.frames")};
  const std::vector<std::string> files = as_vtu(folder, motion)->words;
  words.insert(words.end(), files.begin(), files.end());
  EXPECT_EQ(run_noli(words).exit_code, 0);
  return Named{{folder.path("m.frames")}, folder.path("m.frames")};
}

const Source sources[] = {{"npz", as_npz},          {"npy", as_npy}, {"stream", as_stream}, {"vtu", as_vtu},
#ifdef NOLI_SERIES
                          {"vtkhdf", as_vtkhdf},
#endif
                          {"frames", as_block_file}};

class BadSources : public testing::TestWithParam<Source> {
 protected:
  struct Answer {
    int code;
    std::string words;
  };
  static Answer verify(const Named& named) {
    std::string line = std::string(NOLI_COMMAND) + " verify";
    for (const std::string& word : named.words) line += " '" + word + "'";
    const auto [words, code] = shell(line + " 2>&1 <" + (named.input.empty() ? "/dev/null" : named.input));
    return {code, words};
  }
  static void expect_refused(const Named& named, const std::string& fault) {
    const auto [code, words] = verify(named);
    EXPECT_EQ(code, 3) << fault << ": " << words;
    EXPECT_NE(words.find("noli: error: "), std::string::npos) << fault << ": " << words;
    const bool said = named.input.empty() ? words.find(folder_of(named.file)) != std::string::npos
                                          : words.find("standard input") != std::string::npos;
    EXPECT_TRUE(said) << fault << ": " << words;
  }
  static std::string folder_of(const std::string& file) { return file.substr(0, file.rfind('/')); }

  Folder folder;
};
INSTANTIATE_TEST_SUITE_P(All, BadSources, testing::ValuesIn(sources),
                         [](const auto& source) { return std::string(source.param.name); });

TEST_P(BadSources, TheGoodMotionIsProved) {
  const auto named = GetParam().write(folder, good_motion());
  ASSERT_TRUE(named);
  const auto [code, words] = verify(*named);
  EXPECT_EQ(code, 0) << words;
}

TEST_P(BadSources, ImpossibleNumbersAreRefused) {
  std::size_t written = 0;
  const auto refuse = [&](const char* fault, const std::function<void(Motion&)>& change) {
    Motion motion = good_motion();
    change(motion);
    const auto named = GetParam().write(folder, motion);
    if (!named) return;
    ++written;
    expect_refused(*named, fault);
  };
  const auto face = [](std::int64_t corner) {
    return [corner](Motion& motion) {
      for (auto& faces : motion.faces) faces[1][2] = corner;
    };
  };
  refuse("not a number", [](Motion& m) { m.frames[1][4] = std::numeric_limits<double>::quiet_NaN(); });
  refuse("infinite", [](Motion& m) { m.frames[2][17] = std::numeric_limits<double>::infinity(); });
  refuse("index out of range", face(6));
  refuse("negative index", face(-1));
  refuse("huge index", face(std::int64_t{1} << 32));
  refuse("fewer vertices", [](Motion& m) { m.frames[2].resize(15), m.faces[2].pop_back(); });
  refuse("fewer vertices of the same faces", [](Motion& m) { m.frames[2].resize(15); });
  refuse("other faces", [](Motion& m) { std::swap(m.faces[2][1][0], m.faces[2][1][1]); });
  refuse("no vertices", [](Motion& m) {
    for (auto& frame : m.frames) frame.clear();
    for (auto& faces : m.faces) faces.clear();
  });
  EXPECT_EQ(written == 0, std::string(GetParam().name) == "frames");
}

TEST_P(BadSources, DamagedBytesAreRefused) {
  const auto named = GetParam().write(folder, good_motion());
  ASSERT_TRUE(named);
  const std::string good = test::read_text(named->file);
  const auto refuse = [&](const char* fault, const std::string& bytes) {
    std::ofstream(named->file, std::ios::binary | std::ios::trunc) << bytes;
    expect_refused(*named, fault);
  };
  refuse("empty", "");
  refuse("something else", "hello\n");
  refuse("cut off in the middle", good.substr(0, good.size() / 2));
  refuse("cut off near its end", good.substr(0, good.size() - 9));
}

}  // namespace
}  // namespace noli::app_tests
