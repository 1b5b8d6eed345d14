// SPDX-License-Identifier: Apache-2.0
#include "certify/proofs/prove_frames.h"

#include <algorithm>
#include <set>

#include "certify/proofs/claim.h"
#include "proofs/prover/cells/features.h"

namespace noli {
namespace {

/// The groups of cells, and those pairs of them that have cells on both sides.
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

ProofFile make_file(const VerifyRequest& request, const Claim& claim, int dimension, const Mesh& mesh,
                    const IdenticalVertices* classes, const CellLabels& labels) {
  ProofHeader header;
  header.source = request.constant_motion ? ProofSource::frames_at_rest : ProofSource::frames;
  header.dimension = dimension;
  header.strict = request.strict;
  header.points = request.points;
  header.eta = request.min_distance;
  header.ring = request.ring;
  header.vertices = mesh.vertex_count;
  header.mesh = &mesh;
  header.labels = labels.of;
  header.cells = digest_of_hex(claim.cells);
  header.excluded = labels.excluded;
  if (classes != nullptr) {
    const auto& same = classes->representative();
    for (VertexId v = 0; v < same.size(); ++v) {
      if (same[v] != v) header.merged.push_back({v, same[v]});
    }
  }
  return {request.open_proof(claim), header};
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

FrameProof::FrameProof(const VerifyRequest& request, const Claim& claim, int dimension, const Mesh& mesh,
                       const IdenticalVertices* classes, const Exclusions* exclusions, std::span<const Position> x)
    : mesh_(mesh),
      dimension_(dimension),
      eta_(request.min_distance),
      ring_(request.ring),
      strict_(request.strict),
      rest_(request.constant_motion),
      labels_(labels_of_frames(mesh, exclusions)),
      paths_(mesh, request.ring),
      file_(make_file(request, claim, dimension, mesh, classes, labels_)) {
  if (is_by_verifier(request)) return;
  WindowOptions options;
  options.dimension = dimension;
  options.strict = request.strict;
  options.exclusions = exclusions;
  prover_.emplace(mesh, x, options);
}

void FrameProof::write(std::size_t step, std::span<const Position> x_t0, std::span<const Position> x_t1,
                       const StepProof& proof) {
  begin(step, ProofFile::Kind::proof, WorldLines::from_frames(x_t0, x_t1));
  if (leaf_cells_ != proof.leaf_cells) file_.tree(encoded_tree(proof.leaf_cells));
  file_.tokens(proof.tokens);
  file_.commit();
  leaf_cells_ = proof.leaf_cells;
}

bool FrameProof::prove(std::size_t step, std::span<const Position> x_t0, std::span<const Position> x_t1,
                       const VerifyOptions& options) {
  const WorldLines lines = WorldLines::from_frames(x_t0, x_t1);
  begin(step, ProofFile::Kind::proof, lines);
  if (!tree_written_) file_.tree(prover_->encoded_tree());
  const LeastDistance distance{eta_, &paths_};
  if (!file_.tokens([&](const auto& take) { return prover_->prove(lines, options, distance, take); })) return false;
  file_.commit();
  tree_written_ = true;
  return true;
}

void FrameProof::begin(std::size_t step, ProofFile::Kind kind, const WorldLines& lines) {
  file_.begin_step(step, kind, lines, shift(step));
}

bool FrameProof::refute(std::size_t step, std::span<const Position> x_t0, std::span<const Position> x_t1,
                        const StepResult& result) {
  const WorldLines lines = WorldLines::from_frames(x_t0, x_t1);
  const auto first = result.first ? std::optional(result.first->contact) : std::nullopt;
  return write_witness(step, lines, witness_of(what(step, lines), first, result.initial_reports, result.reports));
}

bool FrameProof::refute(std::size_t step, std::span<const Position> x_t0, std::span<const Position> x_t1,
                        const TooNear& near) {
  const WorldLines lines = WorldLines::from_frames(x_t0, x_t1);
  return write_witness(step, lines, witness_of(what(step, lines), near, paths_));
}

WitnessStep FrameProof::what(std::size_t step, const WorldLines& lines) const {
  return {mesh_, lines, shift(step), dimension_, strict_, eta_, ring_, &labels_};
}

bool FrameProof::write_witness(std::size_t step, const WorldLines& lines, const std::optional<std::string>& witness) {
  if (!witness) return false;
  begin(step, ProofFile::Kind::witness, lines);
  file_.witness(*witness);
  file_.commit();
  return true;
}

}  // namespace noli
