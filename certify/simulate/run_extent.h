// SPDX-License-Identifier: Apache-2.0
//
// How much a run will write, and what is refused because it could not be counted or kept.
#pragma once

#include <cstdint>

#include <noli/simulate.h>
#include "integrator/scene/scene.h"

namespace noli {

/// Of the whole run. Throws UsageError (--until) or InputError (the scene's duration) when they are too many to count,
/// and UsageError when --until asks for more than the scene's duration has, without --past-duration.
std::uint64_t windows_of(const SimulateRequest& request, const integrator::Scene& scene);

/// Frames are told apart by their times, and those that are recorded are in memory for as long as their window is.
/// Throws InputError.
void require_countable_frames(const SimulateRequest& request, const integrator::Scene& scene, std::size_t vertices,
                              std::uint64_t windows);

}  // namespace noli
