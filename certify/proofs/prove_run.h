// SPDX-License-Identifier: Apache-2.0
//
// The proofs of a run's windows: of `noli simulate`, and of `noli verify RUN --proof OUT`.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <vector>

#include "certify/proofs/claim.h"
#include "certify/proofs/step_proofs.h"
#include "trajectory/blocks/run_file.h"

namespace noli {

/// The file in the folder of a run.
std::filesystem::path proof_path(const std::filesystem::path& run_folder);

/// What of a scene's cells is claimed: their hash, and the pairs that are not compared. `claim.strict` is set before.
void set_cells_of_run(Claim& claim, const RunScene& scene);

class RunProof {
 public:
  /// What is claimed beside what the scene says.
  struct Claim {
    bool strict = false;
    double eta = 0;          ///< the least distance
    std::uint32_t ring = 1;  ///< features that a path of fewer edges joins may be nearer than that
  };

  /// Writes to an empty sink. `verifier`: of the run, which has to outlive this.
  RunProof(std::unique_ptr<Sink> sink, const RunScene& scene, const WindowVerifier& verifier, const Claim& claim);
  /// Goes on with the proof of a run of which so many windows are committed: cuts off what is about others, and proves
  /// those that it lacks. Throws InputError when the proof cannot be read.
  static std::unique_ptr<RunProof> resume(const std::filesystem::path& run_folder, std::uint64_t windows,
                                          const RunScene& scene, const WindowVerifier& verifier,
                                          const VerifyOptions& options);

  /// Writes the proof of a window in which nothing touches; it does not count before commit(). `hash`: of its group in
  /// trajectory.blocks. False if it was stopped; that, and TooNear and NoProof, which it throws, leave the file as it
  /// was.
  bool prove(std::uint64_t window, const WorldLines& lines, const Sha256Digest& hash, const VerifyOptions& options);
  void commit() { proofs_.commit(); }

  /// Writes a witness for a window that has a contact, and commits it. False if none was found.
  bool refute(std::uint64_t window, const WorldLines& lines, const Sha256Digest& hash, const WindowResult& result);
  /// The same for one in which something comes nearer than the least distance.
  bool refute(std::uint64_t window, const WorldLines& lines, const Sha256Digest& hash, const TooNear& near);

  /// The largest least distance that positions allow, if it is less than what was asked for.
  std::optional<LargestDistance> largest(std::span<const Position> x, const VerifyOptions& options) const {
    return proofs_.largest(verifier_, x, options);
  }

 private:
  RunProof(const RunScene& scene, const WindowVerifier& verifier, const Claim& claim, const StepProofs::Open& open);

  RunScene scene_;
  const WindowVerifier& verifier_;
  StepProofs proofs_;
};

}  // namespace noli
