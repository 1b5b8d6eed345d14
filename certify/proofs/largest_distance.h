// SPDX-License-Identifier: Apache-2.0
//
// Finds the largest least distance that holds for a mesh at rest: neighbours in the mesh are nearer than a larger one.
#pragma once

#include <optional>
#include <span>

#include <noli/findings.h>
#include "proofs/prover/tokens/mesh_paths.h"
#include "proofs/prover/windows/window_verifier.h"

namespace noli {

/// The bounds for the positions x at rest if they are below `distance.eta`; nothing if that distance itself holds, or
/// the search was stopped. Each pair that is too near gives the next smaller limit, decided exactly; a proof shows that
/// a distance holds. (It does not search to the last double: in a regular mesh thousands of pairs have that distance,
/// and each would need exact arithmetic.) `mesh`: that of the verifier. `distance`: what was asked for. The options
/// that count are those of WindowVerifier::prove, and the dimension.
std::optional<LargestDistance> largest_distance(const WindowVerifier& verifier, const Mesh& mesh,
                                                std::span<const Position> x, const LeastDistance& distance,
                                                const VerifyOptions& options);

}  // namespace noli
