// SPDX-License-Identifier: Apache-2.0
//
// Reads and writes the motion of a run: `trajectory.blocks` in its folder. FORMAT.md has the bytes; they depend only on
// what is passed in here.
//
// Notation
//   window k       the motion from begin to end, k = 0, 1, ...; it begins where the previous one ended, bit for bit, in
//                  time and in every position. Messages count windows from 1
//   record full    every world line is kept
//   record frames  each window keeps only the hash of its world lines, its frames, and the state at its end, from which
//                  the next one can be computed again
//
// Nothing here looks for contact: verify windows before you write them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <noli/mesh.h>
#include "trajectory/blocks/block_file.h"
#include "trajectory/world_lines.h"

namespace noli {

enum class RecordMode : std::uint32_t { full = 0, frames = 1 };

/// A vertex label is a set of bits; more may come with later versions. This version refuses all others, so
/// that a label is 0 or 1 and can be taken for a flag.
inline constexpr std::uint8_t scripted_vertex = 1;

struct RunHeader {
  std::uint32_t dimension = 3;  ///< 2 or 3; in 2 every z is +0, and no z is stored
  RecordMode record = RecordMode::full;
  double window_length = 0;  ///< seconds, positive; windows end at its multiples, or before

  friend bool operator==(const RunHeader&, const RunHeader&) = default;
};

/// What does not change during a run.
struct RunScene {
  RunHeader header;
  Mesh mesh;
  std::vector<std::uint8_t> labels;  ///< one per vertex
  Exclusions exclusions;

  friend bool operator==(const RunScene&, const RunScene&) = default;
};

struct RunFrame {
  double time = 0;
  std::vector<Position> positions;  ///< one per vertex

  friend bool operator==(const RunFrame&, const RunFrame&) = default;
};

/// A window to be written. A run goes on from its velocities [m/s] and from `state`, bytes that only their writer
/// understands.
struct WindowToWrite {
  std::uint64_t index = 0;
  const WorldLines& lines;
  std::span<const Position> velocities;
  std::string_view state = {};
  std::span<const RunFrame> frames = {};  ///< with record frames: those within the window, in ascending order of time
};

/// A window as read.
struct RunWindow {
  std::uint64_t index = 0;
  double begin = 0, end = 0;
  std::optional<WorldLines> lines;  ///< with record full
  std::uint64_t breakpoints = 0;    ///< of all its world lines
  Sha256Digest lines_hash{};        ///< with record frames: of the block LINE that record full would have written
  std::vector<RunFrame> frames;     ///< with record frames
  std::vector<Position> positions;  ///< at its end
  std::vector<Position> velocities;
  std::string state;
  Sha256Digest group_hash{};  ///< of its group in the file
};

/// The end of a window.
struct WindowEnd {
  double time = 0;
  std::vector<Position> positions;  ///< one per vertex
};

/// The file in the folder of a run.
std::filesystem::path trajectory_path(const std::filesystem::path& run_folder);

/// The block LINE, from its kind to its checksum, that record full writes for these world lines, part by part; and its
/// SHA-256.
void put_lines_block(std::uint32_t dimension, const WorldLines& lines, const ByteConsumer& consumer);
Sha256Digest lines_hash(std::uint32_t dimension, const WorldLines& lines);

/// What is known about the windows of a run from elsewhere, such as its log.
struct KnownWindows {
  std::uint64_t count = 0;
  std::optional<Sha256Digest> running;  ///< the running hash after the last of them
  bool made_again = false;              ///< the reader makes missing windows again
};

/// How many windows a run appears to have, and until when.
struct RunLook {
  std::uint64_t windows = 0;
  std::optional<double> end;  ///< [s]; empty if there is no window, or the last one is damaged
};

class RunReader;

/// Writes a run. In memory: the positions at the end of one window.
///   RunWriter writer(folder, scene);
///   writer.append_window({.index = 0, .lines = lines, .velocities = velocities});
///   writer.commit();
class RunWriter {
 public:
  /// Creates trajectory.blocks in an existing folder that has none, and commits the scene. Throws std::system_error
  /// when writing fails, std::logic_error when the scene breaks what RunScene requires.
  RunWriter(const std::filesystem::path& folder, const RunScene& scene);
  /// The same into a sink.
  RunWriter(std::unique_ptr<Sink> sink, const RunScene& scene);

  /// Goes on after the last committed window, and cuts off what follows. Precondition: reader.next_window() returned
  /// nothing. Throws std::system_error.
  RunWriter(const std::filesystem::path& folder, const RunReader& reader);
  RunWriter(std::unique_ptr<Sink> sink, const RunReader& reader);

