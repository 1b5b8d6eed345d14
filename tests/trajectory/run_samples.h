// SPDX-License-Identifier: Apache-2.0
//
// Helpers for tests of block files and runs: a file in memory that can be full, and random runs made from a seed.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "trajectory/blocks/block_sink.h"
#include "trajectory/blocks/run_file.h"
#include "trajectory/blocks/run_payload.h"

namespace noli::testing {

/// A file in memory; `capacity` is the size of the disk.
struct MemoryFile {
  std::string bytes;
  std::size_t capacity = std::string::npos;
  std::vector<std::size_t> synced;  ///< sizes at which it was synced
};

class MemorySink : public Sink {
 public:
  explicit MemorySink(MemoryFile& file) : file_(file) {}
  void write(std::string_view bytes) override {
    const std::size_t room = file_.capacity - file_.bytes.size();
    file_.bytes += bytes.substr(0, room);
    if (bytes.size() > room) throw std::system_error(ENOSPC, std::generic_category(), "memory");
  }
  void sync() override { file_.synced.push_back(file_.bytes.size()); }
  void truncate(std::uint64_t size) override { file_.bytes.resize(size); }

 private:
  MemoryFile& file_;
};

inline std::unique_ptr<Sink> sink_to(MemoryFile& file) { return std::make_unique<MemorySink>(file); }

/// The file after `change` has edited its blocks, with correct checksums and commits.
inline std::string changed(const std::string& bytes, const std::function<void(std::vector<Block>&)>& change) {
  std::vector<Block> blocks;
  BlockReader reader(bytes, "run", run_kind::content);
  while (auto block = reader.next()) blocks.push_back(std::move(*block));
  change(blocks);
  MemoryFile file;
  BlockWriter writer(sink_to(file), run_kind::content);
  for (const Block& block : blocks) {
    block.kind == block_format::commit ? writer.commit() : writer.append(block.kind, block.payload);
  }
  return file.bytes;
}

/// A window that owns the data it refers to.
struct OwnWindow {
  std::uint64_t index;
  WorldLines lines;
  std::vector<Position> velocities;
  std::string state;
  std::vector<RunFrame> frames;

  WindowToWrite to_write() const {
    return {.index = index, .lines = lines, .velocities = velocities, .state = state, .frames = frames};
  }
};

struct SampleRun {
  RunScene scene;
  std::vector<OwnWindow> windows;
};

/// Positions of all vertices when a window begins.
inline std::vector<Position> random_positions(std::mt19937_64& random, std::size_t count, std::uint32_t dimension) {
  std::vector<Position> all(count);
  for (Position& x : all) {
    for (std::size_t axis = 0; axis < dimension; ++axis) x[axis] = static_cast<double>(random() % 1000) / 7 - 50;
  }
  return all;
}

/// World lines from `begin` to `end` that start at these positions, with up to three breakpoints inside.
inline WorldLines random_lines(std::mt19937_64& random, double begin, double end, const std::vector<Position>& x,
                               std::uint32_t dimension) {
  std::vector<std::size_t> offsets{0};
  std::vector<double> times;
  std::vector<Position> positions;
  for (const Position& first : x) {
    const auto inside = static_cast<int>(random() % 4);
    for (int k = 0; k <= inside + 1; ++k) {
      times.push_back(k == inside + 1 ? end : begin + k * (end - begin) / (inside + 1));
      positions.push_back(k == 0 ? first : random_positions(random, 1, dimension).front());
    }
    offsets.push_back(times.size());
  }
  return WorldLines::from_breakpoints(offsets, times, positions, "sample");
}

inline std::vector<Position> ends_of(const WorldLines& lines) {
  std::vector<Position> all;
  for (VertexId v = 0; v < lines.vertex_count(); ++v) all.push_back(lines.positions(v).back());
  return all;
}

/// Exclusions for the sample: its edge is not compared with its face, nor with itself.
inline Exclusions sample_exclusions() { return {{0, 0, 0, 7, 7, 2}, {{0, 7}, {7, 7}}}; }

/// A run of a face, a loose edge and a loose point, with windows of a quarter second.
inline SampleRun sample_run(std::uint32_t dimension, RecordMode record, std::size_t windows, std::uint64_t seed = 1) {
  std::mt19937_64 random(seed);
  SampleRun run;
  run.scene = {.header = {.dimension = dimension, .record = record, .window_length = 0.25},
               .mesh = {.vertex_count = 6, .faces = {{0, 1, 2}}, .edges = {{3, 4}}, .points = {5}},
               .labels = {0, 0, 0, 1, 1, 0},
               .exclusions = {}};
  std::vector<Position> x = random_positions(random, 6, dimension);
  for (std::size_t k = 0; k < windows; ++k) {
    const double begin = 0.25 * static_cast<double>(k), end = 0.25 * static_cast<double>(k + 1);
    WorldLines lines = random_lines(random, begin, end, x, dimension);
    x = ends_of(lines);
    std::vector<RunFrame> frames;
    if (record == RecordMode::frames) {
      if (k == 0) frames.push_back({begin, random_positions(random, 6, dimension)});
      frames.push_back({begin + 0.125, random_positions(random, 6, dimension)});
      frames.push_back({end, x});
    }
    run.windows.push_back(
        {k, std::move(lines), random_positions(random, 6, dimension), "state " + std::to_string(k), std::move(frames)});
  }
  return run;
}

inline void append(RunWriter& writer, const OwnWindow& window) {
  writer.append_window(window.to_write());
  writer.commit();
}

/// The file of a run, and the end of each commit, the scene's first.
struct WrittenRun {
  std::string bytes;
  std::vector<std::size_t> commits;
};

inline WrittenRun write_run(const SampleRun& run) {
  MemoryFile file;
  WrittenRun written;
  RunWriter writer(sink_to(file), run.scene);
  written.commits.push_back(file.bytes.size());
  for (const OwnWindow& window : run.windows) {
    append(writer, window);
    written.commits.push_back(file.bytes.size());
  }
  written.bytes = file.bytes;
  return written;
}

/// Everything that a reader returns for these bytes.
struct ReadRun {
  RunScene scene;
  std::vector<RunWindow> windows;
  std::optional<std::uint64_t> open_window;
};

inline ReadRun read_run(const std::string& bytes) {
  RunReader reader(bytes, "run");
  ReadRun run{reader.scene(), {}, {}};
  while (auto window = reader.next_window()) run.windows.push_back(std::move(*window));
  run.open_window = reader.open_window();
  return run;
}

}  // namespace noli::testing
