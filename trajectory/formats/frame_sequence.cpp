// SPDX-License-Identifier: Apache-2.0
#include "trajectory/formats/frame_sequence.h"

#include <algorithm>
#include <utility>

#include <noli/errors.h>
#include "trajectory/formats/frames.h"

namespace noli {
namespace {

[[noreturn]] void refuse_single(const std::string& name) {
  throw InputError(name, "", "is a single frame, expected at least two to have a motion");
}

}  // namespace

FrameSequence::FrameSequence(FrameSource& source, Motion motion) : source_(source), motion_(motion) {
  const auto count = source_.count();
  if (count == 0U) throw InputError("frames", "", "there are none");
  if (motion_ == Motion::linear && count == 1U) refuse_single(source_.name(0));
}

std::optional<std::size_t> FrameSequence::step_count() const {
  const auto count = source_.count();
  if (!count) return std::nullopt;
  return motion_ == Motion::linear ? *count - 1 : *count;
}

bool FrameSequence::next() {
  if (frames_read_ == 0 && motion_ == Motion::linear && !read_next_frame()) return false;
  if (read_next_frame()) return true;
  if (frames_read_ == 1 && motion_ == Motion::linear) refuse_single(source_.name(0));
  return false;
}

void FrameSequence::skip_to(std::size_t step) {
  if (motion_ == Motion::linear && frames_read_ == step + 1) return;
  frames_read_ = step;
  if (motion_ == Motion::linear) read_next_frame();
}

bool FrameSequence::read_next_frame() {
  // Room for the next one first, so that no third frame is in memory.
  x_t0_ = motion_ == Motion::linear ? std::exchange(x_t1_, {}) : std::vector<Position>();
  if (motion_ == Motion::constant) x_t1_ = {};
  std::optional<Frame> frame = source_.read(frames_read_);
  if (!frame) return false;
  if (frames_read_ == 0) {
    mesh_ = std::move(frame->mesh);
  } else {
    require_same_mesh(mesh_, source_.name(0), frame->mesh, source_.name(frames_read_));
  }
  x_t1_ = std::move(frame->positions);
  ++frames_read_;
  return true;
}

}  // namespace noli