  /// Writes a window, which does not count before commit(). Throws std::system_error, and std::logic_error when the
  /// window does not continue the last committed one bit for bit, or sizes do not fit. After a std::system_error
  /// nothing more may be written; committed windows stay.
  void append_window(const WindowToWrite& window);
  /// Commits the last window written; from then on it survives a loss of power.
  void commit();
  /// The hash that commit() will write for the window that was written.
  Sha256Digest open_window_hash() const { return blocks_.open_group_hash(); }
  /// Drops the window that was written and not committed.
  void discard_window();

  /// Number of committed windows.
  std::uint64_t windows() const { return blocks_.committed().groups - 1; }
  /// Hash of everything committed.
  const Sha256Digest& running_hash() const { return blocks_.committed().running; }

 private:
  void check(const WindowToWrite& window) const;
  void append_frames(const WindowToWrite& window, const WindowEnd& end);

  BlockWriter blocks_;
  RunHeader header_;
  std::size_t vertex_count_;
  std::optional<WindowEnd> last_, open_;  ///< of the last committed window; of the one written but not committed
};

/// Reads a run, one window at a time.
///   RunReader reader(folder);
///   while (auto window = reader.next_window()) use(*window);
///   if (reader.open_window()) ...
class RunReader {
 public:
  /// Throws InputError: no such file, no block file about a trajectory, a header or mesh that is damaged or not
  /// complete.
  explicit RunReader(const std::filesystem::path& folder);
  /// The same for bytes in memory; `name` is what errors call them.
  RunReader(std::string bytes, std::string name);

  const RunHeader& header() const { return scene_.header; }
  const Mesh& mesh() const { return scene_.mesh; }
  const RunScene& scene() const { return scene_; }

  /// The next committed window; nothing when there is none. Throws InputError, with the place in the file, when
  /// anything in it breaks FORMAT.md, or it does not begin where the previous one ended. After an error only
  /// look_again() may be called.
  std::optional<RunWindow> next_window();

  /// Makes `window` the one that next_window() gives, without reading those before it: that it begins where the one
  /// before ended is then not checked, nor are the hashes of what was skipped. Precondition: windows() <= window.
  /// Throws InputError when the file has fewer windows.
  void skip_to(std::uint64_t window);
  /// Skips the next window alone, with as few checks. Returns false at the end of the run.
  bool skip_window();
  /// The same for all windows up to this commit, which committed() of another reader of the run gave. Throws InputError
  /// when the file is too short now.
  void skip_to(const CommitPoint& commit);

  /// After next_window() returned nothing: where a window begins that was never committed, if there is one. That is not
  /// an error, but tell the user with open_window_message().
  std::optional<std::uint64_t> open_window() const { return blocks_.open_group(); }
  /// "FILE: ends in an open window at byte N". Precondition: open_window().
  std::string open_window_message() const;

  /// From now on next_window() also throws InputError when the file ends before it has these windows, or has another
  /// hash after the last of them; so does this function if that window was read last.
  void expect(const KnownWindows& known);
  /// Throws what next_window() would, as far as a quick look can tell. It reads no window and checks no checksum.
  void look_for_expected();

  /// After next_window() returned nothing, or threw because the run was being written: goes on with the file as it is
  /// now. Throws InputError when it has become shorter than what was read.
  void look_again() { blocks_.look_again(); }

  /// How many windows have been read.
  std::uint64_t windows() const { return blocks_.committed().groups - 1; }
  /// A quick look, which reads no world line and checks no hash. next_window() reports damage.
  RunLook look();
  const Sha256Digest& running_hash() const { return blocks_.committed().running; }
  /// The end of the window that was read or skipped last, with its hash.
  const CommitPoint& committed() const { return blocks_.committed(); }

 private:
  friend class RunWriter;
  void read_scene();
  Block scene_block(FourLetters kind, std::optional<FourLetters> or_kind = {});
  std::optional<std::vector<Block>> window_blocks();
  void decode_full(const std::vector<Block>& blocks, RunWindow& window) const;
  void decode_frames(const std::vector<Block>& blocks, RunWindow& window) const;
  void fail(const Block& block, const std::string& problem) const;
  void require_count(std::uint64_t count) const;
  void require_hash(const Sha256Digest& running) const;

  BlockReader blocks_;
  RunScene scene_;
  KnownWindows known_;
  std::optional<WindowEnd> last_;  ///< of the last window that was read
};

}  // namespace noli
