// SPDX-License-Identifier: Apache-2.0
//
// What a run says about each of its windows: energies, momenta, works, counts, lengths of steps, and how near things
// came. Stored with the window, as bytes that trajectory/FORMAT.md calls its writer's own, so that a run that is
// resumed has the whole series. All of it follows from the motion: what certificates or clocks have to say is in the
// log.
//
// Bytes, all numbers little-endian of 8 bytes: the text "noli row", the version 5; the number of anchors of friction at
// the window's end, and for each its kind of pair, four vertices, four weights, and the time up to which it lasts,
// which whoever resumes needs (integrator/anchors.h); then each field in the order of SeriesRow: doubles; events,
// breakpoints, halvings; the two layers, each as layer, material, pair, four vertices, time, distance; the least step;
// the number of materials of contact, and for each the works of its potential, of friction, of restitution; the number
// of scripts, and the work of each; the number of bins, and for each its number (of a signed integer the two's
// complement) and its ticks.
//
// The version is also that of the motion: a run that began with another one would go on differently. Version 4 had no
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

/// What a run says of a window, and what friction remembers at its end.
struct WindowState {
  SeriesRow row;
  std::vector<integrator::Anchor<double>> anchors;
};

/// Its bytes.
std::string encode(const SeriesRow& row, std::span<const integrator::Anchor<double>> anchors);
/// Why bytes are no row of this version, as those of an earlier one or of another program are not; empty if they are.
std::string not_a_row(std::string_view bytes);
/// Throws std::invalid_argument when the bytes are no row. Its numbers are not checked: run_series_reader.h does.
WindowState decode_state(std::string_view bytes);

ActingLayer acting_layer(const std::optional<integrator::LayerAction>& action);

/// Of the change of the energy, what nothing that is booked has given: SeriesRow::integration [J].
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

/// `lines`: of the window; `fixed`: of each vertex, not 0 if it is pinned or scripted; `energy_before`: of the row
/// before, or at time 0.
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
