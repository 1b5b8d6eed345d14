// SPDX-License-Identifier: Apache-2.0
//
// Tests damaged runs: by chance (a flipped bit, a lost end), or with all checksums repaired.
#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <stdexcept>

#include "run_samples.h"
#include "support.h"
#include "trajectory/blocks/bytes.h"
#include "trajectory/blocks/run_payload.h"

namespace noli {
namespace {

using namespace noli::testing;

bool same(const RunWindow& a, const RunWindow& b) {
  const auto all = [](const RunWindow& w) {
    return std::tuple(w.index, w.begin, w.end, w.breakpoints, w.lines_hash, w.frames, w.positions, w.velocities,
                      w.state);
  };
  if (all(a) != all(b) || a.lines.has_value() != b.lines.has_value()) return false;
  return !a.lines || lines_hash(3, *a.lines) == lines_hash(3, *b.lines);
}

/// Whether `read` is the beginning of `whole`: the same scene and the first windows.
::testing::AssertionResult is_beginning(const ReadRun& read, const ReadRun& whole) {
  if (read.scene != whole.scene) return ::testing::AssertionFailure() << "another scene";
  if (read.windows.size() > whole.windows.size()) return ::testing::AssertionFailure() << "more windows";
  for (std::size_t k = 0; k < read.windows.size(); ++k) {
    if (!same(read.windows[k], whole.windows[k])) return ::testing::AssertionFailure() << "another window " << k;
  }
  return ::testing::AssertionSuccess();
}

class DamagedRun : public ::testing::TestWithParam<RecordMode> {
 protected:
  WrittenRun written = write_run(sample_run(3, GetParam(), 2));
  ReadRun whole = read_run(written.bytes);
};
INSTANTIATE_TEST_SUITE_P(All, DamagedRun, ::testing::Values(RecordMode::full, RecordMode::frames),
                         [](const auto& mode) { return mode.param == RecordMode::full ? "full" : "frames"; });

TEST_P(DamagedRun, AFlippedBitIsNeverSilent) {
  int errors = 0, told = 0;
  for (std::size_t bit = 0; bit < 8 * written.bytes.size(); ++bit) {
    std::string bytes = written.bytes;
    bytes[bit / 8] = static_cast<char>(bytes[bit / 8] ^ (1 << bit % 8));
    try {
      const ReadRun read = read_run(bytes);
      ASSERT_TRUE(is_beginning(read, whole)) << "bit " << bit;
      ASSERT_TRUE(read.open_window) << "bit " << bit << " was not noticed";
      ++told;
    } catch (const InputError&) {
      ++errors;
    }
  }
  // Only damage in the last commit block can look like an incomplete write.
  EXPECT_EQ(told, 8 * static_cast<int>(block_format::commit_size));
  EXPECT_EQ(errors + told, 8 * static_cast<int>(written.bytes.size()));
}

TEST_P(DamagedRun, CutOffAnywhereItHasTheCommittedWindows) {
  for (std::size_t size = 0; size < written.bytes.size(); ++size) {
    const std::string bytes = written.bytes.substr(0, size);
    if (size < written.commits.front()) {
      EXPECT_THROW(read_run(bytes), InputError) << size;
      continue;
    }
    const ReadRun read = read_run(bytes);
    ASSERT_TRUE(is_beginning(read, whole)) << size;
    const std::size_t windows = size < written.commits[1] ? 0 : 1;
    ASSERT_EQ(read.windows.size(), windows) << size;
    ASSERT_EQ(read.open_window,
              size == written.commits[windows] ? std::nullopt : std::optional(written.commits[windows]));
  }
}

TEST_P(DamagedRun, ZerosInPlaceOfTheLastWindowAreAnOpenOne) {
  std::string bytes = written.bytes;
  std::fill(bytes.begin() + static_cast<std::ptrdiff_t>(written.commits[1]), bytes.end(), '\0');
  const ReadRun read = read_run(bytes);
  EXPECT_EQ(read.windows.size(), 1u);
  EXPECT_EQ(read.open_window, written.commits[1]);
}

TEST_P(DamagedRun, WhatFollowsTheLastCommitMayBeAnything) {
  const ReadRun read = read_run(written.bytes + "anything at all, longer than a block");
  EXPECT_EQ(read.windows.size(), 2u);
  EXPECT_EQ(read.open_window, written.bytes.size());
}

TEST(RunDamage, AHugeLengthAllocatesNothing) {
  MemoryFile file;
  const SampleRun run = sample_run(3, RecordMode::full, 1);
  RunWriter writer(sink_to(file), run.scene);
  const std::size_t committed = file.bytes.size();
  file.bytes += block_format::block_header(run_kind::window, std::uint64_t{1} << 60);
  EXPECT_EQ(read_run(file.bytes).open_window, committed);
  file.bytes.resize(committed);
  file.bytes += block_format::block_header(run_kind::window, std::numeric_limits<std::uint64_t>::max());
  EXPECT_EQ(read_run(file.bytes).open_window, committed);
}

template <class T>
void set(Block& block, std::size_t offset, T value) {
  std::string bytes;
  put(bytes, value);
  block.payload.replace(offset, bytes.size(), bytes);
}

// Blocks of the sample: HEAD MESH LABL CMIT, then WIND LINE VELO STAT CMIT (full) or WIND HASH FRAM.. ENDP VELO STAT
// CMIT.
constexpr std::size_t head = 0, mesh_block = 1, labels = 2, first_window = 4, second_window = 9;

struct Spoiled {
  const char* name;
  RecordMode record;
  void (*change)(std::vector<Block>&);
  std::string message;  ///< the error message after the place
  friend void PrintTo(const Spoiled& spoiled, std::ostream* out) { *out << spoiled.name; }
};

constexpr RecordMode full = RecordMode::full, frames = RecordMode::frames;
const double infinity = std::numeric_limits<double>::infinity();
using Blocks = std::vector<Block>;

const Spoiled spoiled_runs[] = {
    {"dimension", full, [](Blocks& b) { set(b[head], 0, 4u); }, "byte 28: dimension 4; expected 2 or 3"},
    {"record", full, [](Blocks& b) { set(b[head], 4, 2u); }, "byte 32: record mode 2; expected 0 (full) or 1 (frames)"},
    {"window_length", full, [](Blocks& b) { set(b[head], 8, 0.0); }, "byte 36: window length 0; expected more than 0"},
    {"window_length_nan", full, [](Blocks& b) { set(b[head], 8, infinity); },
     "byte 36: expected a finite window length, found inf"},
    {"head_too_long", full, [](Blocks& b) { b[head].payload += '\0'; },
     "byte 44: expected the end of the block, found 1 more bytes"},
    {"head_too_short", full, [](Blocks& b) { b[head].payload.pop_back(); },
     "byte 36: the block ends within a value: expected 8 bytes, found 7"},
    {"no_head", full, [](Blocks& b) { b.erase(b.begin()); }, "byte 16: expected block 'HEAD', found 'MESH'"},
    {"no_vertices", full, [](Blocks& b) { set(b[mesh_block], 0, std::uint64_t{0}); },
     "byte 84: a mesh of 0 vertices; expected 1 to 4294967296"},
    {"too_many_faces", full, [](Blocks& b) { set(b[mesh_block], 8, std::uint64_t{1} << 62); },
     "byte 84: more cells than the block has bytes"},
    {"one_face_more", full, [](Blocks& b) { set(b[mesh_block], 8, std::uint64_t{2}); },
     "byte 92: expected the vertices of all cells, 9 of 4 bytes each, found 24 bytes"},
    {"face_beyond", full, [](Blocks& b) { set(b[mesh_block], 36, 6u); }, "byte 92: vertex 6 of 6"},
    {"point_beyond", full, [](Blocks& b) { set(b[mesh_block], 52, 0xffffffffu); }, "byte 112: vertex 4294967295 of 6"},
    {"label", full, [](Blocks& b) { b[labels].payload[2] = 2; }, "byte 134: the label 2 is not known; expected 0 or 1"},
    {"label_missing", full, [](Blocks& b) { b[labels].payload.pop_back(); },
     "byte 132: expected the labels of all vertices, 6 of 1 bytes each, found 5 bytes"},
    {"window_index", full, [](Blocks& b) { set(b[second_window], 0, std::uint64_t{2}); },
     "byte 1349: window 3 where window 2 was expected"},
    {"window_left_out", full, [](Blocks& b) { b.erase(b.begin() + 4, b.begin() + 9); },
     "byte 230: window 2 where window 1 was expected"},
    {"window_backwards", full, [](Blocks& b) { set(b[first_window], 16, 0.0); }, "byte 258: a window from 0 to 0"},
    {"window_time", full, [](Blocks& b) { set(b[second_window], 8, 0.125); },
     "byte 1349: the window begins at 0.125, but the one before ends at 0.25"},
    {"window_time_sign", full, [](Blocks& b) { set(b[first_window], 8, -0.0); },
     "byte 270: world lines from 0 to 0.25 in a window from -0 to 0.25"},
    {"lines_other_kind", full, [](Blocks& b) { b[first_window + 1].kind = run_kind::lines_hash; },
     "byte 270: expected block 'LINE', found 'HASH'"},
    {"lines_counts", full, [](Blocks& b) { set(b[first_window + 1], 0, 0xffffffffu); },
     "byte 306: expected times and positions of all breakpoints, 4294967314 of 32 bytes each, found 768 bytes"},
    {"lines_empty", full, [](Blocks& b) { b[first_window + 1].payload.clear(); },
     "byte 282: 0 bytes cannot hold the counts of 6 vertices"},
    {"lines_nan", full,
     [](Blocks& b) { set(b[first_window + 1], b[first_window + 1].payload.size() - 8, std::nan("")); },
     "byte 282: vertex 5, breakpoint 3: expected a finite coordinate, found nan"},
    {"position_differs", full,
     [](Blocks& b) {
       Block& lines = b[second_window + 1];
       const auto breakpoints = (lines.payload.size() - 24) / 32;
       set(lines, 24 + 8 * breakpoints, get<double>(lines.payload.data() + 24 + 8 * breakpoints) + 0x1p-40);
     },
     "byte 1389: vertex 0 begins at (7.1428571428580554, 82.857142857142861, -6.7142857142857153), but the window "
     "before left it at (7.1428571428571459, 82.857142857142861, -6.7142857142857153)"},
    {"velocity_infinite", full, [](Blocks& b) { set(b[first_window + 2], 32, infinity); },
     "byte 1090: vertex 1: expected a finite coordinate, found inf"},
    {"velocity_missing", full, [](Blocks& b) { b[first_window + 2].payload.resize(120); },
     "byte 1090: expected the vectors of all vertices, 6 of 24 bytes each, found 120 bytes"},
    {"two_states", full, [](Blocks& b) { b.insert(b.begin() + 8, b[7]); },
     "byte 1261: expected block 'CMIT', found 'STAT'"},
    {"commit_early", full, [](Blocks& b) { b.erase(b.begin() + 7); }, "byte 1238: expected block 'STAT', found 'CMIT'"},
    {"frame_late", frames, [](Blocks& b) { set(b[first_window + 4], 0, 0.5); },
     "byte 326: a frame at 0.5 in a window from 0 to 0.25, after 0.125"},
    {"frame_again", frames, [](Blocks& b) { set(b[first_window + 3], 0, 0.0); },
     "byte 326: a frame at 0 in a window from 0 to 0.25, after 0"},
    {"frame_elsewhere", frames, [](Blocks& b) { set(b[first_window + 4], 8, 1e9); },
     "byte 326: the frame at the window's end has other positions than the end"},
    {"frame_too_short", frames, [](Blocks& b) { b[first_window + 4].payload.resize(9); },
     "byte 682: expected the vectors of all vertices, 6 of 24 bytes each, found 1 bytes"},
    {"hash_too_short", frames, [](Blocks& b) { b[first_window + 1].payload.pop_back(); },
     "byte 290: expected the bytes of a hash, 32 of 1 bytes each, found 31 bytes"},
    {"ends_twice", frames, [](Blocks& b) { b.insert(b.begin() + 9, b[9]); },
     "byte 990: expected block 'VELO', found 'ENDP'"},
};

class SpoiledRun : public ::testing::TestWithParam<Spoiled> {};
INSTANTIATE_TEST_SUITE_P(All, SpoiledRun, ::testing::ValuesIn(spoiled_runs),
                         [](const auto& spoiled) { return spoiled.param.name; });

TEST_P(SpoiledRun, SaysWhatAndWhere) {
  const std::string bytes = write_run(sample_run(3, GetParam().record, 2)).bytes;
  ASSERT_EQ(changed(bytes, [](Blocks&) {}), bytes);
  const std::string spoiled = changed(bytes, GetParam().change);
  EXPECT_EQ(input_error([&] { read_run(spoiled); }), "run: " + GetParam().message);
}

struct SpoiledExclusions {
  const char* name;
  void (*change)(std::string& payload);
  std::string message;
  friend void PrintTo(const SpoiledExclusions& spoiled, std::ostream* out) { *out << spoiled.name; }
};

class SpoiledExclusion : public ::testing::TestWithParam<SpoiledExclusions> {};
INSTANTIATE_TEST_SUITE_P(
    All, SpoiledExclusion,
    ::testing::Values(
        SpoiledExclusions{"none", [](std::string& p) { p[0] = 0; }, "no pairs of groups; expected at least one"},
        SpoiledExclusions{"many", [](std::string& p) { p[3] = '\x7f'; }, "expected pairs of groups and the groups"},
        SpoiledExclusions{"backwards", [](std::string& p) { p[4] = 9; },
                          "the pair of groups 9 and 7; expected ascending"},
        SpoiledExclusions{"twice", [](std::string& p) { p[8] = 0; }, "the pair of groups 0 and 7; expected ascending"},
        SpoiledExclusions{"vertex", [](std::string& p) { p.resize(p.size() - 2); }, "expected pairs of groups and the"},
        SpoiledExclusions{"cell", [](std::string& p) { p[12] = 3; }, "a cell of two groups; expected cells of one"}),
    [](const auto& spoiled) { return spoiled.param.name; });

TEST_P(SpoiledExclusion, SaysWhatAndWhere) {
  SampleRun run = sample_run(3, RecordMode::full, 1);
  run.scene.exclusions = sample_exclusions();
  const std::string bytes = write_run(run).bytes;
  const std::string spoiled = changed(bytes, [](Blocks& blocks) { GetParam().change(blocks[3].payload); });
  const std::string error = input_error([&] { read_run(spoiled); });
  EXPECT_NE(error.find("run: byte "), std::string::npos) << error;
  EXPECT_NE(error.find(GetParam().message), std::string::npos) << error;
}

}  // namespace
}  // namespace noli
