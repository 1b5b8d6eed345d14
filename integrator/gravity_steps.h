// SPDX-License-Identifier: Apache-2.0
//
// Chooses how gravity acts on each vertex: together with the force of the shortest step there, which carries it, or by
// itself.
//
// Notation: that of integrator/falling.h, and
//   carried  the shortest step of the forces on the vertex is at most gravity's own
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include "integrator/groups.h"

namespace noli::integrator {

struct GravitySteps {
  std::vector<double> steps;          ///< h of each vertex; infinity if it does not fall
  std::vector<std::uint8_t> carried;  ///< by vertex
};

/// `held` and `of_forces` are by vertex. `of_forces` is the shortest step of the forces on it, infinity without forces.
template <class S, int Dim>
GravitySteps steps_of_gravity(const std::vector<std::uint8_t>& held, std::vector<double> of_forces,
                              const Gravity<S, Dim>& gravity) {
  constexpr double none = std::numeric_limits<double>::infinity();
  GravitySteps result{std::move(of_forces), std::vector<std::uint8_t>(held.size(), 0)};
  for (std::size_t i = 0; i < held.size(); ++i) {
    double& h = result.steps[i];
    const double longest = h == none ? std::min(gravity.step, gravity.step_without_forces) : gravity.step;
    result.carried[i] = held[i] == 0 && h <= longest;
    h = held[i] != 0 ? none : std::min(h, longest);
  }
  return result;
}

/// The vertices by equal steps, longest first. If forces have clocks of their own, carried vertices are left out, as
/// each such force brings gravity with it.
inline std::vector<Group> gravity_groups(const GravitySteps& gravity, Clocks clocks) {
  std::map<double, std::vector<VertexId>, std::greater<>> of_step;
  for (std::size_t i = 0; i < gravity.steps.size(); ++i) {
    const bool is_held = gravity.steps[i] == std::numeric_limits<double>::infinity();
    if (is_held || (clocks == Clocks::own && gravity.carried[i] != 0)) continue;
    of_step[gravity.steps[i]].push_back(static_cast<VertexId>(i));
  }
  std::vector<Group> groups;
  for (auto& [step, vertices] : of_step) {
    groups.push_back({ForceKind::gravity, {step, 1}, 0, vertices.size(), std::move(vertices)});
  }
  return groups;
}

/// Decides which vertices each force with a clock of its own carries. Of the forces that could carry a vertex, the
/// first one does.
class Carriers {
 public:
  explicit Carriers(const GravitySteps& gravity) : gravity_(gravity), left_(gravity.carried) {}

  /// Bit k: the force carries vertex k.
  template <class Vertices>
  std::uint16_t take(const Vertices& vertices, double step) {
    unsigned bits = 0;
    for (std::size_t k = 0; k < vertices.size() && !left_.empty(); ++k) {
      std::uint8_t& waits = left_[vertices[k]];
      if (waits == 0 || gravity_.steps[vertices[k]] != step) continue;
      waits = 0;
      bits |= 1U << k;
    }
    return static_cast<std::uint16_t>(bits);
  }

 private:
  const GravitySteps& gravity_;
  std::vector<std::uint8_t> left_;
};

}  // namespace noli::integrator
