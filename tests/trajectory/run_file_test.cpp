// SPDX-License-Identifier: Apache-2.0
#include "noli/trajectory/run_file.h"

#include <gtest/gtest.h>

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

TEST_P(RunFile, MayHaveNoWindows) {
  const ReadRun read = read_run(write_run(run(0)).bytes);
  EXPECT_TRUE(read.windows.empty());
  EXPECT_EQ(read.open_window, std::nullopt);
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

}  // namespace
}  // namespace noli
