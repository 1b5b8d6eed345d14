// SPDX-License-Identifier: Apache-2.0
#include "certify/proofs/prove_frames.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "certify/proofs/claim.h"
#include "trajectory/cell_features.h"

namespace noli {
namespace {

std::vector<std::uint32_t> group_labels(const Mesh& mesh, const Exclusions* exclusions) {
  std::vector<std::uint32_t> labels(mesh.cell_count(), 0);
  if (exclusions == nullptr) return labels;
  for (std::uint32_t c = 0; c < labels.size(); ++c) labels[c] = exclusions->groups[corners(mesh, c)[0]];
  return labels;
}

/// Gives cells of the baseline labels of their own: one for all of a group that intersect the same cells.
void label_baseline(const std::vector<InitialIntersection>& baseline, std::vector<std::uint32_t>& labels) {
  if (baseline.empty()) return;
  const std::uint32_t first_free = *std::ranges::max_element(labels) + 1;
  std::map<std::uint32_t, std::vector<std::uint32_t>> partners;  // of each cell, ascending
  for (const auto& [a, b] : baseline) {
    partners[a].push_back(b);
    partners[b].push_back(a);
  }
  std::map<std::pair<std::uint32_t, std::vector<std::uint32_t>>, std::uint32_t> known;  // by group and partners
  for (auto& [cell, others] : partners) {
    std::ranges::sort(others);
    const auto next = static_cast<std::uint32_t>(first_free + known.size());
    labels[cell] = known.try_emplace({labels[cell], std::move(others)}, next).first->second;
  }
}

void exclude(std::uint32_t a, std::uint32_t b, LabelPairs& pairs) { pairs.insert({std::min(a, b), std::max(a, b)}); }

ProofHeader header_of(const VerifyRequest& request, const Claim& claim, const IdenticalVertices* classes) {
  ProofHeader header;
  header.source = request.constant_motion ? ProofSource::frames_at_rest : ProofSource::frames;
  header.dimension = claim.dimension;
  header.strict = request.strict;
  header.points = request.points;
  header.eta = request.min_distance;
  header.ring = request.ring;
  header.cells = digest_of_hex(claim.cells);
  if (classes != nullptr) {
    const auto& same = classes->representative();
    for (VertexId v = 0; v < same.size(); ++v) {
      if (same[v] != v) header.merged.push_back({v, same[v]});
    }
  }
  return header;
}

}  // namespace

CellLabels labels_of_frames(const Mesh& mesh, const Exclusions* exclusions,
                            const std::vector<InitialIntersection>& baseline) {
  const std::vector<std::uint32_t> groups = group_labels(mesh, exclusions);
  CellLabels labels{groups, {}};
  label_baseline(baseline, labels.of);
  for (const auto& [a, b] : baseline) exclude(labels.of[a], labels.of[b], labels.excluded);
  if (exclusions == nullptr) return labels;
  std::map<std::uint32_t, std::set<std::uint32_t>> of_group;
  for (std::size_t c = 0; c < groups.size(); ++c) of_group[groups[c]].insert(labels.of[c]);
  for (const auto& [a, b] : exclusions->pairs) {
    for (const std::uint32_t one : of_group[a]) {
      for (const std::uint32_t other : of_group[b]) exclude(one, other, labels.excluded);
    }
  }
  return labels;
}

Claim claim_of_frames(const VerifyRequest& request, const VerifyOutcome& outcome, const Mesh& mesh,
                      const CellLabels& labels) {
  Claim claim;
  claim.motion = request.constant_motion ? "rest" : "linear";
  claim.dimension = outcome.dimension;
  claim.steps = outcome.steps_total;
  claim.strict = request.strict;
  claim.points = request.points;
  claim.distance = request.min_distance;
  claim.ring = request.ring;
  claim.merged = outcome.merged_vertices;
  claim.to = request.constant_motion ? 1 : static_cast<double>(outcome.steps_total);
  set_cells(claim, mesh, labels.of, labels.excluded);
  return claim;
}

std::unique_ptr<StepProofs> proof_of_frames(const VerifyRequest& request, const Claim& claim, const Mesh& mesh,
                                            const IdenticalVertices* classes, const CellLabels& labels) {
  return std::make_unique<StepProofs>(mesh, header_of(request, claim, classes), labels, [&](const ProofHeader& header) {
    return ProofFile(request.open_proof(claim), header);
  });
}

}  // namespace noli
