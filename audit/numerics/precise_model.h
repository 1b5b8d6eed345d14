// SPDX-License-Identifier: Apache-2.0
//
// The model of a run, its numbers converted one by one: what a scene was rounded to when it was built is part of the
// scene, so all precisions integrate the same thing.
//
// What this does not do: it builds no model (integrator/scene/build_model.h), and computes nothing again.
#pragma once

#include <tuple>
#include <utility>
#include <vector>

#include "integrator/model.h"

namespace noli::audit {

template <class S, int Dim>
integrator::Vec<S, Dim> precise(const integrator::Vec<double, Dim>& x) {
  integrator::Vec<S, Dim> result;
  for (int k = 0; k < Dim; ++k) result[k] = S(x[k]);
  return result;
}

template <class S, int Dim>
std::vector<integrator::Vec<S, Dim>> precise(const std::vector<integrator::Vec<double, Dim>>& all) {
  std::vector<integrator::Vec<S, Dim>> result;
  result.reserve(all.size());
  for (const auto& x : all) result.push_back(precise<S, Dim>(x));
  return result;
}

template <class S>
integrator::Angle<S> precise(const integrator::Angle<double>& angle) {
  return {S(angle.cosine), S(angle.sine)};
}

template <class S, int Dim>
integrator::EdgeSpring<S, Dim> precise(const integrator::EdgeSpring<double, Dim>& f) {
  return {f.vertices, S(f.constant), S(f.rest_length), S(f.damping)};
}

template <class S>
integrator::Membrane<S> precise(const integrator::Membrane<double>& f) {
  return {f.vertices, S(f.b11), S(f.b12), S(f.b22), S(f.shear), S(f.dilation), S(f.damping)};
}

template <class S>
integrator::Hinge<S> precise(const integrator::Hinge<double>& f) {
  return {f.vertices, S(f.constant), precise<S>(f.rest), S(f.damping)};
}

template <class S>
integrator::Turning<S> precise(const integrator::Turning<double>& f) {
  return {f.vertices, S(f.constant), precise<S>(f.rest), S(f.damping)};
}

template <class S, class From, class To>
void precise_list(const integrator::ForceList<From>& from, integrator::ForceList<To>& to) {
  to.steps = from.steps;
  to.forces.reserve(from.forces.size());
  for (const From& force : from.forces) to.forces.push_back(precise<S>(force));
}

template <class S, class From, class To, std::size_t... I>
void precise_lists(const From& from, const To& to, std::index_sequence<I...>) {
  (precise_list<S>(std::get<I>(from), std::get<I>(to)), ...);
}

template <class S, int Dim>
integrator::Model<S, Dim> precise(const integrator::Model<double, Dim>& model) {
  integrator::Model<S, Dim> result;
  result.mesh = model.mesh;
  result.x = precise<S, Dim>(model.x);
  result.v = precise<S, Dim>(model.v);
  for (const double m : model.mass) result.mass.push_back(S(m));
  result.pinned = model.pinned;
  for (const auto& script : model.scripts) {
    result.scripts.push_back({script.vertex, script.times, precise<S, Dim>(script.positions)});
  }
  if (model.gravity) result.gravity = {precise<S, Dim>(model.gravity->acceleration), model.gravity->step};
  const auto from = model.forces.lists();
  precise_lists<S>(from, result.forces.lists(), std::make_index_sequence<std::tuple_size_v<decltype(from)>>{});
  result.window_length = model.window_length;
  result.clocks = model.clocks;
  result.contact = model.contact;
  return result;
}

}  // namespace noli::audit
