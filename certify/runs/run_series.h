// SPDX-License-Identifier: Apache-2.0
//
// The row of each window of a run: energies, momenta, works, counts, lengths of steps, and how near things came. It is
// stored with the window (as its writer's own bytes, trajectory/FORMAT.md), so that a resumed run has the whole series.
// All of it follows from the motion; certificates and clocks are in the log.
//
// Bytes, all numbers little-endian of 8 bytes:
//   1. The text "noli row", the version 7.
//   2. The number of anchors of friction at the window's end, and for each its material, layer, kind of pair, four
//      vertices, four weights, and the time up to which it lasts. They ascend by material, layer, kind and vertices.
//      A resumed run needs them (integrator/anchors.h).
//   3. Each field in the order of SeriesRow: doubles; events, breakpoints, halvings; the two layers, each as layer,
//      material, pair, four vertices, time, distance; the least step; the number of materials of contact, and for each
//      the works of its potential, of friction, of restitution; the number of scripts, and the work of each; the number
//      of bins, and for each its number (a signed integer in two's complement) and its ticks.
//
// The version is also that of the motion: a run that began with another version would go on differently. In version 6
// one anchor served all layers of a pair, without damping; in version 5 damping shortened no steps; version 4 had no
// anchors; in version 3 gravity had a clock of its own.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <noli/run.h>
#include "certify/runs/step_histogram.h"
#include "integrator/simulation.h"
#include "trajectory/world_lines.h"

namespace noli {

/// The row of a window, and the anchors of friction at its end.
struct WindowState {
  SeriesRow row;
  std::vector<integrator::Anchor<double>> anchors;
};

/// The bytes of a row and its anchors.
std::string encode(const SeriesRow& row, std::span<const integrator::Anchor<double>> anchors);
/// Why bytes are not a row of this version (but of an earlier one or of another program); empty if they are.
std::string not_a_row(std::string_view bytes);
/// Throws std::invalid_argument when the bytes are not a row. Does not check numbers (run_series_reader.h does).
WindowState decode_state(std::string_view bytes);

ActingLayer acting_layer(const std::optional<integrator::LayerAction>& action);

/// The change of the energy that no booked work explains: SeriesRow::integration [J].
double left_of_change(const SeriesRow& row, double energy_before);

/// The works of a window.
template <int Dim>
void add_works(const integrator::Books<double, Dim>& books, SeriesRow& row) {
  for (std::size_t i = 0; i < integrator::force_kinds; ++i) {
    const auto& account = books.accounts[i];
    row.work[i] = account.work;
    row.damping_work[i] = account.damping_work;
    row.held_work[i] = account.held_work;
    row.restitution_work += account.restitution_work;
    row.events[i] = account.events;
  }
  for (const auto& account : books.contact) {
    row.contact_work.push_back({account.work, account.damping_work, account.restitution_work});
  }
  row.script_work = books.scripts;
}

/// `lines`: of the window; `fixed`: by vertex, nonzero if it is pinned or scripted; `energy_before`: of the previous
/// row, or at time 0.
template <int Dim>
SeriesRow series_row(const integrator::Simulation<double, Dim>& simulation, const integrator::Books<double, Dim>& books,
                     std::uint64_t breakpoints, const WorldLines& lines, std::span<const std::uint8_t> fixed,
                     double energy_before) {
  const integrator::State<double, Dim> state = simulation.state();
  SeriesRow row;
  row.time = simulation.time();
  row.kinetic = state.kinetic;
  row.kinetic_mean = state.kinetic_mean;
  row.potential = state.potential;
  row.held_ahead = state.held_ahead;
  add_works(books, row);
  row.integration = left_of_change(row, energy_before);
  for (int k = 0; k < Dim; ++k) row.momentum[static_cast<std::size_t>(k)] = state.momentum[k];
  constexpr int moments = Dim == 3 ? 3 : 1;
  for (int k = 0; k < moments; ++k) {
    row.angular_momentum[static_cast<std::size_t>(k + 3 - moments)] = state.angular_momentum[k];
  }
  row.breakpoints = breakpoints;
  const integrator::ContactExtremes extremes = simulation.extremes();
  row.deepest = acting_layer(extremes.deepest);
  row.nearest = acting_layer(extremes.nearest);
  row.steps = step_histogram(lines, fixed);
  return row;
}

}  // namespace noli
