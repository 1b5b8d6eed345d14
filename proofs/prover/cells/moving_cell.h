// SPDX-License-Identifier: Apache-2.0
//
// Cells and vertices in the layout that the verifier reads.
//
// Notation
//   corner   as in trajectory/cell_features.h; corners beyond the cell's own repeat its last one, which does not change
//            hulls
//
// The usual obligations are settled from StepCell: one cache line per cell and per vertex, and the vertices of a mesh
// are few enough to stay in the cache. For the rest, positions are gathered in a MovingCell.
#pragma once

#include <array>
#include <cstdint>

#include <noli/mesh.h>
#include <noli/query.h>
#include "kernel/both_ends.h"
#include "proofs/prover/cells/leftover.h"
#include "trajectory/cell_features.h"

namespace noli {

/// What is known of a cell without positions: its number, its vertices and its features.
struct CellIndices {
  std::array<VertexId, 3> vertices;  ///< as `corners` in trajectory/cell_features.h
  std::uint32_t cell;
  FeatureMask owned;
  FeatureMask shared;
  std::uint8_t corners;  ///< 3, 2 or 1
};

/// `features` as from find_owners.
inline CellIndices indices_of(const Mesh& mesh, const CellFeatures& features, std::uint32_t cell) {
  return {corners(mesh, cell), cell, features.owned[cell], features.shared[cell],
          static_cast<std::uint8_t>(corner_count(mesh, cell))};
}

inline CellShape shape_of(const CellIndices& cell) { return {cell.vertices, cell.corners}; }

/// The positions of a vertex at both ends of the step.
template <int Dim>
struct alignas(Dim == 3 ? 64 : 32) MovingVertex {
  std::array<BothEnds, Dim> x;
};

template <int Dim>
MovingVertex<Dim> moving_vertex(const Position& x_t0, const Position& x_t1) {
  MovingVertex<Dim> vertex;
  for (std::size_t k = 0; k < Dim; ++k) vertex.x[k] = BothEnds(x_t0[k], x_t1[k]);
  return vertex;
}

/// A cell of a mesh in a step.
template <int Dim>
struct alignas(32) StepCell : CellIndices {
  static constexpr int dim = Dim;
  const MovingVertex<Dim>* mesh_vertices;  ///< those of the whole mesh

  const std::array<BothEnds, Dim>& x(std::size_t corner) const { return mesh_vertices[vertices[corner]].x; }
};

/// A cell with its positions.
template <int Dim>
struct alignas(64) MovingCell : CellIndices {
  static constexpr int dim = Dim;

  /// x[end][axis][corner]: positions at the beginning (0) and the end (1) of the step.
  std::array<std::array<std::array<double, 4>, Dim>, 2> x;
  /// In 3D: the normal of a face at mid-time, rounded (only a guess); otherwise zero.
  std::array<double, Dim> normal;

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

/// Gives `c` the positions of the corners of `cell`.
template <int Dim, class Cell>
void gather_corners(const Cell& cell, MovingCell<Dim>& c) {
  static_cast<CellIndices&>(c) = cell;
  for (std::size_t k = 0; k < Dim; ++k) {
    for (std::size_t i = 0; i < 4; ++i) {
      const BothEnds x = cell.x(i < 3 ? i : 2)[k];
      c.x[0][k][i] = x.at_t0();
      c.x[1][k][i] = x.at_t1();
    }
  }
  if constexpr (Dim == 3) {
    if (c.corners == 3) c.normal = detail::mid_normal(c);
  }
}

template <int Dim>
MovingCell<Dim> gather(const StepCell<Dim>& cell) {
  MovingCell<Dim> c{};
  gather_corners(cell, c);
  return c;
}

/// The reach of two cells (proofs/prover/cells/direction.h) that move along straight lines.
template <int Dim>
double widened(double reach, const StepCell<Dim>& /*a*/, const StepCell<Dim>& /*b*/) {
  return reach;
}
template <int Dim>
double widened(double reach, const MovingCell<Dim>& /*a*/, const MovingCell<Dim>& /*b*/) {
  return reach;
}

}  // namespace noli
