// SPDX-License-Identifier: Apache-2.0
//
// The largest least distance that a mesh at rest allows: neighbours by the mesh alone are nearer than any larger one.
//
// What this does not do: it looks at one instant, not at a motion.
#pragma once

#include <optional>
#include <span>

#include "noli/proofs/prover/step_prover.h"

namespace noli::app {

/// The greatest double eta for which all features are more than eta apart at rest in x, of those that the prover's claim
/// compares, if it is less than `eta`; nothing if that is allowed itself, or the search was stopped. Each pair that is
/// too near gives the next smaller candidate, decided exactly. `mesh`: that of the prover. Of the options as
/// StepProver::prove.
std::optional<double> largest_distance(const StepProver& prover, const Mesh& mesh, std::span<const Position> x,
                                       double eta, const VerifyOptions& options);

}  // namespace noli::app
