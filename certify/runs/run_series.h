// SPDX-License-Identifier: Apache-2.0
//
// What a run says about each of its windows: energies, momenta, works, counts, lengths of steps, and how near things
// came. Stored with the window, as bytes that trajectory/FORMAT.md calls its writer's own, so that a run that is
// resumed has the whole series. All of it follows from the motion: what certificates or clocks have to say is in the
// log.
//
// Bytes, all numbers little-endian of 8 bytes: the text "noli row", the version 2; then each field in the order of
// SeriesRow: doubles; events, breakpoints, halvings; the two layers, each as layer, material, pair, four vertices,
// time, distance; the least step, the number of bins, and for each its number (of a signed integer the two's
// complement) and its ticks.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include <noli/run.h>
#include "certify/runs/step_histogram.h"
#include "integrator/simulation.h"
#include "trajectory/world_lines.h"

namespace noli {

/// Bytes of a row.
std::string encode(const SeriesRow& row);
/// Why bytes are no row of this version, as those of an earlier one or of another program are not; empty if they are.
std::string not_a_row(std::string_view bytes);
/// Throws std::invalid_argument when the bytes are no row. Its numbers are not checked: run_series_reader.h does.
SeriesRow decode_row(std::string_view bytes);

ActingLayer acting_layer(const std::optional<integrator::LayerAction>& action);

/// `lines`: of the window; `fixed`: of each vertex, not 0 if it is pinned or scripted.
template <int Dim>
SeriesRow series_row(const integrator::Simulation<double, Dim>& simulation, const integrator::Books<double, Dim>& books,
                     std::uint64_t breakpoints, const WorldLines& lines, std::span<const std::uint8_t> fixed) {
  const integrator::State<double, Dim> state = simulation.state();
  SeriesRow row;
  row.time = simulation.time();
  row.kinetic = state.kinetic;
  row.kinetic_mean = state.kinetic_mean;
  row.potential = state.potential;
  for (std::size_t i = 0; i < integrator::force_kinds; ++i) {
    row.work[i] = books.accounts[i].work;
    row.damping_work[i] = books.accounts[i].damping_work;
    row.events[i] = books.accounts[i].events;
  }
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
