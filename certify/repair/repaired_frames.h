// SPDX-License-Identifier: Apache-2.0
//
// Writes the frames of a repaired motion, and beside them a table of which file is which moment. A step is committed by
// its rows in the table, so a repair that was killed can go on behind the last whole step.
//
// Files beside the frames
//   times.csv     a row for each frame: file, time in steps, the given frame of that time, and what it is: "copied" byte
//                 for byte, "given" (the same numbers), "repaired", "inserted"
//   repair.json   a hash of the names and sizes of the given frames, and of all options that decide what is written
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <noli/repair.h>
#include "certify/frame_files.h"
#include "trajectory/formats/frame_source.h"

namespace noli {

class RepairedFrames {
 public:
  /// The arguments have to outlive this; the source has been looked at. Throws UsageError as FrameFiles does, and where
  /// a new file would be one that is read.
  RepairedFrames(const RepairRequest& request, const FrameSource& source);

  struct Last {
    std::size_t step;  ///< so many are done
    std::vector<Position> positions;
  };
  /// With `resume`, where an earlier repair ended; nothing if there is none. Throws InputError if it was another one.
  std::optional<Last> go_on();

  /// The next frame. `time`: in steps. `given`: it is frame `time` as given, and has the bytes of its file if that holds
  /// one frame in the format of the new ones. Throws std::system_error.
  void write(double time, const Frame& frame, bool given);
  /// The step that was written last is whole. Throws std::system_error.
  void commit();
  /// What is committed stays. Notes in the outcome what that is. Throws std::system_error.
  void finish(RepairOutcome& outcome);

  std::vector<std::filesystem::path> files() const;

 private:
  struct Row {
    double time;
    std::string text, what;
  };

  bool has_own_file(std::size_t k) const;
  std::string fingerprint() const;
  std::vector<Row> rows_of_table() const;

  const RepairRequest& request_;
  const FrameSource& source_;
  FrameFiles files_;
  FrameWriter write_;
  std::filesystem::path table_, state_;
  std::vector<Row> rows_;      ///< of all frames
  std::size_t committed_ = 0;  ///< of these
};

}  // namespace noli
