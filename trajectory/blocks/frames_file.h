// SPDX-License-Identifier: Apache-2.0
//
// Frames of one mesh in one block file, for checkers and for whoever wants the numbers of a motion bit for bit.
// FORMAT.md, "A file of frames", has the bytes.
//
//   FramesWriter writer(std::make_unique<FileSink>(path, FileSink::Open::create), mesh);
//   for (const auto& x : frames) writer.append(x);
//   writer.finish();
//
// What this does not do: it is not a run. It has no times, and nobody has verified what is in it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <noli/mesh.h>
#include "trajectory/blocks/block_file.h"

namespace noli {

/// Whether a file begins as a block file does, and as one of frames. False where it cannot be read.
bool begins_as_blocks(const std::filesystem::path& path);
bool is_frames_file(const std::filesystem::path& path);

/// In memory: one frame.
class FramesWriter {
 public:
  /// Throws what the sink throws, as do all functions.
  FramesWriter(std::unique_ptr<Sink> sink, const Mesh& mesh);

  /// The next frame, with a finite position for each vertex.
  void append(std::span<const Position> positions);
  /// Returns when what was written survives a loss of power.
  void finish();

 private:
  class Unsynced;

  std::size_t vertices_;
  Unsynced* sink_;  ///< of blocks_
  BlockWriter blocks_;
  std::uint64_t frames_ = 0;
};

/// In memory: one frame.
class FramesReader {
 public:
  /// Reads the mesh. Throws InputError when the file cannot be read, or is none of frames.
  explicit FramesReader(const std::filesystem::path& path);

  const Mesh& mesh() const { return mesh_; }
  /// How many frames there seem to be, by the headers of blocks.
  std::uint64_t count() const { return count_; }
  /// The next frame; nothing behind the last. Throws InputError for a damaged file, and for one that was cut off.
  std::optional<std::vector<Position>> next();

 private:
  std::optional<Block> read(FourLetters kind);
  void read_commit();

  BlockReader blocks_;
  Mesh mesh_;
  std::uint64_t frames_ = 0, count_ = 0;
};

}  // namespace noli
