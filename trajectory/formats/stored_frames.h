// SPDX-License-Identifier: Apache-2.0
//
// What sources have in common whose files hold many frames, or none: they hash the files when they are looked at, and
// notice when one is written to before all frames have been read.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "trajectory/formats/frame_source.h"

namespace noli {

class StoredFrames : public FrameSource {
 public:
  /// "motion.npz[3]", or the name of the file where it has one frame.
  std::string name(std::size_t k) const override;
  /// Hashes the files, the first time. Throws InputError, ReadInterrupted.
  void look_at(std::size_t k) override;
  bool can_begin_again() const override { return true; }
  const std::vector<FrameFacts>& facts() const override { return facts_; }

 protected:
  explicit StoredFrames(const std::vector<std::filesystem::path>& files);

  /// What was read of a file.
  FrameFacts& facts_of(std::size_t file) { return facts_[file]; }
  /// Throws InputError when a file has been written to, or replaced, since this was made.
  void require_unchanged(std::size_t file = 0) const;
  /// Throws InputError unless the files that were looked at still have the same hashes: what was written through mapped
  /// memory has left no other trace. Call it when the last frame has been read. Throws ReadInterrupted.
  void require_same_bytes() const;

 private:
  struct State {
    std::uintmax_t size = 0, device = 0, inode = 0;
    std::int64_t seconds = 0, nanoseconds = 0;  ///< when it was last changed
    friend bool operator==(const State&, const State&) = default;
  };
  static State state_of(const std::string& file);

  std::vector<FrameFacts> facts_;  ///< one per file
  std::vector<State> opened_;
};

/// How many frames the files have; of several bodies, those of the first.
std::uint64_t frame_count(const std::vector<FrameFacts>& files);
/// What frame k is called, if these files have so many frames each.
std::string frame_name(const std::vector<FrameFacts>& files, std::size_t k);

}  // namespace noli
