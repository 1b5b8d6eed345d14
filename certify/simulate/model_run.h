// SPDX-License-Identifier: Apache-2.0
//
// Converts between what a run integrates and what it writes.
#pragma once

#include <cmath>
#include <vector>

#include "certify/runs/run_series.h"
#include "integrator/simulation.h"
#include "trajectory/blocks/run_file.h"

namespace noli {

template <int Dim>
std::vector<Position> positions_of(const std::vector<integrator::Vec<double, Dim>>& all) {
  std::vector<Position> result;
  result.reserve(all.size());
  for (const auto& x : all) result.push_back({x[0], x[1], Dim == 3 ? x[Dim - 1] : 0.0});
  return result;
}

template <int Dim>
std::vector<integrator::Vec<double, Dim>> vectors_of(const std::vector<Position>& all) {
  std::vector<integrator::Vec<double, Dim>> result;
  result.reserve(all.size());
  for (const Position& x : all) {
    integrator::Vec<double, Dim> v;
    for (int k = 0; k < Dim; ++k) v[k] = x[static_cast<std::size_t>(k)];
    result.push_back(v);
  }
  return result;
}

/// The state at the end of a window that was read. `state`: that of the window.
template <int Dim>
integrator::Snapshot<double, Dim> snapshot_of(const RunWindow& window, const WindowState& state) {
  return {window.index + 1, window.end, vectors_of<Dim>(window.positions), vectors_of<Dim>(window.velocities),
          state.anchors};
}

/// A simulation that goes on from a snapshot, or begins if the snapshot is of no window. With contact, the steps of its
/// layers are halved `halvings` times.
template <int Dim>
integrator::Simulation<double, Dim> simulation_at(const integrator::Model<double, Dim>& model,
                                                  const integrator::Snapshot<double, Dim>& snapshot,
                                                  std::uint64_t halvings = 0, std::uint32_t least_layers = 0) {
  integrator::Model<double, Dim> changed = model;
  if (changed.contact) {
    changed.contact->least_layers = least_layers;
    for (auto& material : changed.contact->materials)
      material.step = std::ldexp(material.step, -static_cast<int>(halvings));
  }
  if (snapshot.windows == 0) return integrator::Simulation<double, Dim>(std::move(changed));
  return integrator::Simulation<double, Dim>(std::move(changed), snapshot);
}

}  // namespace noli
