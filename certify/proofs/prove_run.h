// SPDX-License-Identifier: Apache-2.0
//
// Makes the proofs of a run's windows, for `noli simulate` and `noli verify RUN --proof OUT`.
#pragma once

#include <filesystem>
#include <memory>

#include "certify/proofs/claim.h"
#include "certify/proofs/step_proofs.h"
#include "trajectory/blocks/run_file.h"

namespace noli {

/// The file in the folder of a run.
std::filesystem::path proof_path(const std::filesystem::path& run_folder);

/// Sets the members of the claim about a scene's cells: their hash, and the pairs that are not compared. Precondition:
/// `claim.strict` is set.
void set_cells_of_run(Claim& claim, const RunScene& scene);

/// Writes to an empty sink. Uses only strict, distance and ring of the claim. The scene must outlive the proof, here
/// and below.
std::unique_ptr<StepProofs> proof_of_run(std::unique_ptr<Sink> sink, const RunScene& scene, const Claim& claim = {});
/// Continues the proof that `noli simulate` began, of a run with `windows` committed windows: cuts off later windows
/// and proves the missing ones. Throws InputError if the proof cannot be read.
std::unique_ptr<StepProofs> resumed_proof_of_run(const std::filesystem::path& run_folder, std::uint64_t windows,
                                                 const RunScene& scene, const WindowVerifier& verifier,
                                                 const VerifyOptions& options);

}  // namespace noli
