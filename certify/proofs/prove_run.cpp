// SPDX-License-Identifier: Apache-2.0
#include "certify/proofs/prove_run.h"

#include <utility>

#include "trajectory/stop.h"

namespace noli {
namespace {

CellLabels labels_of_scene(const RunScene& scene) { return labels_of_run(scene.mesh, scene.labels, scene.exclusions); }

std::unique_ptr<StepProofs> open_proof(const RunScene& scene, const Claim& claim, const StepProofs::Open& open) {
  ProofHeader header;
  header.source = ProofSource::run;
  header.dimension = static_cast<int>(scene.header.dimension);
  header.strict = claim.strict;
  header.eta = claim.distance;
  header.ring = claim.ring;
  return std::make_unique<StepProofs>(scene.mesh, std::move(header), labels_of_scene(scene), open);
}

/// The end of the last group of a proof, or of group number `groups` if it has more.
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
  const CellLabels labels = labels_of_scene(scene);
  set_cells(claim, scene.mesh, labels.of, labels.excluded);
}

std::filesystem::path proof_path(const std::filesystem::path& run_folder) { return run_folder / "proof.blocks"; }

std::unique_ptr<StepProofs> proof_of_run(std::unique_ptr<Sink> sink, const RunScene& scene, const Claim& claim) {
  return open_proof(scene, claim, [&](const ProofHeader& header) { return ProofFile(std::move(sink), header); });
}

std::unique_ptr<StepProofs> resumed_proof_of_run(const std::filesystem::path& run_folder, std::uint64_t windows,
                                                 const RunScene& scene, const WindowVerifier& verifier,
                                                 const VerifyOptions& options) {
  const std::filesystem::path file = proof_path(run_folder);
  // Before the first window nothing else mentions the proof, and a loss of power may have left any part of it.
  const CommitPoint committed = windows == 0 ? CommitPoint{} : last_commit(file, windows + 1);
  if (committed.groups == 0) std::filesystem::remove(file);  // there is no proof, or not even its claim was written
  auto sink =
      std::make_unique<FileSink>(file, committed.groups == 0 ? FileSink::Open::create : FileSink::Open::existing);
  std::unique_ptr<StepProofs> proof = open_proof(scene, {}, [&](const ProofHeader& header) {
    return committed.groups == 0 ? ProofFile(std::move(sink), header) : ProofFile(std::move(sink), committed, header);
  });
  const std::uint64_t proved = std::max<std::uint64_t>(committed.groups, 1) - 1;
  RunReader reader(run_folder);
  for (std::uint64_t i = 0; i < windows && proved < windows; ++i) {
    const auto window = reader.next_window();
    if (i < proved) continue;
    const MotionStep step{i, *window->lines, 0, window->group_hash};
    if (!proof->prove(step, verifier, options)) throw ReadInterrupted(file.string());
    proof->commit();
  }
  return proof;
}

}  // namespace noli
