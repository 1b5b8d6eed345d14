// SPDX-License-Identifier: Apache-2.0
//
// The proofs of a run's windows: of `noli simulate`, and of `noli verify RUN --proof OUT`.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <vector>

#include "noli/proofs/prover/proof_file.h"
#include "noli/proofs/prover/step_prover.h"
#include "noli/trajectory/run_file.h"

namespace noli::app {

/// The file in the folder of a run.
std::filesystem::path proof_path(const std::filesystem::path& run_folder);

class RunProof {
 public:
  /// A new file, which must not be there yet. `x`: positions at the beginning of the run, by which cells are put into a
  /// tree.
  RunProof(const std::filesystem::path& file, const RunScene& scene, std::span<const Position> x, bool strict);
  /// Goes on with the proof of a run of which so many windows are committed: cuts off what is about others, and proves
  /// those that it lacks. Throws InputError when the proof cannot be read.
  static std::unique_ptr<RunProof> resume(const std::filesystem::path& run_folder, std::uint64_t windows,
                                          const RunScene& scene, std::span<const Position> x,
                                          const VerifyOptions& options);

  /// Writes the proof of a window in which nothing touches; it does not count before commit(). `hash`: of its group in
  /// trajectory.blocks. False if it was stopped; that, and NoProof, leave the file as it was.
  bool prove(std::uint64_t window, const WorldLines& lines, const Sha256Digest& hash, const VerifyOptions& options);
  void commit();

 private:
  RunProof(const RunScene& scene, std::span<const Position> x, bool strict, const std::vector<std::uint32_t>& labels,
           const std::function<ProofFile(const ProofHeader&)>& open);

  StepProver prover_;
  ProofFile file_;
};

}  // namespace noli::app
