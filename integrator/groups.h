// SPDX-License-Identifier: Apache-2.0
//
// Sorts forces into groups of equal step: fired in a row, in mesh order, they cost little more than a synchronous loop.
//
// Notation
//   W        the window's length; steps are rounded down to W 2^-p, p = 0, 1, 2, ..., so that a window's end is a
//            common multiple of all of them
//   group    the forces of one kind and one p; numbered by kind, then longest step first
// A force's number, by which events of one time and kind are ordered, follows its group's, then the mesh's order.
//
// Rounding down keeps a stable step stable, but see the warnings about resonance (integrator/resonance.h).
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "integrator/clocks.h"
#include "integrator/model.h"

namespace noli::integrator {

/// Groups of one kind are at most about this many: when the steps span more powers of two, p is rounded up to a
/// multiple of a stride.
constexpr int most_groups = 10;

struct Group {
  ForceKind kind;
  Clock clock;
  std::size_t begin = 0, end = 0;  ///< forces of the kind's list, in the group's order
  std::vector<VertexId> vertices;  ///< of these forces, each once, ascending
};

/// The least p >= 0 with W 2^-p <= h. Preconditions: h, W positive and finite.
inline int step_exponent(double h, double window_length) {
  int p = std::max(0, std::ilogb(window_length) - std::ilogb(h) - 1);
  while (std::ldexp(window_length, -p) > h) ++p;
  return p;
}

/// Puts a list into the order of its groups and returns these; the list's steps become those of the groups. Damping is
/// a property of the whole list: sorting damped forces first in each group would change the order of events.
template <class F>
std::vector<Group> make_groups(ForceList<F>& list, double window_length) {
  if (list.forces.empty()) return {};
  std::vector<int> p(list.forces.size());
  for (std::size_t i = 0; i < p.size(); ++i) p[i] = step_exponent(list.steps[i], window_length);
  const auto [low, high] = std::minmax_element(p.begin(), p.end());
  const int stride = (*high - *low) / most_groups + 1, last = *high;
  for (int& q : p) q = last - (last - q) / stride * stride;
  std::vector<std::size_t> order(p.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return p[a] < p[b]; });
  ForceList<F> sorted;
  std::vector<Group> groups;
  for (const std::size_t i : order) {
    const double step = std::ldexp(window_length, -p[i]);
    if (groups.empty() || groups.back().clock.step != step) {
      groups.push_back({F::kind, {step, 1}, sorted.forces.size(), sorted.forces.size(), {}});
    }
    sorted.add(list.forces[i], step);
    ++groups.back().end;
    for (const VertexId v : list.forces[i].vertices) groups.back().vertices.push_back(v);
  }
  for (Group& group : groups) {
    std::vector<VertexId>& vertices = group.vertices;
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    vertices.shrink_to_fit();
  }
  list = std::move(sorted);
  return groups;
}

}  // namespace noli::integrator
