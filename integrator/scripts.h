// SPDX-License-Identifier: Apache-2.0
//
// Scripted vertices: the breakpoints of all paths, in order of time. Paths are checked when scenes are read.
#pragma once

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include "integrator/model.h"

namespace noli::integrator {

/// A breakpoint: the position of a vertex then, and its velocity until the next breakpoint.
template <class S, int Dim>
struct Turn {
  double time;
  VertexId vertex;
  Vec<S, Dim> x;
  Vec<S, Dim> v;
};

/// All turns of all scripts, by time, then vertex.
template <class S, int Dim>
class Timeline {
 public:
  explicit Timeline(const std::vector<Script<S, Dim>>& scripts) {
    for (const Script<S, Dim>& script : scripts) {
      for (std::size_t j = 0; j < script.times.size(); ++j) {
        const bool last = j + 1 == script.times.size();
        Vec<S, Dim> v = Vec<S, Dim>::Zero();
        if (!last) v = (script.positions[j + 1] - script.positions[j]) / (S(script.times[j + 1]) - S(script.times[j]));
        turns_.push_back({script.times[j], script.vertex, script.positions[j], v});
      }
    }
    std::ranges::sort(turns_, {}, [](const Turn<S, Dim>& turn) { return std::pair(turn.time, turn.vertex); });
  }

  /// Skips the turns that are not after t.
  void skip_to(double t) {
    while (next_ < turns_.size() && turns_[next_].time <= t) ++next_;
  }

  double next_time() const {
    return next_ < turns_.size() ? turns_[next_].time : std::numeric_limits<double>::infinity();
  }
  /// Precondition: next_time() is finite.
  const Turn<S, Dim>& take() { return turns_[next_++]; }

 private:
  std::vector<Turn<S, Dim>> turns_;
  std::size_t next_ = 0;
};

}  // namespace noli::integrator
