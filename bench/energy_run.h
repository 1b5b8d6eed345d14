// SPDX-License-Identifier: Apache-2.0
//
// A run by which its error in energy can be seen beside what it took.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "noli/bench/timing.h"
#include "noli/integrator/simulation.h"

namespace noli::bench {

struct EnergyRun {
  std::uint64_t events = 0;
  std::uint64_t impulses = 0;  ///< of layers of contact
  double seconds = 0;
  double energy_error = 0;  ///< the largest difference from the beginning at the ends of windows, in parts of that
};

inline double energy(const integrator::Simulation<double, 3>& simulation) {
  const auto state = simulation.state();
  return state.kinetic_mean + state.potential_sum();
}

inline EnergyRun run_for_energy(const integrator::Model<double, 3>& model, int windows) {
  integrator::Simulation<double, 3> simulation(model);
  integrator::Books<double, 3> books;
  const double start = energy(simulation);
  EnergyRun result;
  for (int i = 0; i < windows; ++i) {
    const double begin = seconds();
    simulation.run_window(books);
    result.seconds += seconds() - begin;
    result.energy_error = std::max(result.energy_error, std::abs(energy(simulation) - start) / start);
  }
  result.events = simulation.events();
  result.impulses = books.of(integrator::ForceKind::contact).events;
  return result;
}

}  // namespace noli::bench
