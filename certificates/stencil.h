// SPDX-License-Identifier: Apache-2.0
//
// Two features that may come near each other, with a permanent key.
//
// Notation
//   A, B     the two features; vertices of A come first
//   key      64 bits that identify a pair throughout a run: kind, then the numbers of its features. Pairs with events
//            at the same time are processed in the order of their keys
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include <noli/mesh.h>
#include <noli/query.h>

namespace noli::certificates {

using PairKey = std::uint64_t;

struct Stencil {
  FeaturePair kind;
  std::array<VertexId, 4> vertices{};  ///< of A, then of B; the first size() count
  PairKey key;

  std::size_t first() const { return first_size(kind); }  ///< vertices of A
  std::size_t size() const { return point_count(kind); }  ///< of both
};

/// a, b: the numbers of the features, each among features of its kind. Precondition: a, b < 2^31.
constexpr PairKey pair_key(FeaturePair kind, std::uint32_t a, std::uint32_t b) {
  return static_cast<PairKey>(kind) << 62 | static_cast<PairKey>(a) << 31 | b;
}

}  // namespace noli::certificates
