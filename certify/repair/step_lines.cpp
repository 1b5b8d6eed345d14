// SPDX-License-Identifier: Apache-2.0
#include "certify/repair/step_lines.h"

#include <utility>

namespace noli {
namespace {

/// The breakpoints of one vertex after another.
class StepLines {
 public:
  StepLines(std::size_t k, int dimension) : begin_(static_cast<double>(k)), end_(begin_ + 1), flat_(dimension == 2) {}

  void begin_vertex(const Position& x) {
    offsets_.push_back(times_.size());
    add(begin_, x);
  }
  /// A breakpoint at this time in the step, if it rounds to a time within. One that is not later than the last takes
  /// its place: sums of a phase's beginning and times in it may be off by a rounding.
  void move(double time_in_step, const Position& x) {
    const double time = begin_ + time_in_step;
    if (!(time > begin_ && time < end_)) return;
    if (time <= times_.back()) {
      positions_.back() = in_space(x);
    } else {
      add(time, x);
    }
  }
  void end_vertex(const Position& x) { add(end_, x); }

  WorldLines take() {
    offsets_.push_back(times_.size());
    return WorldLines::from_breakpoints(std::move(offsets_), std::move(times_), std::move(positions_),
                                        "a repaired step");
  }

 private:
  void add(double time, const Position& x) {
    times_.push_back(time);
    positions_.push_back(in_space(x));
  }
  Position in_space(const Position& x) const { return flat_ ? Position{x[0], x[1], 0} : x; }

  double begin_, end_;
  bool flat_;
  std::vector<std::size_t> offsets_;
  std::vector<double> times_;
  std::vector<Position> positions_;
};

}  // namespace

WorldLines lines_of_step(const FilteredStep& moved, std::span<const Position> x, std::size_t k, int dimension) {
  StepLines lines(k, dimension);
  for (VertexId v = 0; v < x.size(); ++v) {
    lines.begin_vertex(x[v]);
    for (const FilteredStep::Piece& piece : moved.pieces) {
      const auto times = piece.lines.times(v);
      const auto positions = piece.lines.positions(v);
      // A piece begins where the one before ended.
      for (std::size_t i = 1; i < times.size(); ++i) lines.move(piece.begin + times[i], positions[i]);
    }
    lines.end_vertex(moved.end[v]);
  }
  return lines.take();
}

WorldLines lines_through_frames(std::span<const Position> x, std::span<const double> times,
                                std::span<const std::vector<Position>> frames, std::size_t k, int dimension) {
  StepLines lines(k, dimension);
  for (VertexId v = 0; v < x.size(); ++v) {
    lines.begin_vertex(x[v]);
    for (std::size_t i = 0; i + 1 < times.size(); ++i) lines.move(times[i], frames[i][v]);
    lines.end_vertex(frames.back()[v]);
  }
  return lines.take();
}

}  // namespace noli
