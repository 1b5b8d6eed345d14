// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "certify/body_names.h"
#include "integrator/scene/scene.h"
#include "proofs/prover/windows/window_verifier.h"

namespace noli {

/// Decides exactly what meets at the beginning of a scene, with everything at rest; "" if nothing does. `mesh`: that of
/// the verifier; `options`: as for a window. Throws Stopped if a stop comes before the answer is known.
std::string contact_at_start(const WindowVerifier& verifier, const Mesh& mesh, const std::vector<Position>& x,
                             WindowOptions options, const BodyNames& names);

/// The same of a scene that is not going to run. Throws InputError as build_model does.
std::string contact_at_start(const integrator::Scene& scene, const std::atomic<bool>* stop,
                             std::optional<std::chrono::steady_clock::time_point> deadline);

}  // namespace noli
