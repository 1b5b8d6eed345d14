// SPDX-License-Identifier: Apache-2.0
#include "certify/proofs/parsed_claim.h"

#include <algorithm>
#include <numeric>

#include "trajectory/blocks/bytes.h"
#include "trajectory/cells.h"

namespace noli {

namespace {

using Pairs = std::vector<std::array<std::uint32_t, 2>>;

/// Reads a counted list of pairs at `at`, and moves `at` past it; nothing if it is longer than the payload.
std::optional<Pairs> read_pairs(const std::string& payload, std::size_t& at) {
  if (payload.size() < at + 4) return std::nullopt;
  const auto count = get<std::uint32_t>(payload.data() + at);
  at += 4;
  if ((payload.size() - at) / 8 < count) return std::nullopt;
  Pairs pairs(count);
  for (auto& [a, b] : pairs) {
    a = get<std::uint32_t>(payload.data() + at);
    b = get<std::uint32_t>(payload.data() + at + 4);
    at += 8;
  }
  return pairs;
}

}  // namespace

std::optional<ParsedClaim> parse_claim(const ProofGroups& groups) {
  if (groups.empty() || groups[0].empty() || groups[0][0].kind != four_letters("CLAM")) return std::nullopt;
  const std::string& payload = groups[0][0].payload;
  std::size_t at = 48;
  const auto merged = read_pairs(payload, at);
  const auto excluded = merged ? read_pairs(payload, at) : std::nullopt;
  if (!excluded) return std::nullopt;
  ParsedClaim claim;
  claim.source = static_cast<unsigned char>(payload[0]);
  claim.dimension = static_cast<unsigned char>(payload[1]);
  claim.strict = (payload[2] & 1) != 0;
  claim.points = (payload[2] & 2) != 0;
  claim.ring = get<std::uint32_t>(payload.data() + 4);
  claim.eta = get<double>(payload.data() + 8);
  claim.merged = *merged;
  claim.excluded = {excluded->begin(), excluded->end()};
  for (const ProofBlock& block : groups[0]) {
    if (block.kind != four_letters("LABL")) continue;
    for (std::size_t i = 0; i + 4 <= block.payload.size(); i += 4) {
      claim.labels.push_back(get<std::uint32_t>(block.payload.data() + i));
    }
  }
  return claim;
}

std::optional<Mesh> claimed_mesh(const ParsedClaim& claim, const Mesh& mesh) {
  Mesh result = mesh;
  if (claim.points) add_particles(result);
  std::vector<VertexId> same(mesh.vertex_count);
  std::iota(same.begin(), same.end(), 0);
  for (const auto& [v, stands] : claim.merged) {
    if (v >= same.size() || stands >= same.size()) return std::nullopt;
    same[v] = stands;
  }
  for (auto& face : result.faces) std::ranges::for_each(face, [&](VertexId& v) { v = same[v]; });
  for (auto& edge : result.edges) std::ranges::for_each(edge, [&](VertexId& v) { v = same[v]; });
  std::ranges::for_each(result.points, [&](VertexId& v) { v = same[v]; });
  drop_redundant_cells(result);
  return result;
}

}  // namespace noli
