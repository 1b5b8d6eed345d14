// SPDX-License-Identifier: Apache-2.0
#include "certify/proofs/prove_frames.h"

#include <algorithm>
#include <set>

#include "certify/proofs/claim.h"
#include "proofs/prover/cells/features.h"
#include "proofs/prover/hierarchy.h"
#include "proofs/prover/witness/witness.h"

namespace noli {
namespace {

/// The groups of cells.
std::vector<std::uint32_t> labels_of(const Mesh& mesh, const Exclusions* exclusions) {
  std::vector<std::uint32_t> labels(mesh.cell_count(), 0);
  for (std::uint32_t c = 0; exclusions != nullptr && c < labels.size(); ++c) {
    labels[c] = exclusions->groups[corners(mesh, c)[0]];
  }
  return labels;
}

/// Those that have cells on both sides.
LabelPairs excluded_pairs(const std::vector<std::uint32_t>& labels, const Exclusions* exclusions) {
  LabelPairs pairs;
  if (exclusions == nullptr) return pairs;
  const std::set<std::uint32_t> there(labels.begin(), labels.end());
  for (const auto& [a, b] : exclusions->pairs) {
    if (there.count(a) + there.count(b) == 2) pairs.insert({a, b});
  }
  return pairs;
}

/// The tree has a part of its own for each label, in which neighbours are near each other.
StepProver make_prover(const VerifyRequest& request, int dimension, const Mesh& mesh, const Exclusions* exclusions,
                       std::span<const Position> x_t0, std::span<const Position> x_t1) {
  const Hierarchy hierarchy(mesh, x_t0, x_t1, dimension, request.threads);
  const std::vector<std::uint32_t> labels = labels_of(mesh, exclusions);
  const auto cells = hierarchy.leaf_cells();
  std::vector<std::uint32_t> order(cells.begin(), cells.end()), ends;
  std::ranges::stable_sort(order, {}, [&](std::uint32_t c) { return labels[c]; });
  for (std::size_t i = 1; i <= order.size(); ++i) {
    if (i == order.size() || labels[order[i]] != labels[order[i - 1]]) ends.push_back(static_cast<std::uint32_t>(i));
  }
  return StepProver(
      mesh, order, ends, labels,
      {dimension, request.strict, excluded_pairs(labels, exclusions), request.min_distance, request.ring});
}

ProofFile make_file(const VerifyRequest& request, const Claim& claim, int dimension, const Mesh& mesh,
                    const IdenticalVertices* classes, const Exclusions* exclusions) {
  ProofHeader header;
  header.source = request.constant_motion ? ProofSource::frames_at_rest : ProofSource::frames;
  header.dimension = dimension;
  header.strict = request.strict;
  header.points = request.points;
  header.eta = request.min_distance;
  header.ring = request.ring;
  header.vertices = mesh.vertex_count;
  header.mesh = &mesh;
  const std::vector<std::uint32_t> labels = labels_of(mesh, exclusions);
  header.labels = labels;
  header.cells = digest_of_hex(claim.cells);
  header.excluded = excluded_pairs(labels, exclusions);
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
  const std::vector<std::uint32_t> labels = labels_of(mesh, exclusions);
  set_cells(claim, mesh, labels, excluded_pairs(labels, exclusions));
  return claim;
}

FrameProof::FrameProof(const VerifyRequest& request, const Claim& claim, int dimension, const Mesh& mesh,
                       const IdenticalVertices* classes, const Exclusions* exclusions, std::span<const Position> x_t0,
                       std::span<const Position> x_t1)
    : mesh_(mesh),
      dimension_(dimension),
      eta_(request.min_distance),
      ring_(request.ring),
      strict_(request.strict),
      rest_(request.constant_motion),
      file_(make_file(request, claim, dimension, mesh, classes, exclusions)) {
  if (!is_by_verifier(request)) prover_.emplace(make_prover(request, dimension, mesh, exclusions, x_t0, x_t1));
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
  if (!tree_written_) file_.tree(prover_->tree().encoded());
  if (!prover_->write(file_, lines, options)) return false;
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
  const WitnessStep what{mesh_, lines, shift(step), dimension_, strict_, eta_, ring_, prover_ ? &*prover_ : nullptr};
  const auto first = result.first ? std::optional(result.first->contact) : std::nullopt;
  return write_witness(step, lines, witness_of(what, first, result.initial_reports, result.reports));
}

bool FrameProof::refute(std::size_t step, std::span<const Position> x_t0, std::span<const Position> x_t1,
                        const TooNear& near) {
  const WorldLines lines = WorldLines::from_frames(x_t0, x_t1);
  const WitnessStep what{mesh_, lines, shift(step), dimension_, strict_, eta_, ring_, &*prover_};
  return write_witness(step, lines, witness_of(what, near, MeshPaths(prover_->tree(), mesh_.vertex_count, ring_)));
}

bool FrameProof::write_witness(std::size_t step, const WorldLines& lines, const std::optional<std::string>& witness) {
  if (!witness) return false;
  begin(step, ProofFile::Kind::witness, lines);
  file_.witness(*witness);
  file_.commit();
  return true;
}

}  // namespace noli
