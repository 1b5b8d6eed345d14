// SPDX-License-Identifier: Apache-2.0
//
// Whether the numbers of a row can be those of its window. What the motion decides is compared with it; the rest is
// held within what the integrator can do.
//
// What this does not do: energies, momenta and works may be any doubles. They overflow where velocities do not.
#pragma once

#include <cstdint>

#include "certify/runs/run_series.h"
#include "trajectory/blocks/run_file.h"

namespace noli {

/// `halvings`: those of the window before, 0 for the first. Throws std::invalid_argument, one line without the place.
void check_row(const SeriesRow& row, const RunWindow& window, const RunScene& scene, std::uint64_t halvings);

}  // namespace noli
