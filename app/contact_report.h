// SPDX-License-Identifier: Apache-2.0
//
// Contacts in words and as JSON, the same in every command.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "noli/app/json.h"
#include "noli/proofs/prover/verifier.h"

namespace noli::app {

using ContactCounts = std::array<std::uint64_t, all_feature_pairs.size()>;

/// {"pair": "edge_edge", "features": [[a, b], [c, d]]}
Json contact_json(const FeatureContact& contact);

/// {"vertex_face": n, ...}
Json counts_json(const ContactCounts& counts);

/// "edge 1-2 meets edge 7-9"
std::string contact_text(const FeatureContact& contact);

}  // namespace noli::app
