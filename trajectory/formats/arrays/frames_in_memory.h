// SPDX-License-Identifier: Apache-2.0
//
// Frames that a function gives: see GivenFrames (noli/frames.h).
//
// Each frame is copied once, and the hash is that of the copy. If the function can be asked again, all frames are
// hashed, even after an early stop. Frames that are read twice must be the same both times.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "trajectory/blocks/sha256.h"
#include "trajectory/formats/frame_source.h"

namespace noli {

class FramesInMemory : public FrameSource {
 public:
  FramesInMemory(std::string called, std::shared_ptr<const GivenFrames> given);

  std::optional<std::size_t> count() const override { return given_->count; }
  std::string name(std::size_t k) const override;
  void look_at(std::size_t /*k*/) override {}
  /// Throws InputError, with the number of the vertex: a coordinate that is not finite, or not one position for each.
  std::optional<Frame> read(std::size_t k) override;
  bool can_begin_again() const override { return given_->again; }
  const std::vector<FrameFacts>& facts() const override { return facts_; }
  /// Reads what was not read. Throws as read(), and InputError when what was read twice was not the same.
  std::vector<FrameFacts> take_facts() override;
  std::vector<FrameBody> bodies() const override { return given_->bodies; }
  std::vector<std::string> notes() const override { return {}; }

 private:
  /// All frames once, in their order.
  struct Pass {
    Sha256 hash;
    std::size_t frames = 0;
    std::uint64_t bytes = 0;
  };

  std::vector<Position> positions_of(std::size_t k, std::vector<Position> given) const;
  void add(const std::vector<Position>& positions);

  std::string called_;
  std::shared_ptr<const GivenFrames> given_;
  std::vector<FrameFacts> facts_;
  std::vector<Pass> passes_;
};

}  // namespace noli
