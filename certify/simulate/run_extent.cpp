// SPDX-License-Identifier: Apache-2.0
#include "certify/simulate/run_extent.h"

#include <fmt/format.h>

#include <noli/errors.h>
#include "integrator/scene/scene.h"

namespace noli {

std::uint64_t windows_of(const SimulateRequest& request, const integrator::Scene& scene) {
  constexpr double most = 0x1p53;
  const double windows = integrator::windows_up_to(request.until.value_or(scene.duration), scene.window);
  const std::string too_many = fmt::format("expected fewer than 2^53 windows of {} s", scene.window);
  if (!(windows < most) && request.until) throw UsageError("--until: " + too_many);
  if (!(windows < most)) throw InputError(request.scene.string(), "/duration", too_many);
  if (request.until && !request.past_duration && windows > integrator::windows_up_to(scene.duration, scene.window)) {
    throw UsageError(
        fmt::format("--until {}: {} has a duration of {} s; expected no later time, or --past-duration to go beyond it",
                    *request.until, request.scene.string(), scene.duration));
  }
  return static_cast<std::uint64_t>(windows);
}

void require_countable_frames(const SimulateRequest& request, const integrator::Scene& scene, std::size_t vertices,
                              std::uint64_t windows) {
  const double time = static_cast<double>(windows) * scene.window;
  const auto refuse = [&](const std::string& problem) {
    throw InputError(request.scene.string(), "/frame_rate", problem);
  };
  if (!(time * scene.frame_rate < 0x1p53)) refuse(fmt::format("expected fewer than 2^53 frames in {} s", time));
  if (scene.record == integrator::Record::full) return;
  constexpr double most = 0x1p32;
  const double bytes = 24.0 * static_cast<double>(vertices) * scene.window * scene.frame_rate;
  if (bytes <= most) return;
  refuse(
      fmt::format("the frames of a window take about {:.2g} bytes; expected at most {:.2g}, as with frame_rate {:.2g}",
                  bytes, most, scene.frame_rate * most / bytes));
}

}  // namespace noli
