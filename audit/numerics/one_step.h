// SPDX-License-Identifier: Apache-2.0
//
// A model whose forces all have one step: what a synchronous loop would have to take.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "integrator/groups.h"
#include "integrator/model.h"

namespace noli::audit {

/// Calls each(list) of each kind of forces.
template <class Model, class Each>
void for_each_list(Model& model, const Each& each) {
  std::apply([&](auto&... list) { (each(list), ...); }, model.forces.lists());
}

/// The least step of a force, rounded down to those of groups; of a model without forces, that of its gravity, else a
/// window.
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

/// Gives all forces this step; gravity too, and all first layers of contact the shortest of theirs.
template <int Dim>
void set_steps(integrator::Model<double, Dim>& model, double step) {
  for_each_list(model, [step](auto& list) { std::fill(list.steps.begin(), list.steps.end(), step); });
  if (model.gravity) model.gravity->step = model.gravity->step_without_forces = step;
  if (!model.contact || model.contact->materials.empty()) return;
  double least = model.contact->materials.front().step;
  for (const auto& m : model.contact->materials) least = std::min(least, m.step);
  for (auto& m : model.contact->materials) m.step = least;
}

/// Makes all steps so many times longer, those of gravity and of layers too.
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
