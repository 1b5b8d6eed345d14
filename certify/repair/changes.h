// SPDX-License-Identifier: Apache-2.0
//
// Counts how far a repair has moved vertices from where they were given.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
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

  std::uint64_t moved() const { return moved_; }
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

  /// A step that ends at x where y was given.
  Distances add(std::span<const Position> x, std::span<const Position> y) {
    Distances step;
    std::size_t body = 0;
    for (VertexId v = 0; v < x.size(); ++v) {
      double square = 0;
      for (std::size_t k = 0; k < 3; ++k) square += (x[v][k] - y[v][k]) * (x[v][k] - y[v][k]);
      const double distance = std::sqrt(square);
      if (!(distance > 0)) continue;
      step.add(v, distance);
      while (body < bodies_.size() && v - bodies_[body].first_vertex >= bodies_[body].vertices) ++body;
      if (body < bodies_.size()) of_body_[body].add(v, distance);
    }
    return step;
  }

  std::vector<RepairedBody> by_body() const {
    std::vector<RepairedBody> all;
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      const Distances& d = of_body_[i];
      const auto body = fixed_.subspan(bodies_[i].first_vertex, bodies_[i].vertices);
      const bool fixed = std::ranges::all_of(body, [](std::uint8_t of) { return of != 0; });
      all.push_back({bodies_[i].name, fixed, d.moved(), d.largest(), d.root_mean_square()});
    }
    return all;
  }

 private:
  std::vector<FrameBody> bodies_;
  std::span<const std::uint8_t> fixed_;
  std::vector<Distances> of_body_;
};

}  // namespace noli
