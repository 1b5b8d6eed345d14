// SPDX-License-Identifier: Apache-2.0
//
// Writes the frames of a repaired motion, and the table that says which file is which moment.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <noli/repair.h>
#include "certify/frame_files.h"
#include "trajectory/formats/frame_source.h"

namespace noli {

class RepairedFrames {
 public:
  /// The arguments have to outlive this. Throws UsageError as FrameFiles does, and where a new file would be one that is
  /// read.
  RepairedFrames(const RepairRequest& request, const FrameSource& source);

  /// The next frame. `time`: in steps. `given`: it is frame `time` as given, and has the bytes of its file if that holds
  /// one frame in the format of the new ones. Throws std::system_error.
  void write(double time, const Frame& frame, bool given);
  /// Whatever is written stays. Notes in the outcome what was written. Throws std::system_error.
  void finish(RepairOutcome& outcome);

  std::vector<std::filesystem::path> files() const;

 private:
  bool has_own_file(std::size_t k) const;
  void write_times(const std::filesystem::path& table) const;

  const RepairRequest& request_;
  const FrameSource& source_;
  FrameFiles files_;
  FrameWriter write_;
  std::size_t copied_ = 0;
};

}  // namespace noli
