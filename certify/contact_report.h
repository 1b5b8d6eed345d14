// SPDX-License-Identifier: Apache-2.0
//
// Contacts in words and as JSON, the same in every command.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include <noli/run.h>
#include "certify/json.h"
#include "integrator/contact_settings.h"
#include "proofs/prover/verifier.h"

namespace noli {

/// {"pair": "edge_edge", "features": [[a, b], [c, d]]}
Json contact_json(const FeatureContact& contact);

/// What the layers of a model are: {"most_layers": n, "layers": [4 a, 4 b, 4 c], "materials": [...]}
Json contact_json(const integrator::ContactSettings& settings);

/// All zero in scenes without contact.
Json certificates_json(const CertificateCounts& counts);

/// {"vertex_face": n, ...}
Json counts_json(const ContactCounts& counts);

/// "edge 1-2 meets edge 7-9"
std::string contact_text(const FeatureContact& contact);

/// "edge 1-2 × edge 7-9"; a face by its number, if it is known.
std::string pair_in_short(const FeatureContact& contact, std::optional<std::uint32_t> face = std::nullopt);

}  // namespace noli
