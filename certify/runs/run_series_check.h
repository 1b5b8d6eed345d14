// SPDX-License-Identifier: Apache-2.0
//
// Whether the numbers of a row can be those of its window. What the motion decides is compared with it; the rest is
// held within what the integrator can do.
//
// What this does not do: energies, momenta and works may be any doubles, which overflow where velocities do not; only
// `integration` is compared with them, in all rows but the first.
#pragma once

#include <cstdint>
#include <span>

#include "certify/runs/run_series.h"
#include "trajectory/blocks/run_file.h"

namespace noli {

/// `before`: the row of the window before, none for the first. Throws std::invalid_argument, one line without place.
void check_row(const SeriesRow& row, const RunWindow& window, const RunScene& scene, const SeriesRow* before);
/// The same of what friction remembers at the window's end.
void check_anchors(std::span<const integrator::Anchor<double>> anchors, const RunWindow& window, const RunScene& scene);

}  // namespace noli
