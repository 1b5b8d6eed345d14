// SPDX-License-Identifier: Apache-2.0
//
// Gives all forces of a model one step, as a synchronous loop requires, and scales steps.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "integrator/groups.h"
#include "integrator/model.h"

namespace noli::audit {

/// Calls each(list) for each kind of force.
template <class Model, class Each>
void for_each_list(Model& model, const Each& each) {
  std::apply([&](auto&... list) { (each(list), ...); }, model.forces.lists());
}

/// The least step of any force, rounded down to a step of a group. Without forces, gravity's step; without gravity too,
/// the window.
template <int Dim>
double least_step(integrator::Model<double, Dim>& model) {
  double least = std::numeric_limits<double>::infinity();
  for_each_list(model, [&](auto& list) {
    for (const double h : list.steps) least = std::min(least, h);
  });
  if (std::isinf(least)) {
    least = model.window_length;
    if (model.gravity) least = std::min({least, model.gravity->step, model.gravity->step_without_forces});
  }
  return std::ldexp(model.window_length, -integrator::step_exponent(least, model.window_length));
}

/// Sets the step of all forces and of gravity, and sets all first layers of contact to the shortest of their steps.
template <int Dim>
void set_steps(integrator::Model<double, Dim>& model, double step) {
  for_each_list(model, [step](auto& list) { std::fill(list.steps.begin(), list.steps.end(), step); });
  if (model.gravity) model.gravity->step = model.gravity->step_without_forces = step;
  if (!model.contact || model.contact->materials.empty()) return;
  double least = model.contact->materials.front().step;
  for (const auto& m : model.contact->materials) least = std::min(least, m.step);
  for (auto& m : model.contact->materials) m.step = least;
}

/// Multiplies all steps by `factor`, those of gravity and of layers too.
template <int Dim>
void scale_steps(integrator::Model<double, Dim>& model, double factor) {
  for_each_list(model, [factor](auto& list) {
    for (double& h : list.steps) h *= factor;
  });
  if (model.gravity) {
    model.gravity->step *= factor;
    model.gravity->step_without_forces *= factor;
  }
  if (!model.contact) return;
  for (auto& m : model.contact->materials) m.step *= factor;
}

}  // namespace noli::audit
