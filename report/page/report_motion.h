// SPDX-License-Identifier: Apache-2.0
//
// The frames of a report: as many as fit, evenly spread, in numbers of 16 bits.
//
// Notation
//   stride   one frame of so many that were offered is kept; a power of two
//   packed   for each frame all x, all y, all z, each in 65,535ths of the box of all frames, less that of the frame
//            before (modulo 2^16); the low bytes of all of these, then their high bytes
//
// What this does not do: positions are rounded to be looked at. Nothing is decided by them.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include <noli/mesh.h>

namespace noli::report {

struct PackedFrames {
  std::vector<double> times;
  Position least{}, greatest{};  ///< the box
  std::string motion;            ///< packed (report_page.h)
};

class MotionPacker {
 public:
  /// `most_bytes`: of PackedFrames::motion.
  MotionPacker(std::size_t vertices, std::size_t most_bytes) : vertices_(vertices), most_bytes_(most_bytes) {}

  std::size_t stride() const { return stride_; }
  /// Offers a frame. True if it is not wanted; else add() has to follow.
  bool skip() { return offered_++ % stride_ != 0; }
  /// The frame that was offered, a position for each vertex.
  void add(double time, std::span<const Position> positions);
  /// All of them once packed are at most so many bytes; one frame is always kept. Precondition: one was added.
  PackedFrames pack();

 private:
  void thin();
  std::string bytes() const;
  void find_box();

  static constexpr std::size_t most_memory = std::size_t{256} << 20;

  std::size_t vertices_, most_bytes_;
  std::size_t stride_ = 1, offered_ = 0;
  std::vector<double> times_;
  std::vector<std::vector<Position>> frames_;
  Position least_{}, greatest_{};
};

}  // namespace noli::report
