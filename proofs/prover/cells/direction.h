// SPDX-License-Identifier: Apache-2.0
//
// Tests in floating point, with a proved bound, whether a direction separates two parts over an interval of the step.
//
// Notation
//   u        2^-53; fl(.) rounds to nearest, so fl(x op y) = (x op y)(1 + e) + f with |e| <= u, and |f| <= 2^-1075 for
//            products, 0 for sums
//   r        the origin of the pair: one point r_t0, r_t1 for each end of the step
//   d        fl(x - r), for each corner x of the two parts and each end
//   reach    max |d_k|, over all corners, ends and axes; |n|_1 = sum of |n_k|
//   p(x)     fl(n.d), summed in the order of the axes
//   q(x)     at time s: fl(fl((1 - s) p_t0) + fl(s p_t1)), where s is a multiple of 2^-20, so that 1 - s is exact
//
// Claim: if fl(q(a) - q(b)) > fl(16 u fl(4 |n|_1 reach)) + 2^-1022 for all corners a of the first part and b of the
// second, then n.(a(s) - b(s)) > 0. Proof. Let R = |n|_1 reach. If some n_k or d_k is infinite or NaN, or 4 R
// overflows, the right side is infinite or NaN and the comparison fails. Otherwise nothing overflows. n_k (x - r)_k =
// n_k d_k (1 + e), and fl(n.d) takes a product and at most two sums per term, so |p(x) - n.(x - r)| <= 4.01 u R + 3 *
// 2^-1075 at each end. The exact n.(x(s) - r(s)) is (1 - s) of its value at t0 plus s of that at t1, so |q(x) - n.(x(s)
// - r(s))| <= 4.01 u R + 3.01 u R + 5 * 2^-1075. The same holds for b, and the last difference adds u |q(a) - q(b)| <=
// 2.01 u R. Together the error is at most 17 u R + 2^-1070. The right side of the comparison is at least 64 u R (1 - 4
// u) - 2^-1074 + 2^-1022 (or that rounded, less another u of it), which is more. In two dimensions there is a term
// less.
//
// Between the ends of the interval n.(a - b) is linear, so a direction that separates at both ends separates throughout
// (design 1).
//
// A negative answer proves nothing. proofs/prover/cells/direction_search.h finds directions.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <type_traits>

#include "proofs/prover/cells/moving_cell.h"

