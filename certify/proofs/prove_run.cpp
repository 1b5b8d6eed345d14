// SPDX-License-Identifier: Apache-2.0
#include "certify/proofs/prove_run.h"

#include <noli/errors.h>
#include "trajectory/stop.h"

namespace noli {
namespace {

CellLabels labels_of_scene(const RunScene& scene) { return labels_of_run(scene.mesh, scene.labels, scene.exclusions); }

ProofHeader header_of(const RunScene& scene, const RunProof::Claim& claim) {
  ProofHeader header;
  header.source = ProofSource::run;
  header.dimension = static_cast<int>(scene.header.dimension);
  header.strict = claim.strict;
  header.eta = claim.eta;
  header.ring = claim.ring;
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
  const CellLabels labels = labels_of_scene(scene);
  set_cells(claim, scene.mesh, labels.of, labels.excluded);
}

std::filesystem::path proof_path(const std::filesystem::path& run_folder) { return run_folder / "proof.blocks"; }

RunProof::RunProof(std::unique_ptr<Sink> sink, const RunScene& scene, const WindowVerifier& verifier,
                   const Claim& claim)
    : RunProof(scene, verifier, claim, [&](const ProofHeader& header) { return ProofFile(std::move(sink), header); }) {}

RunProof::RunProof(const RunScene& scene, const WindowVerifier& verifier, const Claim& claim,
                   const StepProofs::Open& open)
    : scene_(scene), verifier_(verifier), proofs_(scene_.mesh, header_of(scene, claim), labels_of_scene(scene), open) {}

std::unique_ptr<RunProof> RunProof::resume(const std::filesystem::path& run_folder, std::uint64_t windows,
                                           const RunScene& scene, const WindowVerifier& verifier,
                                           const VerifyOptions& options) {
  const std::filesystem::path file = proof_path(run_folder);
  // Before the first window nothing was told of the proof, and a loss of power may have left any part of it.
  const CommitPoint committed = windows == 0 ? CommitPoint{} : last_commit(file, windows + 1);
  if (committed.groups == 0) std::filesystem::remove(file);  // there is none, or not even its claim was written
  auto sink =
      std::make_unique<FileSink>(file, committed.groups == 0 ? FileSink::Open::create : FileSink::Open::existing);
  std::unique_ptr<RunProof> proof(new RunProof(scene, verifier, {}, [&](const ProofHeader& header) {
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
  return proofs_.prove({window, lines, 0, hash}, verifier_, options);
}

bool RunProof::refute(std::uint64_t window, const WorldLines& lines, const Sha256Digest& hash,
                      const WindowResult& result) {
  std::optional<FeatureContact> first;
  if (result.first) first = result.first->contact;
  return proofs_.refute({window, lines, 0, hash}, first, result);
}

bool RunProof::refute(std::uint64_t window, const WorldLines& lines, const Sha256Digest& hash, const TooNear& near) {
  return proofs_.refute({window, lines, 0, hash}, near);
}

}  // namespace noli
