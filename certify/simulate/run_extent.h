// SPDX-License-Identifier: Apache-2.0
//
// Counts how much a run will write, and refuses what could not be counted or kept.
#pragma once

#include <cstdint>

#include <noli/simulate.h>
#include "integrator/scene/scene.h"

namespace noli {

/// The number of windows of the whole run. Throws UsageError (--until) or InputError (the scene's duration) when they
/// are too many to count, and UsageError when --until is beyond the scene's duration without --past-duration.
std::uint64_t windows_of(const SimulateRequest& request, const integrator::Scene& scene);

/// Requires that frames have different times, and that the recorded frames of a window fit into memory. Throws
/// InputError.
void require_countable_frames(const SimulateRequest& request, const integrator::Scene& scene, std::size_t vertices,
                              std::uint64_t windows);

}  // namespace noli
