// SPDX-License-Identifier: Apache-2.0
#include "proofs/prover/cells/labels.h"

#include "trajectory/cell_features.h"

namespace noli {

namespace {

bool left_out(std::uint32_t a, std::uint32_t b, const Exclusions& exclusions) {
  const auto group = [](std::uint32_t label) { return static_cast<std::uint16_t>(label / 2); };
  return (a % 2 == 1 && b % 2 == 1) || (!exclusions.empty() && exclusions.excluded(group(a), group(b)));
}

std::vector<std::uint32_t> run_labels(const Mesh& mesh, std::span<const std::uint8_t> scripted,
                                      const Exclusions& exclusions) {
  std::vector<std::uint32_t> labels;
  labels.reserve(mesh.cell_count());
  for (std::uint32_t cell = 0; cell < mesh.cell_count(); ++cell) {
    const auto [a, b, c] = corners(mesh, cell);
    const bool all = !scripted.empty() && scripted[a] != 0 && scripted[b] != 0 && scripted[c] != 0;
    const std::uint32_t group = exclusions.empty() ? 0 : exclusions.groups[a];
    labels.push_back(2 * group + (all ? 1 : 0));
  }
  return labels;
}

}  // namespace

CellLabels labels_of_run(const Mesh& mesh, std::span<const std::uint8_t> scripted, const Exclusions& exclusions) {
  CellLabels labels{run_labels(mesh, scripted, exclusions), {}};
  const std::set<std::uint32_t> there(labels.of.begin(), labels.of.end());
  for (const std::uint32_t a : there) {
    for (const std::uint32_t b : there) {
      if (a <= b && left_out(a, b, exclusions)) labels.excluded.insert({a, b});
    }
  }
  return labels;
}

}  // namespace noli
