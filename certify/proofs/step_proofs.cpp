// SPDX-License-Identifier: Apache-2.0
#include "certify/proofs/step_proofs.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "certify/proofs/largest_distance.h"
#include "certify/stopwatch.h"

namespace noli {
namespace {

ProofHeader with_labels(ProofHeader header, const Mesh& mesh, const CellLabels& labels) {
  header.mesh = &mesh;
  header.vertices = mesh.vertex_count;
  header.labels = labels.of;
  header.excluded = labels.excluded;
  return header;
}

}  // namespace

StepProofs::StepProofs(const Mesh& mesh, ProofHeader header, CellLabels labels, const Open& open)
    : mesh_(mesh),
      labels_(std::move(labels)),
      header_(with_labels(std::move(header), mesh, labels_)),
      paths_(mesh, header_.ring),
      file_(open(header_)),
      tree_due_(file_.committed().groups == 1) {}

void StepProofs::begin_chain() {
  tree_due_ = true;
  leaf_cells_.clear();
}

void StepProofs::commit() {
  file_.commit();
  tree_due_ = false;
}

bool StepProofs::prove(const MotionStep& step, const WindowVerifier& verifier, const VerifyOptions& options) {
  begin(step, ProofFile::Kind::proof);
  if (tree_due_) file_.tree(verifier.encoded_tree());
  const LeastDistance distance{header_.eta, &paths_};
  return file_.tokens([&](const auto& take) { return verifier.prove(step.lines, options, distance, take); });
}

void StepProofs::write(const MotionStep& step, const StepProof& proof) {
  Writer writer(*this, step);
  writer.tree(proof.leaf_cells);
  proof.tokens.give([&](std::string_view bytes) { writer.tokens(bytes); });
  writer.commit();
}

void StepProofs::Writer::tokens(std::string_view bytes) {
  const Stopwatch watch;
  if (!std::exchange(begun_, true)) begin();
  blocks_(bytes);
  seconds_ += watch.seconds();
}

void StepProofs::Writer::begin() {
  proofs_.begin(step_, ProofFile::Kind::proof);
  if (!std::ranges::equal(proofs_.leaf_cells_, leaf_cells_)) proofs_.file_.tree(encoded_tree(leaf_cells_));
}

void StepProofs::Writer::commit() {
  const Stopwatch watch;
  blocks_.flush();
  proofs_.leaf_cells_.assign(leaf_cells_.begin(), leaf_cells_.end());
  proofs_.commit();
  seconds_ += watch.seconds();
}

void StepProofs::Writer::discard() {
  if (begun_) proofs_.file_.discard();
}

bool StepProofs::copy(const MotionStep& step, const BlocksOfStep& blocks) {
  bool any = false;
  blocks([&](FourLetters kind, std::string_view payload) {
    any = true;
    // All windows of a run have the same tree.
    if (kind == ProofFile::tree_kind && header_.source == ProofSource::run && !tree_due_) return;
    if (kind != ProofFile::step_kind) return file_.append(kind, payload);
    const std::string own =
        file_.step_payload(step.number, ProofFile::kind_of(payload), step.lines, step.shift, step.hash);
    if (payload != own) throw std::invalid_argument("the proof is about another motion");
    file_.append(kind, payload);
  });
  if (any) commit();
  return any;
}

bool StepProofs::join(const MotionStep& step, const BlocksOfStep& parts) {
  bool any = false;
  const std::function<void(std::string_view)> put = [this](std::string_view payload) { file_.tokens(payload); };
  TokenBlocks tokens(put);
  parts([&](FourLetters kind, std::string_view payload) {
    if (!std::exchange(any, true)) begin(step, ProofFile::Kind::proof);
    kind == ProofFile::tree_kind ? file_.tree(payload) : tokens(payload);
  });
  tokens.flush();
  if (any) commit();
  return any;
}

bool StepProofs::refute(const MotionStep& step, const std::optional<FeatureContact>& first, const Findings& findings) {
  return write_witness(step, witness_of(what(step), first, findings.initial_reports, findings.reports));
}

bool StepProofs::refute(const MotionStep& step, const TooNear& near) {
  return write_witness(step, witness_of(what(step), near, paths_));
}

std::optional<LargestDistance> StepProofs::largest(const MotionStep& step, const WindowVerifier& verifier,
                                                   const VerifyOptions& options) const {
  return largest_distance(verifier, mesh_, beginning_of(step.lines), {header_.eta, &paths_}, options);
}

void StepProofs::begin(const MotionStep& step, ProofFile::Kind kind) {
  file_.begin_step(step.number, kind, step.lines, step.shift, step.hash);
}

WitnessStep StepProofs::what(const MotionStep& step) const {
  return {mesh_, step.lines, step.shift, header_.dimension, header_.strict, header_.eta, header_.ring, &labels_};
}

bool StepProofs::write_witness(const MotionStep& step, const std::optional<std::string>& witness) {
  if (!witness) return false;
  begin(step, ProofFile::Kind::witness);
  file_.witness(*witness);
  file_.commit();
  return true;
}

std::vector<Position> beginning_of(const WorldLines& lines) {
  std::vector<Position> x;
  for (VertexId v = 0; v < lines.vertex_count(); ++v) x.push_back(lines.positions(v).front());
  return x;
}

}  // namespace noli
