// SPDX-License-Identifier: Apache-2.0
//
// The forces of a run by kind, and their steps.
//
// Notation
//   division  all forces of one kind, in the order of their numbers
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <tuple>
#include <vector>

#include "integrator/model.h"

namespace noli::integrator {

/// A group of forces that fire together; if forces have clocks of their own, the forces of one kind and step.
struct StepGroup {
  ForceKind kind;
  double step;
  std::uint64_t forces;
};

template <class F>
struct Division {
  ForceList<F> list;
  bool damped = false;  ///< some are damped; then all are fired as damped ones
};

/// Calls each(division) for all divisions, in the order of kinds.
template <class Divisions, class Each>
void for_each_division(const Divisions& divisions, Each&& each) {
  std::apply([&](const auto&... division) { (each(division), ...); }, divisions);
}

/// The shortest step of the forces on each vertex; infinity without forces, or if is_held(vertex).
template <class Divisions, class IsHeld>
std::vector<double> shortest_steps(const Divisions& divisions, std::size_t vertex_count, const IsHeld& is_held) {
  std::vector<double> steps(vertex_count, std::numeric_limits<double>::infinity());
  for_each_division(divisions, [&](const auto& division) {
    for (std::size_t i = 0; i < division.list.forces.size(); ++i) {
      for (const VertexId v : division.list.forces[i].vertices) {
        if (!is_held(v)) steps[v] = std::min(steps[v], division.list.steps[i]);
      }
    }
  });
  return steps;
}

/// Forces of one kind and step, longest steps first.
template <class Divisions>
std::vector<StepGroup> groups_by_step(const Divisions& divisions) {
  std::vector<StepGroup> groups;
  for_each_division(divisions, [&groups]<class F>(const Division<F>& division) {
    std::vector<double> steps = division.list.steps;
    std::sort(steps.begin(), steps.end(), std::greater<>());
    for (std::size_t i = 0; i < steps.size(); ++i) {
      if (i == 0 || steps[i] != steps[i - 1]) groups.push_back({F::kind, steps[i], 0});
      ++groups.back().forces;
    }
  });
  return groups;
}

}  // namespace noli::integrator
