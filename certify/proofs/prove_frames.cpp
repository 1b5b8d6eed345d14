// SPDX-License-Identifier: Apache-2.0
#include "certify/proofs/prove_frames.h"

#include <set>

#include "certify/proofs/claim.h"
#include "proofs/prover/cells/features.h"

namespace noli {
namespace {

/// The groups of cells, and those excluded pairs of groups that both have cells.
CellLabels labels_of_frames(const Mesh& mesh, const Exclusions* exclusions) {
  CellLabels labels{std::vector<std::uint32_t>(mesh.cell_count(), 0), {}};
  if (exclusions == nullptr) return labels;
  for (std::uint32_t c = 0; c < labels.of.size(); ++c) labels.of[c] = exclusions->groups[corners(mesh, c)[0]];
  const std::set<std::uint32_t> there(labels.of.begin(), labels.of.end());
  for (const auto& [a, b] : exclusions->pairs) {
    if (there.count(a) + there.count(b) == 2) labels.excluded.insert({a, b});
  }
  return labels;
}

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

Claim claim_of_frames(const VerifyRequest& request, const VerifyOutcome& outcome, const Mesh& mesh,
                      const Exclusions* exclusions) {
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
  const CellLabels labels = labels_of_frames(mesh, exclusions);
  set_cells(claim, mesh, labels.of, labels.excluded);
  return claim;
}

std::unique_ptr<StepProofs> proof_of_frames(const VerifyRequest& request, const Claim& claim, const Mesh& mesh,
                                            const IdenticalVertices* classes, const Exclusions* exclusions) {
  return std::make_unique<StepProofs>(
      mesh, header_of(request, claim, classes), labels_of_frames(mesh, exclusions),
      [&](const ProofHeader& header) { return ProofFile(request.open_proof(claim), header); });
}

}  // namespace noli
