// SPDX-License-Identifier: Apache-2.0
//
// Block files of frames: what was written is read bit for bit, and nothing else is.
#include "trajectory/blocks/frames_file.h"

#include <limits>
#include <memory>

#include <noli/errors.h>
#include "support.h"
#include "trajectory/formats/open_frames.h"

namespace noli {
namespace {

using test::TemporaryFolder;
using testing::bits;
using testing::input_error;

using Positions = std::vector<Position>;

const Mesh two_cells = {.vertex_count = 4, .faces = {{0, 1, 2}}, .edges = {{2, 3}}, .points = {}};
constexpr double tiny = std::numeric_limits<double>::denorm_min();

Positions frame(double z) { return {{0, -0.0, z}, {1, tiny, z}, {0.1, 1, z}, {1e300, 3, z}}; }

class FramesFile : public ::testing::Test {
 protected:
  void write(int frames) const {
    FramesWriter writer(std::make_unique<FileSink>(path(), FileSink::Open::create), two_cells);
    for (int k = 0; k < frames; ++k) writer.append(frame(k));
    writer.finish();
  }
  std::filesystem::path path() const { return folder / "motion.frames"; }
  /// What is said when all of it is read.
  static std::string refusal(const std::filesystem::path& file) {
    return input_error([&] {
      FramesReader reader(file);
      while (reader.next()) {
      }
    });
  }

  TemporaryFolder folder;
};

TEST_F(FramesFile, GivesTheBitsThatWereWritten) {
  write(3);
  FramesReader reader(path());
  EXPECT_EQ(reader.mesh(), two_cells);
  EXPECT_EQ(reader.count(), 3U);
  for (int k = 0; k < 3; ++k) EXPECT_EQ(bits(reader.next().value()), bits(frame(k)));
  EXPECT_FALSE(reader.next());
  EXPECT_TRUE(is_frames_file(path()));
  EXPECT_FALSE(is_frames_file(folder.write("a.ply", "ply\nformat ascii 1.0\n")));
  EXPECT_FALSE(is_frames_file(folder / "missing"));
}

TEST_F(FramesFile, IsASourceOfFrames) {
  write(4);
  const auto source = open_frames({path()});
  EXPECT_EQ(source->count(), 4U);
  EXPECT_EQ(source->name(2), path().string() + "[2]");
  source->look_at(0);
  const FrameFacts facts = source->facts().at(0);
  EXPECT_EQ(facts.frames, 4U);
  EXPECT_EQ(facts.sha256, sha256(test::read_text(path())));
  EXPECT_EQ(facts.numbers, "float64");
  EXPECT_EQ(bits(source->read(1).value().positions), bits(frame(1)));
  EXPECT_EQ(bits(source->read(3).value().positions), bits(frame(3)));
  EXPECT_FALSE(source->read(4));
  EXPECT_EQ(bits(source->read(0).value().positions), bits(frame(0))) << "once more";
}

TEST_F(FramesFile, HasNoArraysToName) {
  write(2);
  const FrameReading keys = {.keys = {"x"}};
  EXPECT_THROW(open_frames({path()}, keys), UsageError);
  EXPECT_THROW(open_frames({"-"}, keys), UsageError);
  EXPECT_THROW(open_frames({folder / "a.ply"}, keys), UsageError);
  EXPECT_NO_THROW(open_frames({path()}));
}

TEST_F(FramesFile, OneThatChangesMeanwhileIsRefused) {
  write(2);
  const auto source = open_frames({path()});
  source->look_at(0);
  source->read(0);
  folder.write("motion.frames", test::read_text(path()) + "x");
  EXPECT_NE(input_error([&] { source->read(1); }).find("has changed since it was opened"), std::string::npos);
}

TEST_F(FramesFile, OneThatWasCutOffIsRefused) {
  write(2);
  const std::string whole = test::read_text(path());
  for (const std::size_t size : {whole.size() - 1, whole.size() - 50, whole.size() - 120, std::size_t{50}}) {
    const auto cut = folder.write("cut", whole.substr(0, size));
    EXPECT_NE(refusal(cut).find(size == 50 ? "ends before" : "cut off"), std::string::npos) << refusal(cut);
  }
}

TEST_F(FramesFile, EachFlippedBitIsNoticed) {
  write(1);
  const std::string whole = test::read_text(path());
  for (std::size_t at = 0; at < whole.size(); ++at) {
    std::string other = whole;
    other[at] = static_cast<char>(other[at] ^ 4);
    EXPECT_NE(refusal(folder.write("other", other)), "") << at;
  }
}

TEST_F(FramesFile, LeavesOutRedundantCells) {
  Mesh more = two_cells;
  more.edges.insert(more.edges.end(), {{1, 0}, {3, 2}});
  FramesWriter writer(std::make_unique<FileSink>(path(), FileSink::Open::create), more);
  writer.append(frame(0));
  writer.finish();
  EXPECT_EQ(FramesReader(path()).mesh(), two_cells);
}

TEST_F(FramesFile, TakesFramesOfItsMeshAlone) {
  FramesWriter writer(std::make_unique<FileSink>(path(), FileSink::Open::create), two_cells);
  EXPECT_THROW(writer.append(Positions(3)), std::logic_error);
}

}  // namespace
}  // namespace noli
