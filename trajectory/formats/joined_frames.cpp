// SPDX-License-Identifier: Apache-2.0
#include "trajectory/formats/joined_frames.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include <noli/errors.h>
#include "trajectory/cells.h"
#include "trajectory/formats/open_frames.h"

namespace noli {

JoinedFrames::JoinedFrames(const std::vector<BodyFrames>& bodies, const FrameReading& reading) {
  std::vector<BodyFrames> in_order = bodies;
  std::stable_partition(in_order.begin(), in_order.end(), [](const BodyFrames& body) { return !body.still; });
  FrameReading own = reading;
  own.bodies.clear();
  for (const BodyFrames& body : in_order) {
    if (std::ranges::count(bodies_, body.name, &FrameBody::name) > 0) {
      throw UsageError(fmt::format("there are two bodies {}; expected different names", on_one_line(body.name)));
    }
    parts_.push_back({open_frames(body.frames, own), std::nullopt});
    bodies_.push_back({body.name, 0, 0, 0, 0, body.still});
  }
  require_counts(in_order);
}

void JoinedFrames::require_counts(const std::vector<BodyFrames>& bodies) {
  if (bodies.empty() || bodies[0].still)
    throw InputError("frames", "", "no body moves; expected at least one (--body)");
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    const auto count = parts_[i].source->count();
    if (!count) throw UsageError("-: cannot be one of several bodies; expected files");
    if (bodies[i].still && *count != 1) {
      throw InputError(bodies[i].name, "", fmt::format("has {} frames; expected one frame for an obstacle", *count));
    }
    if (i == 0) count_ = *count;
    if (!bodies[i].still && *count != count_) {
      throw InputError(bodies[i].name, "",
                       fmt::format("has {} frames, but {} has {}; expected the same number for each body", *count,
                                   bodies[0].name, count_));
    }
  }
}

void JoinedFrames::look_at(std::size_t k) {
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    if (!bodies_[i].still || k == 0) parts_[i].source->look_at(k);
  }
}

std::optional<Frame> JoinedFrames::read(std::size_t k) {
  if (k >= count_) return std::nullopt;
  Frame all;
  for (std::size_t i = 0; i < parts_.size(); ++i) append(i, frame_of(i, k), all);
  return all;
}

Frame JoinedFrames::frame_of(std::size_t part, std::size_t k) {
  Part& one = parts_[part];
  if (one.still) return *one.still;
  std::optional<Frame> frame = one.source->read(bodies_[part].still ? 0 : k);
  if (!frame) throw InputError(bodies_[part].name, "", fmt::format("ends before frame {}", k));
  if (bodies_[part].still) one.still = frame;
  return std::move(*frame);
}

void JoinedFrames::append(std::size_t part, const Frame& frame, Frame& all) {
  FrameBody& body = bodies_[part];
  const std::size_t first = all.mesh.vertex_count, first_face = all.mesh.faces.size();
  if (first + frame.mesh.vertex_count > 0xffffffff)
    throw InputError(body.name, "", "is one vertex too many for all bodies");
  if (body.vertices > 0 && (body.vertices != frame.mesh.vertex_count || body.faces != frame.mesh.faces.size())) {
    throw InputError(body.name, "", "has a different mesh from the frame before");
  }
  body = {body.name, first, frame.mesh.vertex_count, first_face, frame.mesh.faces.size(), body.still};
  append_mesh(all.mesh, frame.mesh);
  all.positions.insert(all.positions.end(), frame.positions.begin(), frame.positions.end());
}

bool JoinedFrames::can_begin_again() const {
  return std::ranges::all_of(parts_, [](const Part& part) { return part.source->can_begin_again(); });
}

bool JoinedFrames::may_skip() const {
  return std::ranges::all_of(parts_, [](const Part& part) { return part.source->may_skip(); });
}

const std::vector<FrameFacts>& JoinedFrames::facts() const {
  facts_.clear();
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    for (FrameFacts facts : parts_[i].source->facts()) {
      facts.body = bodies_[i].name;
      facts_.push_back(std::move(facts));
    }
  }
  return facts_;
}

std::vector<std::string> JoinedFrames::notes() const {
  std::vector<std::string> notes;
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    for (const std::string& note : parts_[i].source->notes()) notes.push_back(bodies_[i].name + ": " + note);
  }
  return notes;
}

}  // namespace noli
