// SPDX-License-Identifier: Apache-2.0
//
// Windows of runs as dicts.
#pragma once

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <array>
#include <string>

#include "certify/runs/run_series.h"
#include "python/src/arrays.h"
#include "trajectory/blocks/run_file.h"

namespace noli::python {

inline pybind11::dict by_kind(const std::array<double, force_kinds>& numbers) {
  pybind11::dict named;
  for (std::size_t k = 0; k < force_kinds; ++k) {
    named[pybind11::str(std::string(name(static_cast<ForceKind>(k))))] = numbers[k];
  }
  return named;
}

inline pybind11::dict energies_of(const SeriesRow& row) {
  pybind11::dict energies;
  energies["kinetic"] = row.kinetic_mean;
  energies["potential"] = by_kind(row.potential);
  energies["total"] = row.energy();
  energies["damping_work"] = by_kind(row.damping_work);
  energies["held_work"] = by_kind(row.held_work);
  energies["restitution_work"] = row.restitution_work;
  energies["integration"] = row.integration;
  return energies;
}

/// `row`: nothing in a run that has none.
inline pybind11::dict window_of(const RunWindow& window, const SeriesRow* row) {
  pybind11::dict found;
  found["index"] = window.index + 1;
  found["begin"] = window.begin;
  found["end"] = window.end;
  found["positions"] = array_of(window.positions);
  found["velocities"] = array_of(window.velocities);
  found["energies"] = row == nullptr ? pybind11::dict() : energies_of(*row);
  found["momentum"] = row == nullptr ? pybind11::list() : pybind11::cast(row->momentum);
  found["angular_momentum"] = row == nullptr ? pybind11::list() : pybind11::cast(row->angular_momentum);
  pybind11::list frames;
  for (const RunFrame& frame : window.frames)
    frames.append(pybind11::make_tuple(frame.time, array_of(frame.positions)));
  found["frames"] = frames;
  return found;
}

}  // namespace noli::python
