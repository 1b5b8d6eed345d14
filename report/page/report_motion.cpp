// SPDX-License-Identifier: Apache-2.0
#include "report/page/report_motion.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "report/page/report_page.h"
#include "trajectory/stop.h"

namespace noli::report {

void MotionPacker::add(double time, std::span<const Position> positions) {
  times_.push_back(time);
  frames_.emplace_back(positions.begin(), positions.end());
  while (frames_.size() > 1 && frames_.size() * vertices_ * sizeof(Position) > most_memory) thin();
}

void MotionPacker::thin() {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < frames_.size(); i += 2, ++kept) {
    times_[kept] = times_[i];
    if (kept != i) frames_[kept] = std::move(frames_[i]);
  }
  times_.resize(kept);
  frames_.resize(kept);
  stride_ *= 2;
}

void MotionPacker::find_box() {
  least_ = greatest_ = frames_.front().empty() ? Position{} : frames_.front().front();
  for (const auto& frame : frames_) {
    for (const Position& x : frame) {
      for (std::size_t k = 0; k < 3; ++k) {
        least_[k] = std::min(least_[k], x[k]);
        greatest_[k] = std::max(greatest_[k], x[k]);
      }
    }
  }
}

std::string MotionPacker::bytes() const {
  const std::size_t size = 3 * vertices_;
  std::string out(2 * size * frames_.size(), '\0');
  std::vector<std::uint16_t> before(size, 0);
  for (std::size_t f = 0; f < frames_.size(); ++f) {
    end_if_stopped();
    char* const low = out.data() + 2 * size * f;
    char* const high = low + size;
    for (std::size_t k = 0; k < 3; ++k) {
      // Halves, so that the extent of the greatest doubles is finite.
      const double extent = greatest_[k] / 2 - least_[k] / 2;
      for (std::size_t v = 0; v < vertices_; ++v) {
        const std::size_t i = k * vertices_ + v;
        const double share = extent > 0 ? (frames_[f][v][k] / 2 - least_[k] / 2) / extent : 0;
        const auto now = static_cast<std::uint16_t>(std::lround(65535 * share));
        const auto change = static_cast<std::uint16_t>(now - before[i]);
        before[i] = now;
        low[i] = static_cast<char>(change & 0xff);
        high[i] = static_cast<char>(change >> 8);
      }
    }
  }
  return out;
}

PackedFrames MotionPacker::pack() {
  for (;; thin()) {
    find_box();
    std::string motion = packed(bytes());
    if (motion.size() <= most_bytes_ || frames_.size() == 1) return {times_, least_, greatest_, std::move(motion)};
  }
}

}  // namespace noli::report
