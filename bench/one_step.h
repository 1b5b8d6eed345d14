// SPDX-License-Identifier: Apache-2.0
//
// A model whose forces all have one step: what a synchronous loop would have to take.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "noli/integrator/groups.h"
#include "noli/integrator/model.h"

namespace noli::bench {

template <int Dim, class Each>
void for_each_list(integrator::Model<double, Dim>& model, const Each& each) {
  std::apply([&](auto&... list) { (each(list), ...); }, model.forces.lists());
}

/// The least step of a force, rounded down to those of groups.
template <int Dim>
double least_step(integrator::Model<double, Dim>& model) {
  double least = std::numeric_limits<double>::infinity();
  for_each_list(model, [&](auto& list) {
    for (const double h : list.steps) least = std::min(least, h);
  });
  return std::ldexp(model.window_length, -integrator::step_exponent(least, model.window_length));
}

/// Gives all forces this step.
template <int Dim>
void set_steps(integrator::Model<double, Dim>& model, double step) {
  for_each_list(model, [step](auto& list) { std::fill(list.steps.begin(), list.steps.end(), step); });
}

}  // namespace noli::bench
