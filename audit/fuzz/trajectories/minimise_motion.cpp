// SPDX-License-Identifier: Apache-2.0
//
// Makes a motion that fails simpler: fewest frames, then fewest cells and vertices, then shortest coordinates.
#include <algorithm>
#include <array>
#include <cmath>

#include "audit/fuzz/queries/minimise_query.h"
#include "audit/fuzz/trajectories/fuzz_trajectories.h"
#include "trajectory/cells.h"

namespace noli::audit {

namespace {

/// What is compared first comes first.
using Size = std::array<std::size_t, 4>;

Size size_of(const FrameMotion& motion) {
  std::size_t numbers = 0;
  for (const auto& frame : motion.frames) {
    for (const Position& x : frame) {
      for (const double coordinate : x) numbers += static_cast<std::size_t>(complexity(coordinate));
    }
  }
  return {motion.frames.size(), motion.mesh.cell_count(), motion.mesh.vertex_count, numbers};
}

void erase_cell(Mesh& mesh, std::size_t cell) {
  const auto erase = [&](auto& cells) {
    const bool here = cell < cells.size();
    if (here) cells.erase(cells.begin() + static_cast<std::ptrdiff_t>(cell));
    cell -= here ? 0 : cells.size();
    return here;
  };
  if (erase(mesh.faces) || erase(mesh.edges)) return;
  erase(mesh.points);
}

/// Leaves out the vertices that no cell has.
void erase_unused_vertices(FrameMotion& motion) {
  const std::vector<VertexId> kept = drop_unreferenced_vertices(motion.mesh);
  for (auto& frame : motion.frames) {
    for (std::size_t v = 0; v < kept.size(); ++v) frame[v] = frame[kept[v]];
    frame.resize(kept.size());
  }
}

class MotionMinimiser {
 public:
  MotionMinimiser(const FrameMotion& motion, const std::function<bool(const FrameMotion&)>& fails, std::size_t budget)
      : motion_(motion), size_(size_of(motion)), fails_(fails), budget_(budget) {}

  FrameMotion run() {
    for (bool progress = true; progress && budget_ > 0;) {
      progress = fewer_frames();
      progress |= fewer_cells();
      progress |= to_the_origin();
      progress |= resting_vertices();
      progress |= simpler_coordinates();
    }
    return motion_;
  }

 private:
  bool accept(const FrameMotion& candidate) {
    const Size size = size_of(candidate);
    if (size >= size_ || budget_ == 0) return false;
    --budget_;
    if (!fails_(candidate)) return false;
    motion_ = candidate;
    size_ = size;
    return true;
  }

  /// A motion stays one: of one frame only if it had no more.
  bool fewer_frames() {
    bool progress = false;
    for (std::size_t frame = motion_.frames.size(); frame-- > 0 && motion_.frames.size() > 2;) {
      FrameMotion candidate = motion_;
      candidate.frames.erase(candidate.frames.begin() + static_cast<std::ptrdiff_t>(frame));
      progress |= accept(candidate);
    }
    return progress;
  }

  bool fewer_cells() {
    bool progress = false;
    for (std::size_t cell = motion_.mesh.cell_count(); cell-- > 0 && motion_.mesh.cell_count() > 1;) {
      FrameMotion candidate = motion_;
      erase_cell(candidate.mesh, cell);
      erase_unused_vertices(candidate);
      progress |= accept(candidate);
    }
    return progress;
  }

  bool to_the_origin() {
    bool progress = false;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      FrameMotion candidate = motion_;
      const double offset = candidate.frames[0][0][axis];
      for (auto& frame : candidate.frames) {
        for (Position& x : frame) x[axis] -= offset;
      }
      progress |= accept(candidate);
    }
    return progress;
  }

  bool resting_vertices() {
    bool progress = false;
    for (std::size_t frame = 1; frame < motion_.frames.size(); ++frame) {
      for (std::size_t v = 0; v < motion_.mesh.vertex_count; ++v) {
        FrameMotion candidate = motion_;
        candidate.frames[frame][v] = candidate.frames[frame - 1][v];
        progress |= accept(candidate);
      }
    }
    return progress;
  }

  bool simpler_coordinates() {
    bool progress = false;
    for (std::size_t frame = 0; frame < motion_.frames.size(); ++frame) {
      for (std::size_t v = 0; v < motion_.mesh.vertex_count; ++v) {
        for (std::size_t axis = 0; axis < 3; ++axis) progress |= simpler_coordinate(frame, v, axis);
      }
    }
    return progress;
  }

  bool simpler_coordinate(std::size_t frame, std::size_t v, std::size_t axis) {
    for (const double value : simpler_numbers(motion_.frames[frame][v][axis])) {
      FrameMotion candidate = motion_;
      candidate.frames[frame][v][axis] = value;
      if (std::isfinite(value) && accept(candidate)) return true;
    }
    return false;
  }

  FrameMotion motion_;
  Size size_;
  const std::function<bool(const FrameMotion&)>& fails_;
  std::size_t budget_;
};

}  // namespace

FrameMotion minimise(const FrameMotion& motion, const std::function<bool(const FrameMotion&)>& fails,
                     std::size_t budget) {
  return MotionMinimiser(motion, fails, budget).run();
}

}  // namespace noli::audit
