// SPDX-License-Identifier: Apache-2.0
#include "trajectory/blocks/run_file.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "run_samples.h"
#include "support.h"

namespace noli {
namespace {

using namespace noli::testing;

void expect_same_lines(const WorldLines& a, const WorldLines& b) {
  ASSERT_EQ(a.vertex_count(), b.vertex_count());
  for (VertexId v = 0; v < a.vertex_count(); ++v) {
    EXPECT_TRUE(std::equal(a.times(v).begin(), a.times(v).end(), b.times(v).begin(), b.times(v).end())) << v;
    EXPECT_EQ(bits({a.positions(v).begin(), a.positions(v).end()}),
              bits({b.positions(v).begin(), b.positions(v).end()}));
  }
}

void expect_same(const OwnWindow& written, const RunWindow& read, const RunHeader& header) {
  EXPECT_EQ(read.index, written.index);
  EXPECT_EQ(read.begin, written.lines.first_time());
  EXPECT_EQ(read.end, written.lines.last_time());
  EXPECT_EQ(bits(read.positions), bits(ends_of(written.lines)));
  EXPECT_EQ(bits(read.velocities), bits(written.velocities));
  EXPECT_EQ(read.state, written.state);
  EXPECT_EQ(read.frames, written.frames);
  ASSERT_EQ(read.lines.has_value(), header.record == RecordMode::full);
  if (read.lines) {
    expect_same_lines(*read.lines, written.lines);
  } else {
    EXPECT_EQ(read.lines_hash, lines_hash(header.dimension, written.lines));
  }
}

struct Kind {
  std::uint32_t dimension;
  RecordMode record;
};
void PrintTo(const Kind& kind, std::ostream* out) {
  *out << kind.dimension << "D " << (kind.record == RecordMode::full ? "full" : "frames");
}

class RunFile : public ::testing::TestWithParam<Kind> {
 protected:
  SampleRun run(std::size_t windows) const { return sample_run(GetParam().dimension, GetParam().record, windows); }
};
INSTANTIATE_TEST_SUITE_P(All, RunFile,
                         ::testing::Values(Kind{2, RecordMode::full}, Kind{3, RecordMode::full},
                                           Kind{2, RecordMode::frames}, Kind{3, RecordMode::frames}));

TEST_P(RunFile, IsReadBackBitForBit) {
  const SampleRun written = run(4);
  const ReadRun read = read_run(write_run(written).bytes);
  EXPECT_EQ(read.scene, written.scene);
  EXPECT_EQ(read.open_window, std::nullopt);
  ASSERT_EQ(read.windows.size(), 4u);
  for (std::size_t k = 0; k < 4; ++k) expect_same(written.windows[k], read.windows[k], written.scene.header);
}

TEST_P(RunFile, KeepsWhatIsExcluded) {
  SampleRun written = run(1);
  written.scene.exclusions = sample_exclusions();
  const ReadRun read = read_run(write_run(written).bytes);
  EXPECT_EQ(read.scene, written.scene);
  EXPECT_TRUE(read.scene.exclusions.excluded(7, 0));
  EXPECT_FALSE(read.scene.exclusions.excluded(2, 7));
  EXPECT_EQ(read.windows.size(), 1u);
}

TEST_P(RunFile, MayHaveNoWindows) {
  const ReadRun read = read_run(write_run(run(0)).bytes);
  EXPECT_TRUE(read.windows.empty());
  EXPECT_EQ(read.open_window, std::nullopt);
}

TEST_P(RunFile, IsReadFromAnyWindowOn) {
  const SampleRun written = run(4);
  const std::string bytes = write_run(written).bytes;
  for (std::uint64_t read = 0; read < 4; ++read) {
    for (std::uint64_t first = read; first < 4; ++first) {
      RunReader reader(bytes, "run"), all(bytes, "run");
      for (std::uint64_t k = 0; k < read; ++k) ASSERT_TRUE(reader.next_window());
      reader.skip_to(first);
      EXPECT_EQ(reader.windows(), first);
      for (std::uint64_t k = 0; k < first; ++k) ASSERT_TRUE(all.next_window());
      EXPECT_EQ(reader.running_hash(), all.running_hash());
      EXPECT_EQ(reader.committed(), all.committed());
      for (std::uint64_t k = first; k < 4; ++k)
        expect_same(written.windows[k], *reader.next_window(), written.scene.header);
      EXPECT_FALSE(reader.next_window());
    }
  }
}

TEST_P(RunFile, ADamagedWindowIsNotPassedOver) {
  const WrittenRun whole = write_run(run(3));
  int noticed = 0;
  for (std::size_t at = whole.commits[1] - 20; at < whole.commits[2]; ++at) {
    std::string bytes = whole.bytes;
    bytes[at] = static_cast<char>(bytes[at] ^ 0x40);
    try {
      RunReader reader(bytes, "run");
      reader.skip_to(3);
    } catch (const InputError& error) {
      EXPECT_TRUE(std::string(error.what()).starts_with("run: byte ")) << at << error.what();
      ++noticed;
    }
  }
  EXPECT_GE(noticed, 100) << "headers and commits are looked at";
  std::string torn = whole.bytes;
  torn[whole.commits[1] - 1] ^= 1;  // the checksum of a commit
  EXPECT_NE(input_error([&] { RunReader(torn, "run").skip_to(3); }).find("damaged: committed blocks follow"),
            std::string::npos);
}

TEST(RunFileInAFolder, IsPassedOverWhileItGrows) {
  const test::TemporaryFolder folder;
  const SampleRun run = sample_run(3, RecordMode::full, 3);
  RunWriter writer(folder.path(), run.scene);
  RunReader reader(folder.path());
  for (const OwnWindow& window : run.windows) {
    EXPECT_FALSE(reader.skip_window());
    writer.append_window(window.to_write());
    reader.look_again();
    EXPECT_FALSE(reader.skip_window());
    writer.commit();
    reader.look_again();
    EXPECT_TRUE(reader.skip_window());
    EXPECT_EQ(reader.running_hash(), writer.running_hash());
    RunReader other(folder.path());
    other.skip_to(reader.committed());
    EXPECT_EQ(other.windows(), writer.windows());
  }
}

TEST_P(RunFile, HasNoWindowBehindItsEnd) {
  const WrittenRun whole = write_run(run(3));
  for (std::size_t kept = whole.commits[2]; kept < whole.bytes.size(); ++kept) {
    RunReader reader(whole.bytes.substr(0, kept), "run");
    EXPECT_EQ(input_error([&] { reader.skip_to(3); }), "run: ends before window 4") << kept;
    EXPECT_EQ(reader.windows(), 2u);
    EXPECT_FALSE(reader.next_window());
  }
  RunReader reader(whole.bytes, "run");
  reader.skip_to(3);
  EXPECT_FALSE(reader.next_window());
  RunReader known(whole.bytes, "run");
  known.expect({2, Sha256Digest{}, false});
  EXPECT_NE(input_error([&] { known.skip_to(3); }).find("has running hash"), std::string::npos);
}

TEST_P(RunFile, ResumedAnywhereHasTheSameBytes) {
  const SampleRun written = run(3);
  const WrittenRun whole = write_run(written);
  for (std::size_t kept = whole.commits.front(); kept <= whole.bytes.size(); ++kept) {
    MemoryFile file{whole.bytes.substr(0, kept), std::string::npos, {}};
    RunReader reader(file.bytes, "run");
    while (reader.next_window()) {
    }
    RunWriter writer(sink_to(file), reader);
    for (std::size_t k = writer.windows(); k < 3; ++k) append(writer, written.windows[k]);
    ASSERT_EQ(file.bytes, whole.bytes) << "cut off after " << kept;
  }
}

TEST_P(RunFile, AWindowTakenBackLeavesNoTrace) {
  const SampleRun written = run(2), other = sample_run(GetParam().dimension, GetParam().record, 1, 2);
  MemoryFile file;
  RunWriter writer(sink_to(file), written.scene);
  writer.append_window(other.windows[0].to_write());
  writer.discard_window();
  append(writer, written.windows[0]);
  writer.append_window(written.windows[1].to_write());
  writer.discard_window();
  append(writer, written.windows[1]);
  EXPECT_EQ(file.bytes, write_run(written).bytes);
}

TEST_P(RunFile, AFullDiskLeavesTheCommittedWindows) {
  const SampleRun written = run(3);
  const WrittenRun whole = write_run(written);
  for (std::size_t capacity = whole.commits[1]; capacity < whole.bytes.size(); ++capacity) {
    MemoryFile file{{}, capacity, {}};
    RunWriter writer(sink_to(file), written.scene);
    std::size_t committed = 0;
    EXPECT_THROW(for (; committed < 3; ++committed) append(writer, written.windows[committed]), std::system_error);
    const ReadRun read = read_run(file.bytes);
    ASSERT_EQ(read.windows.size(), committed);
    for (std::size_t k = 0; k < committed; ++k) expect_same(written.windows[k], read.windows[k], written.scene.header);
    EXPECT_EQ(read.open_window.has_value(), capacity != whole.commits[committed]);
  }
}

TEST(RunFileOrder, ACommitIsWrittenWhenItsWindowIsOnTheDisk) {
  const WrittenRun whole = write_run(sample_run(3, RecordMode::full, 2));
  MemoryFile file;
  const SampleRun run = sample_run(3, RecordMode::full, 2);
  RunWriter writer(sink_to(file), run.scene);
  for (const OwnWindow& window : run.windows) append(writer, window);
  std::vector<std::size_t> expected;
  for (const std::size_t end : whole.commits) expected.insert(expected.end(), {end - block_format::commit_size, end});
  EXPECT_EQ(file.synced, expected);
}

TEST(RunFileInAFolder, IsWrittenReadAndResumed) {
  const test::TemporaryFolder folder;
  const SampleRun run = sample_run(3, RecordMode::full, 3);
  {
    RunWriter writer(folder.path(), run.scene);
    append(writer, run.windows[0]);
    writer.append_window(run.windows[1].to_write());
  }
  RunReader reader(folder.path());
  EXPECT_TRUE(reader.next_window());
  EXPECT_FALSE(reader.next_window());
  ASSERT_TRUE(reader.open_window());
  EXPECT_EQ(reader.open_window_message(), trajectory_path(folder.path()).string() +
                                              ": ends in an open window at byte " +
                                              std::to_string(*reader.open_window()));
  {
    RunWriter writer(folder.path(), reader);
    EXPECT_EQ(writer.windows(), 1u);
    append(writer, run.windows[1]);
    append(writer, run.windows[2]);
  }
  EXPECT_EQ(test::read_text(trajectory_path(folder.path())), write_run(run).bytes);
}

/// The writer may discard uncommitted windows while the run is read.
TEST(RunFileInAFolder, IsReadWhileItGrows) {
  const test::TemporaryFolder folder;
  const SampleRun run = sample_run(3, RecordMode::full, 3);
  RunWriter writer(folder.path(), run.scene);
  RunReader reader(folder.path());
  for (const OwnWindow& window : run.windows) {
    writer.append_window(window.to_write());
    reader.look_again();
    EXPECT_FALSE(reader.next_window());
    writer.discard_window();
    append(writer, window);
    reader.look_again();
    const auto read = reader.next_window();
    ASSERT_TRUE(read);
    expect_same(window, *read, run.scene.header);
    EXPECT_EQ(reader.running_hash(), writer.running_hash());
    EXPECT_FALSE(reader.next_window());
  }
  std::filesystem::resize_file(trajectory_path(folder.path()), 100);
  EXPECT_NE(input_error([&] { reader.look_again(); }).find("has lost what was committed"), std::string::npos);
}

std::string error_of_reading(const std::string& bytes, const KnownWindows& known) {
  return input_error([&] {
    RunReader reader(bytes, "run");
    reader.expect(known);
    while (reader.next_window()) {
    }
  });
}

std::string error_of_a_look(const std::string& bytes, const KnownWindows& known) {
  return input_error([&] {
    RunReader reader(bytes, "run");
    reader.expect(known);
    reader.look_for_expected();
  });
}

bool reads(const std::string& bytes, const KnownWindows& known) {
  RunReader reader(bytes, "run");
  reader.expect(known);
  reader.look_for_expected();
  while (reader.next_window()) {
  }
  return reader.windows() <= 3;
}

TEST(RunFileInAFolder, HasWhatIsKnownOfIt) {
  const SampleRun run = sample_run(3, RecordMode::full, 3);
  const std::string bytes = write_run(run).bytes;
  RunReader reader(bytes, "run");
  for (std::uint64_t count = 0; count <= 3; ++count) {
    const Sha256Digest running = reader.running_hash();
    EXPECT_TRUE(reads(bytes, {count, running, false}));
    EXPECT_TRUE(reads(bytes, {count, std::nullopt, false}));
    const std::string other = "has running hash " + hex(running) + "; expected " + hex(sha256("other"));
    const KnownWindows wrong{count, sha256("other"), true};
    EXPECT_NE(error_of_reading(bytes, wrong).find(other), std::string::npos) << count;
    EXPECT_NE(error_of_a_look(bytes, wrong).find(other), std::string::npos) << count;
    EXPECT_EQ(reader.next_window().has_value(), count < 3);
  }
  const std::string missing = "run: windows are missing: it has 3, the log lists 4";
  EXPECT_EQ(error_of_reading(bytes, {4, std::nullopt, false}), missing);
  EXPECT_EQ(error_of_a_look(bytes, {4, std::nullopt, false}), missing);
  EXPECT_TRUE(reads(bytes, {4, sha256("other"), true})) << "it is made again";
}

TEST(RunFileInAFolder, IsNotMadeTwice) {
  const test::TemporaryFolder folder;
  const SampleRun run = sample_run(3, RecordMode::full, 1);
  const RunWriter writer(folder.path(), run.scene);
  EXPECT_THROW(RunWriter(folder.path(), run.scene), std::system_error);
  EXPECT_THROW(RunWriter(folder / "absent", run.scene), std::system_error);
}

TEST(RunFileInAFolder, IsWrittenByOneAtATime) {
  const test::TemporaryFolder folder;
  const RunWriter writer(folder.path(), sample_run(3, RecordMode::full, 0).scene);
  RunReader reader(folder.path());
  EXPECT_FALSE(reader.next_window());
  try {
    const RunWriter second(folder.path(), reader);
    ADD_FAILURE() << "a second writer was let in";
  } catch (const std::system_error& error) {
    EXPECT_NE(std::string(error.what()).find("is being written by another process"), std::string::npos) << error.what();
  }
}

/// A scene and a matching window, to be made invalid.
struct Attempt {
  RunScene scene = sample_run(2, RecordMode::frames, 0).scene;
  OwnWindow window = sample_run(2, RecordMode::frames, 1).windows[0];
};

struct Refused {
  const char* name;
  void (*spoil)(Attempt&);
  std::string problem;
  friend void PrintTo(const Refused& refused, std::ostream* out) { *out << refused.name; }
};

const Refused refused[] = {
    {"dimension", [](Attempt& a) { a.scene.header.dimension = 1; }, "the dimension is neither 2 nor 3"},
    {"window_length", [](Attempt& a) { a.scene.header.window_length = 0; }, "the window length is not positive"},
    {"labels", [](Attempt& a) { a.scene.labels.pop_back(); }, "not one label for each vertex"},
    {"label", [](Attempt& a) { a.scene.labels[1] = 2; }, "a label that is not known"},
    {"groups",
     [](Attempt& a) {
       a.scene.exclusions = {{0, 0, 0, 1, 1}, {{0, 1}}};
     },
     "not one group for each vertex"},
    {"cell_of_two_groups",
     [](Attempt& a) {
       a.scene.exclusions = {{0, 0, 1, 1, 1, 1}, {{0, 1}}};
     },
     "a cell of two groups"},
    {"face", [](Attempt& a) { a.scene.mesh.faces[0][2] = 6; }, "a face beyond the mesh"},
    {"edge", [](Attempt& a) { a.scene.mesh.edges[0][0] = 6; }, "an edge beyond the mesh"},
    {"point", [](Attempt& a) { a.scene.mesh.points[0] = 6; }, "a point beyond the mesh"},
    {"index", [](Attempt& a) { a.window.index = 1; }, "window 2 where 1 is due"},
    {"velocities", [](Attempt& a) { a.window.velocities.pop_back(); },
     "not a world line and a velocity for each vertex"},
    {"infinite", [](Attempt& a) { a.window.velocities[1][0] = HUGE_VAL; },
     "a velocity is not finite or leaves the plane"},
    {"third_coordinate", [](Attempt& a) { a.window.lines = sample_run(3, RecordMode::full, 1).windows[0].lines; },
     "a position leaves the plane"},
    {"minus_zero", [](Attempt& a) { a.window.velocities[1][2] = -0.0; },
     "a velocity is not finite or leaves the plane"},
    {"frame_size", [](Attempt& a) { a.window.frames[0].positions.pop_back(); },
     "a frame without a finite position for each vertex"},
    {"frame_time", [](Attempt& a) { a.window.frames[1].time = 0; }, "a frame at 0 in a window from 0 to 0.25, after 0"},
    {"frames_in_full", [](Attempt& a) { a.scene.header.record = RecordMode::full; }, "frames in a full record"},
};

class RunWriterRefuses : public ::testing::TestWithParam<Refused> {};
INSTANTIATE_TEST_SUITE_P(All, RunWriterRefuses, ::testing::ValuesIn(refused),
                         [](const auto& r) { return r.param.name; });

TEST_P(RunWriterRefuses, WhatItCouldNotReadBack) {
  Attempt attempt;
  GetParam().spoil(attempt);
  MemoryFile file;
  try {
    RunWriter writer(sink_to(file), attempt.scene);
    append(writer, attempt.window);
    ADD_FAILURE() << "it was written";
  } catch (const std::logic_error& error) {
    EXPECT_EQ(error.what(), "what was to be written to a run: " + GetParam().problem);
  }
}

TEST(RunWriterRefusesWindows, ThatDoNotFollowBitForBit) {
  const SampleRun run = sample_run(3, RecordMode::full, 2), other = sample_run(3, RecordMode::full, 2, 5);
  MemoryFile file;
  RunWriter writer(sink_to(file), run.scene);
  EXPECT_THROW(writer.commit(), std::logic_error);
  append(writer, run.windows[0]);
  const std::string committed = file.bytes;
  EXPECT_THROW(writer.append_window(other.windows[1].to_write()), std::logic_error) << "positions";
  OwnWindow late = run.windows[0];
  late.index = 1;
  EXPECT_THROW(writer.append_window(late.to_write()), std::logic_error) << "times";
  EXPECT_EQ(file.bytes, committed) << "what is refused is refused before any of it is written";
  append(writer, run.windows[1]);
  EXPECT_EQ(file.bytes, write_run(run).bytes);
}

}  // namespace
}  // namespace noli
