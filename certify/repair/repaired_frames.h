// SPDX-License-Identifier: Apache-2.0
//
// Writes the frames of a repaired motion, and beside them a table of which file is which moment. A step is committed by
// its rows in the table, so a repair that was killed can go on behind the last complete step.
//
// Files beside the frames, with the name of the pattern before them ("cloth_times.csv" of "cloth_%03d.ply")
//   times.csv      a row for each frame: file, time in steps, the given frame of that time, what it is: "copied" byte
//                  for byte, "given" (the same numbers), "repaired", "inserted"; and the file's SHA-256
//   changed.jsonl  a line for each step that was changed (changes.h), written before its rows in the table
//   repair.json    a hash of all that decides what is written: the given files, the options, the program
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <noli/repair.h>
#include "certify/frame_files.h"
#include "trajectory/blocks/folder_lock.h"
#include "trajectory/blocks/sha256.h"
#include "trajectory/formats/frame_source.h"

namespace noli {

class RepairedFrames {
 public:
  /// The arguments have to outlive this; the source has been looked at. Throws UsageError where a file exists that may
  /// not be replaced, and where a new file would be one that is read; InputError with `resume`, if the repair that is
  /// there is another one.
  RepairedFrames(const RepairRequest& request, const FrameSource& source);

  struct Last {
    std::size_t step;  ///< so many are done
    std::vector<Position> positions;
    std::vector<std::string> changed;  ///< lines of these steps
  };
  /// With `resume`, where an earlier repair ended; nothing if it has not done a step. `mesh`: that of all frames.
  /// Throws InputError for a frame of another mesh, for one with other bytes than were written, and for a damaged
  /// table.
  std::optional<Last> last(const Mesh& mesh);
  /// Writes the files beside the frames as they are after last(). From now on the repair can be resumed.
  void begin();

  /// SHA-256 of everything that decides what is written: not of threads, limits, proof or checker.
  const Sha256Digest& fingerprint() const { return fingerprint_; }

  /// Throws InputError: this line of the changed steps, from 0, cannot be used.
  [[noreturn]] void fail_changed(std::size_t line) const;

  /// The next frame. `time`: in steps. `given`: it is frame `time` as given, and gets the bytes of its file if that has
  /// one frame in the format of the new ones. Throws std::system_error.
  void write(double time, const Frame& frame, bool given);
  /// The step whose frames were written last was changed.
  void add_changed(const std::string& line) { pending_changed_ += line + '\n'; }
  /// The step that was written last is complete. Throws WriteError.
  void commit();
  /// What is committed stays. Notes in the outcome what that is. Throws std::system_error.
  void finish(RepairOutcome& outcome);

 private:
  bool has_own_file(std::size_t k) const;
  bool is_read(const std::filesystem::path& file) const;
  Sha256Digest find_fingerprint() const;
  bool is_there() const;
  bool has_only_begun() const;
  void read_rows(std::vector<double>& times);
  std::vector<std::string> read_changed(std::size_t steps);
  std::optional<double> time_of_row(const std::string& row, std::size_t k) const;
  std::size_t count(std::string_view what) const;
  static void append(const std::filesystem::path& file, std::string& lines);

  const RepairRequest& request_;
  const FrameSource& source_;
  FrameWriter write_;
  std::filesystem::path table_, state_, changed_;
  Sha256Digest fingerprint_;
  std::string state_text_;
  bool resumes_;
  bool replaces_;  ///< what is there, also where an earlier call had only begun
  FrameFiles files_;
  std::optional<FolderLock> lock_;         ///< of their folder
  std::string rows_, changes_;             ///< of the table and the changed steps, as an earlier call left them
  std::string pending_, pending_changed_;  ///< rows and lines that are not committed
  std::vector<RepairedFrame> written_;
};

/// All files that a repair reads.
std::vector<std::filesystem::path> files_read(const RepairRequest& request);

/// The files beside the frames of a pattern. Throws UsageError for a pattern without a number.
std::vector<std::filesystem::path> files_beside_repaired(const std::string& pattern);
/// Whether a file would be one of these frames, or one beside them.
bool is_of_repaired(const std::filesystem::path& file, const std::string& pattern);

}  // namespace noli
