// SPDX-License-Identifier: Apache-2.0
#include "certify/proofs/prove_run.h"

#include <noli/errors.h>
#include "proofs/prover/cells/features.h"
#include "proofs/prover/windows/forest.h"
#include "trajectory/stop.h"

namespace noli {
namespace {

/// 2 g + s, as proofs/FORMAT.md has it.
std::vector<std::uint32_t> labels_of(const RunScene& scene) {
  std::vector<std::uint32_t> labels;
  for (std::uint32_t c = 0; c < scene.mesh.cell_count(); ++c) {
    const auto vertices = corners(scene.mesh, c);
    const std::size_t count = corner_count(scene.mesh, c);
    bool scripted = true;
    for (std::size_t i = 0; i < count; ++i) scripted = scripted && (scene.labels[vertices[i]] & scripted_vertex) != 0;
    const std::uint32_t group = scene.exclusions.empty() ? 0 : scene.exclusions.groups[vertices[0]];
    labels.push_back(2 * group + (scripted ? 1 : 0));
  }
  return labels;
}

/// Those pairs of labels that occur and are not compared.
LabelPairs excluded_pairs(const RunScene& scene, const std::vector<std::uint32_t>& labels) {
  const std::set<std::uint32_t> there(labels.begin(), labels.end());
  LabelPairs pairs;
  for (const std::uint32_t a : there) {
    for (const std::uint32_t b : there) {
      const bool scripted = a % 2 == 1 && b % 2 == 1;
      const auto group = [](std::uint32_t label) { return static_cast<std::uint16_t>(label / 2); };
      if (a <= b && (scripted || scene.exclusions.excluded(group(a), group(b)))) pairs.insert({a, b});
    }
  }
  return pairs;
}

StepProver make_prover(const RunScene& scene, std::span<const Position> x, const RunProof::Claim& claim,
                       const std::vector<std::uint32_t>& labels) {
  const int dimension = static_cast<int>(scene.header.dimension);
  const Forest forest(scene.mesh, x, {dimension, claim.strict, {}, nullptr});
  std::vector<std::uint32_t> order, ends;
  for (const Leaf& leaf : forest.leaves()) order.push_back(leaf.cell);
  for (const Tree& tree : forest.trees()) ends.push_back(tree.root.begin + tree.root.count);
  return StepProver(scene.mesh, order, ends, labels,
                    {dimension, claim.strict, excluded_pairs(scene, labels), claim.eta, claim.ring});
}

ProofHeader header_of(const RunScene& scene, const RunProof::Claim& claim, const std::vector<std::uint32_t>& labels) {
  ProofHeader header;
  header.source = ProofSource::run;
  header.dimension = static_cast<int>(scene.header.dimension);
  header.strict = claim.strict;
  header.eta = claim.eta;
  header.ring = claim.ring;
  header.vertices = scene.mesh.vertex_count;
  header.mesh = &scene.mesh;
  header.labels = labels;
  header.excluded = excluded_pairs(scene, labels);
  return header;
}

/// The end of the last group of a proof, or of that number if it has more.
CommitPoint last_commit(const std::filesystem::path& file, std::uint64_t groups) {
  std::error_code error;
  if (std::filesystem::file_size(file, error) < block_format::file_header_size || error) return {};
  BlockReader reader(file, ProofFile::content);
  while (reader.committed().groups < groups && reader.next()) {
  }
  return reader.committed();
}

}  // namespace

void set_cells_of_run(Claim& claim, const RunScene& scene) {
  const std::vector<std::uint32_t> labels = labels_of(scene);
  set_cells(claim, scene.mesh, labels, excluded_pairs(scene, labels));
}

std::filesystem::path proof_path(const std::filesystem::path& run_folder) { return run_folder / "proof.blocks"; }

RunProof::RunProof(std::unique_ptr<Sink> sink, const RunScene& scene, std::span<const Position> x, const Claim& claim)
    : RunProof(scene, x, claim, labels_of(scene),
               [&](const ProofHeader& header) { return ProofFile(std::move(sink), header); }) {}

RunProof::RunProof(const RunScene& scene, std::span<const Position> x, const Claim& claim,
                   const std::vector<std::uint32_t>& labels, const std::function<ProofFile(const ProofHeader&)>& open)
    : scene_(scene),
      claim_(claim),
      prover_(make_prover(scene, x, claim, labels)),
      file_(open(header_of(scene, claim, labels))) {}

std::unique_ptr<RunProof> RunProof::resume(const std::filesystem::path& run_folder, std::uint64_t windows,
                                           const RunScene& scene, std::span<const Position> x,
                                           const VerifyOptions& options) {
  const std::filesystem::path file = proof_path(run_folder);
  // Before the first window nothing was told of the proof, and a loss of power may have left any part of it.
  const CommitPoint committed = windows == 0 ? CommitPoint{} : last_commit(file, windows + 1);
  if (committed.groups == 0) std::filesystem::remove(file);  // there is none, or not even its claim was written
  auto sink =
      std::make_unique<FileSink>(file, committed.groups == 0 ? FileSink::Open::create : FileSink::Open::existing);
  std::unique_ptr<RunProof> proof(new RunProof(scene, x, {}, labels_of(scene), [&](const ProofHeader& header) {
    return committed.groups == 0 ? ProofFile(std::move(sink), header) : ProofFile(std::move(sink), committed, header);
  }));
  const std::uint64_t proved = std::max<std::uint64_t>(committed.groups, 1) - 1;
  RunReader reader(run_folder);
  for (std::uint64_t i = 0; i < windows && proved < windows; ++i) {
    const auto window = reader.next_window();
    if (i < proved) continue;
    if (!proof->prove(i, *window->lines, window->group_hash, options)) throw ReadInterrupted(file.string());
    proof->commit();
  }
  return proof;
}

bool RunProof::prove(std::uint64_t window, const WorldLines& lines, const Sha256Digest& hash,
                     const VerifyOptions& options) {
  file_.begin_step(window, ProofFile::Kind::proof, lines, 0, hash);
  if (file_.committed().groups == 1) file_.tree(prover_.tree().encoded());
  return prover_.write(file_, lines, options);
}

void RunProof::commit() { file_.commit(); }

WitnessStep RunProof::what(const WorldLines& lines) const {
  return {scene_.mesh,   lines,      0,           static_cast<int>(scene_.header.dimension),
          claim_.strict, claim_.eta, claim_.ring, &prover_};
}

bool RunProof::refute(std::uint64_t window, const WorldLines& lines, const Sha256Digest& hash,
                      const WindowResult& result) {
  std::optional<FeatureContact> first;
  if (result.first) first = result.first->contact;
  return write_witness(window, lines, hash, witness_of(what(lines), first, result.initial_reports, result.reports));
}

bool RunProof::refute(std::uint64_t window, const WorldLines& lines, const Sha256Digest& hash, const TooNear& near) {
  const MeshPaths paths(prover_.tree(), scene_.mesh.vertex_count, claim_.ring);
  return write_witness(window, lines, hash, witness_of(what(lines), near, paths));
}

bool RunProof::write_witness(std::uint64_t window, const WorldLines& lines, const Sha256Digest& hash,
                             const std::optional<std::string>& witness) {
  if (!witness) return false;
  file_.begin_step(window, ProofFile::Kind::witness, lines, 0, hash);
  file_.witness(*witness);
  file_.commit();
  return true;
}

}  // namespace noli
