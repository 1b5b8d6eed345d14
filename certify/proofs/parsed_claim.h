// SPDX-License-Identifier: Apache-2.0
//
// Parses the claim of a proof of frames: the fields of its first group (proofs/FORMAT.md, sections 1 and 2).
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <set>
#include <vector>

#include <noli/mesh.h>
#include "certify/proofs/proof_blocks.h"

namespace noli {

struct ParsedClaim {
  int source = 0;  ///< 0 frames, 1 frames at rest, 2 a run
  int dimension = 3;
  bool strict = false, points = false;
  std::uint32_t ring = 1;
  double eta = 0;
  std::vector<std::array<VertexId, 2>> merged;  ///< a vertex and the one that represents it
  std::set<std::array<std::uint32_t, 2>> excluded;
  std::vector<std::uint32_t> labels;  ///< of the cells; empty: all are 0

  std::uint32_t label(std::size_t cell) const { return cell < labels.size() ? labels[cell] : 0; }
  friend bool operator==(const ParsedClaim&, const ParsedClaim&) = default;
};

/// Nothing if the first group has no claim, or lists are longer than its block.
std::optional<ParsedClaim> parse_claim(const ProofGroups& groups);

/// The cells that a claim is about: with loose points, merged vertices replaced, and redundant cells dropped. Nothing
/// if a merged vertex is not in the mesh.
std::optional<Mesh> claimed_mesh(const ParsedClaim& claim, const Mesh& mesh);

}  // namespace noli
