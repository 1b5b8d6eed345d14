// SPDX-License-Identifier: Apache-2.0
//
// Counts how far a repair has moved vertices from where they were given. Each changed step is also a line of text, from
// which a call that resumes the repair knows it.
#pragma once

#include <cmath>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <noli/repair.h>

namespace noli {

/// The distances of vertices that were moved at all.
class Distances {
 public:
  void add(VertexId v, double distance) {
    ++moved_;
    squares_ += distance * distance;
    if (distance <= largest_) return;
    largest_ = distance;
    vertex_ = v;
  }

  /// Adds the totals of another count.
  void add(std::uint64_t moved, double squares, double largest, VertexId vertex) {
    moved_ += moved;
    squares_ += squares;
    if (largest <= largest_) return;
    largest_ = largest;
    vertex_ = vertex;
  }

  std::uint64_t moved() const { return moved_; }
  double squares() const { return squares_; }  ///< their sum
  double largest() const { return largest_; }
  VertexId vertex() const { return vertex_; }  ///< with the largest
  double root_mean_square() const { return moved_ == 0 ? 0 : std::sqrt(squares_ / static_cast<double>(moved_)); }

 private:
  std::uint64_t moved_ = 0;
  double squares_ = 0, largest_ = 0;
  VertexId vertex_ = 0;
};

/// The changes of all steps, and those of each body.
class Changes {
 public:
  /// `bodies`: in the order of their vertices; none for frames without bodies. `fixed`: by vertex.
  Changes(std::vector<FrameBody> bodies, std::span<const std::uint8_t> fixed)
      : bodies_(std::move(bodies)), fixed_(fixed), of_body_(bodies_.size()) {}

  /// A step that ends at x where y was given; distances of `step` are filled in. `momentum`: into fixed vertices.
  /// Returns its line.
  std::string add(RepairedStep step, const Position& momentum, std::span<const Position> x,
                  std::span<const Position> y);
  /// The step of a line. Throws std::invalid_argument.
  void add_line(const std::string& line);

  const std::vector<RepairedStep>& steps() const { return steps_; }
  const Position& momentum_into_fixed() const { return momentum_; }
  std::vector<RepairedBody> by_body() const;

 private:
  void add(const RepairedStep& step, const Position& momentum, const std::vector<Distances>& of_body);

  std::vector<FrameBody> bodies_;
  std::span<const std::uint8_t> fixed_;
  std::vector<RepairedStep> steps_;
  Position momentum_{};
  std::vector<Distances> of_body_;
};

}  // namespace noli
