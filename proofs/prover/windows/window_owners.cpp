// SPDX-License-Identifier: Apache-2.0
#include "proofs/prover/windows/window_owners.h"

#include <algorithm>
#include <unordered_map>
#include <utility>

namespace noli {

namespace {

/// A vertex (twice), or an edge with its vertices in ascending order.
using Key = std::uint64_t;
Key key_of(VertexId a, VertexId b) { return Key{std::min(a, b)} << 32 | std::max(a, b); }

/// Calls visit(key, bit) for each corner and each edge of a cell.
template <class Visit>
void for_features(const Mesh& mesh, std::uint32_t cell, const Visit& visit) {
  const auto v = corners(mesh, cell);
  const int count = corner_count(mesh, cell);
  for (int i = 0; i < count; ++i)
    visit(key_of(v[static_cast<std::size_t>(i)], v[static_cast<std::size_t>(i)]), corner_bit(i));
  for (int i = 0; i < (count == 3 ? 3 : count - 1); ++i) {
    visit(key_of(v[static_cast<std::size_t>(i)], v[static_cast<std::size_t>((i + 1) % 3)]), edge_bit(i));
  }
}

}  // namespace

void prefer_free_owners(const Mesh& mesh, const std::vector<std::uint32_t>& labels, CellFeatures& features) {
  struct Owner {
    std::uint32_t cell;
    FeatureMask bit;
  };
  const auto scripted = [&](std::uint32_t cell) { return labels[cell] % 2 == 1; };
  std::unordered_map<Key, Owner> corner_owners, edge_owners;
  const auto owners_of = [&](FeatureMask bit) -> auto& { return bit < edge_bit(0) ? corner_owners : edge_owners; };
  const auto cells = static_cast<std::uint32_t>(labels.size());
  for (std::uint32_t cell = 0; cell < cells; ++cell) {
    if (!scripted(cell)) continue;
    for_features(mesh, cell, [&](Key key, FeatureMask bit) {
      if ((features.owned[cell] & bit) != 0) owners_of(bit)[key] = {cell, bit};
    });
  }
  if (corner_owners.empty() && edge_owners.empty()) return;
  for (std::uint32_t cell = 0; cell < cells; ++cell) {
    if (scripted(cell)) continue;
    for_features(mesh, cell, [&](Key key, FeatureMask bit) {
      const auto found = owners_of(bit).find(key);
      if (found == owners_of(bit).end()) return;
      const Owner owner = found->second;
      features.owned[owner.cell] = static_cast<FeatureMask>(features.owned[owner.cell] & ~owner.bit);
      features.owned[cell] |= bit;
      owners_of(bit).erase(found);
    });
  }
}

}  // namespace noli
