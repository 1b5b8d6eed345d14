// SPDX-License-Identifier: Apache-2.0
//
// A cell with everything the verifier asks of it in one place, so that an obligation touches four cache lines a cell.
//
// Notation
//   corner   as in proofs/prover/features.h; corners beyond the cell's own repeat its last one, which changes no hull
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "noli/kernel/query.h"
#include "noli/proofs/prover/features.h"
#include "noli/trajectory/mesh.h"

namespace noli {

template <int Dim>
struct alignas(64) MovingCell {
  /// x[end][axis][corner]: positions at the beginning (0) and the end (1) of the step.
  std::array<std::array<std::array<double, 4>, Dim>, 2> x;
  /// In 3D: the normal of a face at mid-time, as rounding has it (a guess, never relied on); else zero.
  std::array<double, Dim> normal;
  std::array<VertexId, 3> vertices;
  std::uint32_t cell;
  FeatureMask owned;
  FeatureMask shared;
  std::uint8_t corners;  ///< 3, 2 or 1

  Point<Dim> position(int end, int corner) const {
    const auto& at = x[static_cast<std::size_t>(end)];
    const auto i = static_cast<std::size_t>(corner);
    if constexpr (Dim == 3) {
      return {at[0][i], at[1][i], at[2][i]};
    } else {
      return {at[0][i], at[1][i]};
    }
  }
};

namespace detail {

/// Twice the normal of the triangle of the mean positions.
inline std::array<double, 3> mid_normal(const MovingCell<3>& c) {
  std::array<double, 3> u{}, v{};
  for (std::size_t k = 0; k < 3; ++k) {
    const auto &a = c.x[0][k], &b = c.x[1][k];
    u[k] = (a[1] - a[0]) + (b[1] - b[0]);
    v[k] = (a[2] - a[0]) + (b[2] - b[0]);
  }
  return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
}

}  // namespace detail

/// Gathers one cell. `features` as from find_owners.
template <int Dim>
MovingCell<Dim> gather(const Mesh& mesh, std::span<const Position> x_t0, std::span<const Position> x_t1,
                       const CellFeatures& features, std::uint32_t cell) {
  MovingCell<Dim> c{};
  c.vertices = corners(mesh, cell);
  for (std::size_t k = 0; k < Dim; ++k) {
    for (std::size_t i = 0; i < 4; ++i) {
      c.x[0][k][i] = x_t0[c.vertices[i < 3 ? i : 2]][k];
      c.x[1][k][i] = x_t1[c.vertices[i < 3 ? i : 2]][k];
    }
  }
  c.cell = cell;
  c.owned = features.owned[cell];
  c.shared = features.shared[cell];
  c.corners = static_cast<std::uint8_t>(corner_count(mesh, cell));
  if constexpr (Dim == 3) {
    if (c.corners == 3) c.normal = detail::mid_normal(c);
  }
  return c;
}

}  // namespace noli
