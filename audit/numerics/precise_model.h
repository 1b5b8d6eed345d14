// SPDX-License-Identifier: Apache-2.0
//
// Converts a model from double to MPFR numbers, value by value. Nothing is recomputed from the scene: the rounding done
// by build_model is part of the model, so all precisions integrate the same one.
#pragma once

#include <tuple>
#include <utility>
#include <vector>

#include "audit/numerics/mpfr_number.h"
#include "integrator/model.h"

namespace noli::audit {

template <int Dim>
integrator::Vec<MpfrNumber, Dim> precise(const integrator::Vec<double, Dim>& x) {
  integrator::Vec<MpfrNumber, Dim> result;
  for (int k = 0; k < Dim; ++k) result[k] = MpfrNumber(x[k]);
  return result;
}

template <int Dim>
std::vector<integrator::Vec<MpfrNumber, Dim>> precise(const std::vector<integrator::Vec<double, Dim>>& all) {
  std::vector<integrator::Vec<MpfrNumber, Dim>> result;
  result.reserve(all.size());
  for (const auto& x : all) result.push_back(precise(x));
  return result;
}

inline integrator::Angle<MpfrNumber> precise(const integrator::Angle<double>& angle) {
  return {MpfrNumber(angle.cosine), MpfrNumber(angle.sine)};
}

template <int Dim>
integrator::EdgeSpring<MpfrNumber, Dim> precise(const integrator::EdgeSpring<double, Dim>& f) {
  return {f.vertices, MpfrNumber(f.constant), MpfrNumber(f.rest_length), MpfrNumber(f.damping)};
}

inline integrator::Membrane<MpfrNumber> precise(const integrator::Membrane<double>& f) {
  return {f.vertices,          MpfrNumber(f.b11),      MpfrNumber(f.b12),    MpfrNumber(f.b22),
          MpfrNumber(f.shear), MpfrNumber(f.dilation), MpfrNumber(f.damping)};
}

inline integrator::Hinge<MpfrNumber> precise(const integrator::Hinge<double>& f) {
  return {f.vertices, MpfrNumber(f.constant), precise(f.rest), MpfrNumber(f.damping)};
}

inline integrator::Turning<MpfrNumber> precise(const integrator::Turning<double>& f) {
  return {f.vertices, MpfrNumber(f.constant), precise(f.rest), MpfrNumber(f.damping)};
}

template <int Dim>
integrator::Model<MpfrNumber, Dim> precise(const integrator::Model<double, Dim>& model) {
  integrator::Model<MpfrNumber, Dim> result;
  result.mesh = model.mesh;
  result.x = precise(model.x);
  result.v = precise(model.v);
  for (const double m : model.mass) result.mass.push_back(MpfrNumber(m));
  result.pinned = model.pinned;
  for (const auto& script : model.scripts) {
    result.scripts.push_back({script.vertex, script.times, precise(script.positions), script.number});
  }
  if (model.gravity) {
    result.gravity = {precise(model.gravity->acceleration), model.gravity->step, model.gravity->step_without_forces};
  }
  const auto copy = [](const auto& from, auto& to) {
    to.forces.reserve(from.forces.size());
    for (const auto& force : from.forces) to.forces.push_back(precise(force));
    to.steps = from.steps;
  };
  const auto from = model.forces.lists();
  const auto to = result.forces.lists();
  const auto copy_all = [&]<std::size_t... I>(std::index_sequence<I...>) {
    (copy(std::get<I>(from), std::get<I>(to)), ...);
  };
  copy_all(std::make_index_sequence<std::tuple_size_v<decltype(from)>>{});
  result.window_length = model.window_length;
  result.clocks = model.clocks;
  result.contact = model.contact;
  return result;
}

}  // namespace noli::audit
