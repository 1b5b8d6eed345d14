// SPDX-License-Identifier: Apache-2.0
//
// The two motions that a result of `noli repair` is about: the given one and the repaired one, read from the files that
// it names.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <vector>

#include "certify/json.h"
#include "trajectory/formats/frame_sequence.h"
#include "trajectory/formats/frame_source.h"

namespace noli::report {

/// A motion at times that ascend: straight lines between frames with times.
class TimedFrames {
 public:
  /// `times`: of the frames, ascending. Precondition: the source has at least one frame.
  TimedFrames(std::unique_ptr<FrameSource> source, std::vector<double> times);

  const Mesh& mesh() const { return sequence_.mesh(); }  ///< as read
  const std::vector<double>& times() const { return times_; }
  /// Precondition: between the times of the first and the last frame, and no earlier than the time before. Throws
  /// InputError, Stopped.
  std::vector<Position> at(double time);

 private:
  bool next();

  std::unique_ptr<FrameSource> source_;
  std::vector<double> times_;
  FrameSequence sequence_;
  std::vector<Position> before_;  ///< of the frame before the one that was read last; that one itself at first
};

/// Both have the hashes that the result says. Times are in steps.
struct RepairedMotions {
  Mesh mesh;  ///< of both, with the particles that were compared
  std::unique_ptr<TimedFrames> given, repaired;
};

/// Throws InputError where files are not there, have other bytes or another mesh, or where there is no repaired frame;
/// nlohmann::json::exception where members are not as `noli repair` writes them.
RepairedMotions repaired_motions(const Json& result, const std::filesystem::path& path);

}  // namespace noli::report
