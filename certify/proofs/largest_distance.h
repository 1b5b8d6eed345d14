// SPDX-License-Identifier: Apache-2.0
//
// The largest least distance that a mesh at rest allows: neighbours by the mesh alone are nearer than any larger one.
//
// What this does not do: it looks at one instant, not at a motion.
#pragma once

#include <optional>
#include <span>

#include <noli/findings.h>
#include "proofs/prover/tokens/mesh_paths.h"
#include "proofs/prover/windows/window_verifier.h"

namespace noli {

/// The bounds for the positions x at rest if they are below `distance.eta`; nothing if that is allowed itself, or the
/// search was stopped. Each pair that is too near gives the next smaller limit, decided exactly; that a distance is
/// allowed is proved. (Why not to the last double: in a regular mesh thousands of pairs have that distance, and each
/// would need exact arithmetic.) `mesh`: that of the verifier. `distance`: what was asked for. Of the options as
/// WindowVerifier::prove, and the dimension.
std::optional<LargestDistance> largest_distance(const WindowVerifier& verifier, const Mesh& mesh,
                                                std::span<const Position> x, const LeastDistance& distance,
                                                const VerifyOptions& options);

}  // namespace noli
