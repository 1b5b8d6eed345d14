// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "certify/body_names.h"
#include "proofs/prover/windows/window_verifier.h"

namespace noli {

/// What meets where a scene begins, everything being at rest there, decided exactly; "" if nothing does. `mesh`: the
/// one of the verifier; `options`: as for a window. Throws Stopped when that comes before the answer is known.
std::string contact_at_start(const WindowVerifier& verifier, const Mesh& mesh, const std::vector<Position>& x,
                             WindowOptions options, const BodyNames& names);

}  // namespace noli
