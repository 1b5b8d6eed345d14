// SPDX-License-Identifier: Apache-2.0
//
// Contacts as text and as JSON, the same in every command.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <noli/findings.h>
#include <noli/run.h>
#include "certify/json.h"
#include "integrator/contact_settings.h"
#include "integrator/scene/build_model.h"
#include "proofs/prover/verifier.h"

namespace noli {

/// {"pair": "edge_edge", "features": [[a, b], [c, d]]}
Json contact_json(const FeatureContact& contact);

/// The pairs of bodies, by their numbers, that meet with one material.
struct MeetingBodies {
  static constexpr std::size_t most = 6;
  std::vector<std::array<std::uint64_t, 2>> pairs;  ///< at most `most`
  std::uint64_t more = 0;                           ///< number of further pairs
};

/// The same with cells, bodies, kind, step, time and point.
Json contact_json(const ListedContact& listed);

/// The layers of a model: {"most_layers": n, "layers": [4 a, 4 b, 4 c], "materials": [...]}. If there are several
/// materials, each has "pairs" and "more_pairs" of MeetingBodies. `built`: one for each material.
Json contact_json(const integrator::ContactSettings& settings, std::span<const integrator::BuiltContact> built);

/// All zero in scenes without contact.
Json certificates_json(const CertificateCounts& counts);

/// {"vertex_face": n, ...}
Json counts_json(const ContactCounts& counts);

/// "edge 1-2 meets edge 7-9"
std::string contact_text(const FeatureContact& contact);

/// "edge 1-2 × edge 7-9"
std::string pair_in_short(const FeatureContact& contact);

/// "vertex 12 (shirt) × face 7 (floor)": a face by its number, and bodies if they have names.
std::string pair_in_short(const ListedContact& listed);

/// "vertex 12 (shirt) × face 7 (floor) at (0.12, 0.98, -0.31)"
std::string who_and_where(const ListedContact& listed, int dimension);

/// The number of the face of a contact between a vertex and a face, the first if several have its vertices.
std::optional<std::uint32_t> face_of(const ListedContact& listed);

}  // namespace noli
