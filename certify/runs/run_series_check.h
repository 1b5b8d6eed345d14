// SPDX-License-Identifier: Apache-2.0
//
// Checks whether the numbers of a row can be those of its window. Numbers that follow from the motion are compared with
// it; the others must be possible for the integrator.
//
// Energies, momenta and works may be any doubles, as they can overflow when velocities do not. Only `integration` is
// compared with them, in all rows except the first.
#pragma once

#include <cstdint>
#include <span>

#include "certify/runs/run_series.h"
#include "trajectory/blocks/run_file.h"

namespace noli {

/// `before`: the row of the previous window, or null for the first. Throws std::invalid_argument, one line without
/// place.
void check_row(const SeriesRow& row, const RunWindow& window, const RunScene& scene, const SeriesRow* before);
/// The same for the anchors of friction at the window's end.
void check_anchors(std::span<const integrator::Anchor<double>> anchors, const RunWindow& window, const RunScene& scene);

}  // namespace noli
