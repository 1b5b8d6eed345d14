// SPDX-License-Identifier: Apache-2.0
//
// Several bodies, each with frames of its own, as frames of one mesh: the vertices of the first body, then those of the
// second, and so on; faces, loose edges and loose points likewise. A body that stands still has one frame.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "trajectory/formats/frame_source.h"

namespace noli {

class JoinedFrames : public FrameSource {
 public:
  /// Bodies that move come first. Throws InputError: no body that moves, different numbers of frames, frames of a body
  /// that are not as open_frames() wants them; UsageError: a name twice.
  explicit JoinedFrames(const std::vector<BodyFrames>& bodies, const FrameReading& reading);

  std::optional<std::size_t> count() const override { return count_; }
  std::string name(std::size_t k) const override { return parts_[0].source->name(k); }
  void look_at(std::size_t k) override;
  std::optional<Frame> read(std::size_t k) override;
  bool can_begin_again() const override;
  bool may_skip() const override;
  const std::vector<FrameFacts>& facts() const override;
  std::vector<std::string> notes() const override;
  std::vector<FrameBody> bodies() const override { return bodies_; }

 private:
  struct Part {
    std::unique_ptr<FrameSource> source;
    std::optional<Frame> still;  ///< the frame of a body that stands still, once it has been read
  };

  void require_counts(const std::vector<BodyFrames>& bodies);
  Frame frame_of(std::size_t part, std::size_t k);
  void append(std::size_t part, const Frame& frame, Frame& all);

  std::vector<Part> parts_;
  std::vector<FrameBody> bodies_;
  std::size_t count_ = 0;
  mutable std::vector<FrameFacts> facts_;  ///< those of all parts, gathered when they are asked for
};

}  // namespace noli
