// SPDX-License-Identifier: Apache-2.0
#include "noli/app/start_check.h"

#include <fmt/format.h>

namespace noli::app {

std::string contact_at_start(const WindowVerifier& verifier, const std::vector<Position>& x, WindowOptions options,
                             const BodyNames& names) {
  options.initial = true;
  options.stop = nullptr;
  options.deadline.reset();
  options.max_reports = 3;
  const WindowResult result = verifier.verify(WorldLines::from_frames(x, x), options);
  if (result.contact_count() + result.initial_intersections == 0) return "";
  std::string pairs;
  for (const auto& contact : result.reports) {
    pairs += fmt::format("{}{}", pairs.empty() ? "" : ", ", names.pair(contact.pair, contact.vertices, "meets"));
  }
  for (const auto& cells : result.initial_reports) {
    pairs += fmt::format("{}cells {} and {}", pairs.empty() ? "" : ", ", cells.first_cell, cells.second_cell);
  }
  return fmt::format("{}; {} pair(s) of features meet, {} pair(s) of cells intersect; expected none", pairs,
                     result.contact_count(), result.initial_intersections);
}

}  // namespace noli::app