namespace noli {

/// A direction; as an argument it does not deduce Dim.
template <int Dim>
using Direction = std::type_identity_t<std::array<double, Dim>>;

/// Which corners of a cell are in a part: bit i for corner i; bits of corners that the cell does not have are zero.
using CornerMask = std::uint8_t;

constexpr CornerMask all_corners(int count) { return static_cast<CornerMask>((1 << count) - 1); }

/// A part of the step, with 0 <= begin < end <= 1 multiples of 2^-20.
struct Interval {
  double begin = 0;
  double end = 1;
  double middle() const { return 0.5 * (begin + end); }
};

/// The corners of two parts relative to a common origin: d[end][axis][lane]. Lanes 0 to 3 are the first part (some of
/// its corners more than once), lanes 4 to 7 the second.
template <int Dim>
struct PartPair {
  std::array<std::array<std::array<double, 8>, Dim>, 2> d;
  double reach;
};

namespace detail {

// The right side of the claim is error_share (4 |n|_1 reach) + error_least. It is proved in proofs/gappa; a test
// compares these numbers with Constants.v there.
constexpr double error_share = 0x1p-49;
constexpr double error_least = 0x1p-1022;  // the least normal double

/// Four corners of the part, by number: those in the mask, the last one repeated.
inline const std::array<std::uint8_t, 4>& lanes_of(CornerMask mask) {
  static constexpr std::array<std::array<std::uint8_t, 4>, 8> table = {
      {{0, 0, 0, 0}, {0, 0, 0, 0}, {1, 1, 1, 1}, {0, 1, 1, 1}, {2, 2, 2, 2}, {0, 2, 2, 2}, {1, 2, 2, 2}, {0, 1, 2, 2}}};
  return table[mask];
}

template <int Dim>
double reach_of(const std::array<std::array<std::array<double, 8>, Dim>, 2>& d) {
  std::array<double, 8> most{};
  for (std::size_t e = 0; e < 2; ++e) {
    for (std::size_t k = 0; k < Dim; ++k) {
      for (std::size_t l = 0; l < 8; ++l) {
        const double size = std::abs(d[e][k][l]);
        most[l] = most[l] > size ? most[l] : size;
      }
    }
  }
  return *std::max_element(most.begin(), most.end());
}

}  // namespace detail

/// The pair of two nonempty parts. The origin is corner `origin` of a. `Cell`: MovingCell, or derived from it.
template <class Cell>
PartPair<Cell::dim> pair_of(const Cell& a, CornerMask a_part, const Cell& b, CornerMask b_part, std::size_t origin) {
  constexpr int Dim = Cell::dim;
  const auto &a_lanes = detail::lanes_of(a_part), &b_lanes = detail::lanes_of(b_part);
  PartPair<Dim> pair;
  for (std::size_t e = 0; e < 2; ++e) {
    for (std::size_t k = 0; k < Dim; ++k) {
      const double r = a.x[e][k][origin];
      for (std::size_t l = 0; l < 4; ++l) pair.d[e][k][l] = a.x[e][k][a_lanes[l]] - r;
      for (std::size_t l = 0; l < 4; ++l) pair.d[e][k][4 + l] = b.x[e][k][b_lanes[l]] - r;
    }
  }
  pair.reach = widened(detail::reach_of<Dim>(pair.d), a, b);
  return pair;
}

/// q of every corner, at both ends of an interval.
struct Projections {
  std::array<std::array<double, 8>, 2> q;
};

template <int Dim>
Projections project(const PartPair<Dim>& pair, const Direction<Dim>& n) {
  Projections p;
  for (std::size_t e = 0; e < 2; ++e) {
    for (std::size_t l = 0; l < 8; ++l) {
      double sum = n[0] * pair.d[e][0][l] + n[1] * pair.d[e][1][l];
      if constexpr (Dim == 3) sum += n[2] * pair.d[e][2][l];
      p.q[e][l] = sum;
    }
  }
  return p;
}

/// Interpolates from the ends of the step to the ends of an interval.
inline Projections at_ends(const Projections& step, Interval interval) {
  if (interval.begin == 0 && interval.end == 1) return step;
  Projections p;
  for (std::size_t l = 0; l < 8; ++l) {
    p.q[0][l] = (1 - interval.begin) * step.q[0][l] + interval.begin * step.q[1][l];
    p.q[1][l] = (1 - interval.end) * step.q[0][l] + interval.end * step.q[1][l];
  }
  return p;
}

/// The right side of the claim.
template <int Dim>
double error_bound(const Direction<Dim>& n, double reach) {
  double size = std::abs(n[0]) + std::abs(n[1]);
  if constexpr (Dim == 3) size += std::abs(n[2]);
  return detail::error_share * (4 * size * reach) + detail::error_least;
}

/// How far the first part is above the second at one end (negative: the parts overlap along n).
inline double gap_above(const std::array<double, 8>& q) {
  const double low = std::min(std::min(q[0], q[1]), std::min(q[2], q[3]));
  const double high = std::max(std::max(q[4], q[5]), std::max(q[6], q[7]));
  return low - high;
}

/// How far the first part is below the second at one end.
inline double gap_below(const std::array<double, 8>& q) {
  const double high = std::max(std::max(q[0], q[1]), std::max(q[2], q[3]));
  const double low = std::min(std::min(q[4], q[5]), std::min(q[6], q[7]));
  return low - high;
}

/// +1 if n, -1 if -n certainly separates the first part (above) from the second over the interval; 0 if neither is
/// certain.
template <int Dim>
int separates(const PartPair<Dim>& pair, const Direction<Dim>& n, Interval interval = {}) {
  const Projections p = at_ends(project(pair, n), interval);
  const double bound = error_bound<Dim>(n, pair.reach);
  if (gap_above(p.q[0]) > bound && gap_above(p.q[1]) > bound) return 1;
  if (gap_below(p.q[0]) > bound && gap_below(p.q[1]) > bound) return -1;
  return 0;
}

/// Four times the vector from the middle of the second part to the middle of the first at mid-time.
template <int Dim>
Direction<Dim> between_middles(const PartPair<Dim>& pair) {
  Direction<Dim> n;
  for (std::size_t k = 0; k < Dim; ++k) {
    const auto &p = pair.d[0][k], &q = pair.d[1][k];
    n[k] = ((p[0] + q[0]) + (p[1] + q[1]) + (p[2] + q[2])) - ((p[4] + q[4]) + (p[5] + q[5]) + (p[6] + q[6]));
  }
  return n;
}

}  // namespace noli
