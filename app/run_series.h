// SPDX-License-Identifier: Apache-2.0
//
// What a run says about each of its windows: energies, momenta, works, counts. Stored with the window, as bytes that
// trajectory/FORMAT.md calls its writer's own, so that a run that is resumed has the whole series.
//
// Bytes: for each field in the order of SeriesRow, little-endian, 8 each: doubles, then the three counts.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "noli/integrator/simulation.h"
#include "noli/trajectory/run_file.h"

namespace noli::app {

struct SeriesRow {
  double time = 0;  ///< the window's end [s]
  double kinetic = 0, kinetic_mean = 0;
  std::array<double, integrator::force_kinds> potential{};
  std::array<double, integrator::force_kinds> work{};          ///< of the conservative impulses within the window [J]
  std::array<double, integrator::force_kinds> damping_work{};  ///< [J]
  std::array<double, 3> momentum{};                            ///< [N s]
  std::array<double, 3> angular_momentum{};                    ///< in the plane the third [N m s]
  std::uint64_t events = 0, breakpoints = 0;
  std::uint64_t halvings = 0;  ///< of the steps of all contact layers, after windows that had to be run again

  friend bool operator==(const SeriesRow&, const SeriesRow&) = default;
};

/// Bytes of a row.
std::string encode(const SeriesRow& row);
/// Throws std::invalid_argument when the bytes are no row.
SeriesRow decode_row(std::string_view bytes);

/// Of a window that was read from a run. Throws InputError.
SeriesRow row_of(const RunWindow& window, const std::filesystem::path& run);

template <int Dim>
SeriesRow series_row(double time, const integrator::State<double, Dim>& state,
                     const integrator::Books<double, Dim>& books, std::uint64_t events, std::uint64_t breakpoints) {
  SeriesRow row;
  row.time = time;
  row.kinetic = state.kinetic;
  row.kinetic_mean = state.kinetic_mean;
  row.potential = state.potential;
  for (std::size_t i = 0; i < integrator::force_kinds; ++i) {
    row.work[i] = books.accounts[i].work;
    row.damping_work[i] = books.accounts[i].damping_work;
  }
  for (int k = 0; k < Dim; ++k) row.momentum[static_cast<std::size_t>(k)] = state.momentum[k];
  constexpr int moments = Dim == 3 ? 3 : 1;
  for (int k = 0; k < moments; ++k) {
    row.angular_momentum[static_cast<std::size_t>(k + 3 - moments)] = state.angular_momentum[k];
  }
  row.events = events;
  row.breakpoints = breakpoints;
  return row;
}

}  // namespace noli::app
