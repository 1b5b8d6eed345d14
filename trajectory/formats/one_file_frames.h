// SPDX-License-Identifier: Apache-2.0
//
// What the sources have in common that have all frames in one file, which stays open: they are bound to its hash when
// it is looked at, and notice when it is written to before they are done.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "trajectory/formats/frame_source.h"

namespace noli {

class OneFileFrames : public FrameSource {
 public:
  std::string name(std::size_t k) const override;
  /// Hashes the file, once. Throws InputError, ReadInterrupted.
  void look_at(std::size_t k) override;
  bool can_begin_again() const override { return true; }
  const std::vector<FrameFacts>& facts() const override { return facts_; }

 protected:
  explicit OneFileFrames(const std::filesystem::path& file);

  /// What was read of the file's frames.
  void describe(const std::string& numbers, std::size_t vertices, std::size_t cells, std::size_t frames);
  /// Throws InputError when the file has been written to, or replaced, since this was made.
  void require_unchanged() const;
  std::filesystem::path file() const { return facts_[0].file; }

 private:
  struct State {
    std::uintmax_t size = 0, inode = 0;
    std::int64_t seconds = 0, nanoseconds = 0;  ///< when it was last written to
    friend bool operator==(const State&, const State&) = default;
  };
  State state() const;

  std::vector<FrameFacts> facts_;  ///< one
  State opened_;
};

}  // namespace noli
