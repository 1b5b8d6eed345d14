// SPDX-License-Identifier: Apache-2.0
//
// Checks whether a model can be run. Scenes are checked when they are read; this is for models made by hand.
#pragma once

#include <cmath>
#include <stdexcept>
#include <tuple>

#include "integrator/model.h"

namespace noli::integrator {

namespace detail {

inline void require(bool condition, const char* what) {
  if (!condition) throw std::invalid_argument(what);
}

template <class F>
void check_list(const ForceList<F>& list, std::size_t n) {
  require(list.forces.size() == list.steps.size(), "model: forces and steps differ in number");
  for (const double h : list.steps) require(h > 0 && std::isfinite(h), "model: a step is not positive and finite");
  for (const F& force : list.forces) {
    for (const VertexId v : force.vertices) require(v < n, "model: a force's vertex is out of range");
  }
}

}  // namespace detail

/// Throws std::invalid_argument when sizes differ, vertices are out of range, or masses or steps are not positive.
template <class S, int Dim>
void check_model(const Model<S, Dim>& model) {
  using detail::require;
  const std::size_t n = model.x.size();
  require(model.v.size() == n && model.mass.size() == n, "model: x, v and mass differ in size");
  require(model.window_length > 0, "model: the window's length is not positive");
  for (const S& m : model.mass) require(m > S(0), "model: a mass is not positive");
  for (const VertexId v : model.pinned) require(v < n, "model: a pinned vertex is out of range");
  for (const auto& s : model.scripts) {
    require(s.vertex < n && !s.times.empty() && s.times.size() == s.positions.size(),
            "model: a script's vertex is out of range, or its times and positions do not match");
  }
  std::apply([&](const auto&... list) { (detail::check_list(list, n), ...); }, model.forces.lists());
  if (!model.gravity) return;
  const double h = model.gravity->step;
  require(h > 0 && std::isfinite(h), "model: gravity's step is not positive and finite");
  require(model.gravity->step_without_forces > 0, "model: gravity's step without forces is not positive");
}

}  // namespace noli::integrator
