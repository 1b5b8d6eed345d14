// SPDX-License-Identifier: Apache-2.0
#include "proofs/prover/initial.h"

#include <bit>
#include <utility>

#include "kernel/static_predicates.h"

namespace noli {

namespace {

/// The simplex on the lanes of a part: a point, a segment or a triangle.
template <std::size_t Size, int Dim>
auto simplex_at_begin(const MovingCell<Dim>& cell, CornerMask part) {
  const auto& lanes = detail::lanes_of(part);
  if constexpr (Size == 1) {
    return cell.position(0, lanes[0]);
  } else if constexpr (Size == 2) {
    return Segment<Dim>{cell.position(0, lanes[0]), cell.position(0, lanes[1])};
  } else {
    return Triangle<Dim>{cell.position(0, lanes[0]), cell.position(0, lanes[1]), cell.position(0, lanes[2])};
  }
}

/// Precondition: the first part has `Size` corners, the second no fewer.
template <std::size_t Size, int Dim>
bool meet_larger(const MovingCell<Dim>& a, CornerMask a_part, const MovingCell<Dim>& b, CornerMask b_part) {
  const auto simplex = simplex_at_begin<Size>(a, a_part);
  if constexpr (Size < 3) {
    if (std::popcount(b_part) == 2) return intersects(simplex, simplex_at_begin<2>(b, b_part));
  }
  if constexpr (Size < 2) {
    if (std::popcount(b_part) == 1) return simplex == simplex_at_begin<1>(b, b_part);
  }
  return intersects(simplex, simplex_at_begin<3>(b, b_part));
}

}  // namespace

template <int Dim>
bool meet_at_begin(const MovingCell<Dim>& a, CornerMask a_part, const MovingCell<Dim>& b, CornerMask b_part) {
  const int size = std::popcount(a_part);
  if (size > std::popcount(b_part)) return meet_at_begin(b, b_part, a, a_part);
  if (size == 1) return meet_larger<1>(a, a_part, b, b_part);
  return size == 2 ? meet_larger<2>(a, a_part, b, b_part) : meet_larger<3>(a, a_part, b, b_part);
}

template bool meet_at_begin(const MovingCell<2>&, CornerMask, const MovingCell<2>&, CornerMask);
template bool meet_at_begin(const MovingCell<3>&, CornerMask, const MovingCell<3>&, CornerMask);

}  // namespace noli
