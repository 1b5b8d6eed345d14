// SPDX-License-Identifier: Apache-2.0
//
// The frames in a block file of frames (trajectory/blocks/frames_file.h).
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "trajectory/blocks/frames_file.h"
#include "trajectory/formats/stored_frames.h"

namespace noli {

class BlockFrames : public StoredFrames {
 public:
  /// Throws InputError: no such file, or none of frames.
  explicit BlockFrames(const std::filesystem::path& path);

  std::optional<std::size_t> count() const override { return count_; }
  std::optional<Frame> read(std::size_t k) override;
  std::vector<std::string> notes() const override { return {}; }

 private:
  std::optional<FramesReader> reader_;
  std::size_t next_ = 0, count_ = 0;
};

}  // namespace noli
