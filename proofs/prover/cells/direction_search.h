// SPDX-License-Identifier: Apache-2.0
//
// Looks for a direction that separates two parts over an interval.
//
// Notation
//   D        the differences a - b of all corners of the two parts, at both ends of the interval: at most 18 points
//   simplex  at most Dim + 1 points of D;  v  the point of their hull nearest to the origin
//
// A direction n separates iff n.w > 0 for all w in D. So there is one iff the hull of D misses the origin, and then the
// hull's point nearest to the origin is one. It is approached as in Gilbert, Johnson and Keerthi, "A fast procedure for
// computing the distance between complex objects" (1988): add the point of D that is lowest along v to the simplex,
// reduce the simplex to its face nearest to the origin, repeat. The search stops as soon as v separates by the proved
// test of proofs/prover/cells/direction.h, so nothing here has to be accurate.
//
// A failure proves nothing.
#pragma once

#include <array>
#include <optional>

#include "kernel/formula.h"
#include "proofs/prover/cells/direction.h"

namespace noli {

namespace detail {

template <int Dim>
using Vec = std::array<double, Dim>;

template <std::size_t N>
std::array<double, N> combine(double s, const std::array<double, N>& a, double t, const std::array<double, N>& b) {
  std::array<double, N> c;
  for (std::size_t k = 0; k < N; ++k) c[k] = s * a[k] + t * b[k];
  return c;
}

template <std::size_t N>
std::array<double, N> minus(const std::array<double, N>& a, const std::array<double, N>& b) {
  return combine(1, a, -1, b);
}

template <int Dim>
class Simplex {
 public:
  /// Adds a point, keeps the face nearest to the origin and moves `v` to it. False if the origin appears to be inside.
  bool add(const Vec<Dim>& w, Vec<Dim>& v) {
    w_[size_++] = w;
    switch (size_) {
      case 1: v = w; return true;
      case 2: return keep(on_segment(0, 1), v);
      case 3: {
        const Nearest nearest = on_triangle(0, 1, 2);
        return (Dim == 3 || nearest.count < 3) && keep(nearest, v);
      }
      default: return add_fourth(v);
    }
  }

 private:
  /// A face of the simplex, by its points, and its point nearest to the origin.
  struct Nearest {
    std::array<std::uint8_t, 3> points{};
    std::size_t count = 0;
    Vec<Dim> v{};
  };
  using Index = std::uint8_t;

  Nearest at_point(Index a) const { return {{a}, 1, w_[a]}; }

  Nearest on_segment(Index a, Index b) const {
    const Vec<Dim> ab = minus(w_[b], w_[a]);
    const double along = -formula::dot(w_[a], ab), length = formula::dot(ab, ab);
    if (!(along > 0)) return at_point(a);
    if (!(along < length)) return at_point(b);
    return {{a, b}, 2, combine(1, w_[a], along / length, ab)};
  }

  /// Ericson, "Real-Time Collision Detection" (2005), section 5.1.5, with the origin as the query point.
  Nearest on_triangle(Index a, Index b, Index c) const {
    const Vec<Dim> ab = minus(w_[b], w_[a]), ac = minus(w_[c], w_[a]);
    const double d1 = -formula::dot(ab, w_[a]), d2 = -formula::dot(ac, w_[a]);
    if (d1 <= 0 && d2 <= 0) return at_point(a);
    const double d3 = -formula::dot(ab, w_[b]), d4 = -formula::dot(ac, w_[b]);
    if (d3 >= 0 && d4 <= d3) return at_point(b);
    const double vc = d1 * d4 - d3 * d2;
    if (vc <= 0 && d1 >= 0 && d3 <= 0) return on_segment(a, b);
    const double d5 = -formula::dot(ab, w_[c]), d6 = -formula::dot(ac, w_[c]);
    if (d6 >= 0 && d5 <= d6) return at_point(c);
    const double vb = d5 * d2 - d1 * d6;
    if (vb <= 0 && d2 >= 0 && d6 <= 0) return on_segment(a, c);
    const double va = d3 * d6 - d5 * d4;
    if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) return on_segment(b, c);
    const double scale = 1 / (va + vb + vc);
    return {{a, b, c}, 3, combine(1, combine(1, w_[a], vb * scale, ab), vc * scale, ac)};
  }

  bool keep(const Nearest& nearest, Vec<Dim>& v) {
    std::array<Vec<Dim>, 3> kept;
    for (std::size_t i = 0; i < nearest.count; ++i) kept[i] = w_[nearest.points[i]];
    for (std::size_t i = 0; i < nearest.count; ++i) w_[i] = kept[i];
    size_ = nearest.count;
    v = nearest.v;
    return true;
  }

  /// Whether the face a, b, c is between the origin and the point `opposite`.
  bool outside(Index a, Index b, Index c, Index opposite) const {
    const Vec<Dim> u = minus(w_[b], w_[a]), v = minus(w_[c], w_[a]);
    const Vec<Dim> n = formula::cross(u, v);
    const double origin = -formula::dot(n, w_[a]), inside = formula::dot(n, minus(w_[opposite], w_[a]));
    return (origin > 0) != (inside > 0);
  }

  /// The nearest face contains the new point, so only the three faces around it are tried.
  bool add_fourth(Vec<Dim>& v) {
    if constexpr (Dim == 3) {
      constexpr std::array<std::array<Index, 3>, 3> others = {{{0, 1, 2}, {1, 2, 0}, {2, 0, 1}}};
      Nearest best;
      for (const auto& o : others) {
        if (!outside(o[0], o[1], 3, o[2])) continue;
        const Nearest nearest = on_triangle(o[0], o[1], 3);
        if (best.count == 0 || formula::dot(nearest.v, nearest.v) < formula::dot(best.v, best.v)) best = nearest;
      }
      return best.count > 0 && keep(best, v);
    } else {
      return false;
    }
  }

  std::array<Vec<Dim>, 4> w_;
  std::size_t size_ = 0;
};

template <int Dim>
Vec<Dim> corner_at(const PartPair<Dim>& pair, std::size_t lane, double s) {
  Vec<Dim> x;
  for (std::size_t k = 0; k < Dim; ++k) x[k] = (1 - s) * pair.d[0][k][lane] + s * pair.d[1][k][lane];
  return x;
}

/// The difference that is lowest along a direction, from the projections at one end of the interval.
template <int Dim>
Vec<Dim> lowest(const PartPair<Dim>& pair, const std::array<double, 8>& q, double s) {
  std::size_t a = 0, b = 4;
  for (std::size_t l = 1; l < 4; ++l) {
    if (q[l] < q[a]) a = l;
    if (q[4 + l] > q[b]) b = 4 + l;
  }
  return minus(corner_at(pair, a, s), corner_at(pair, b, s));
}

}  // namespace detail

/// Rounds of a search for a direction. Chosen by measuring simulated cloth and solids.
inline constexpr int search_rounds = 10;

/// Searches from the guess `v` for a direction n along which the first part is above the second by more than
/// bound_of(n) over the interval. Nothing if none was found in `rounds` rounds, or there seems to be none.
template <int Dim, class Bound>
std::optional<std::array<double, Dim>> find_direction(const PartPair<Dim>& pair, Direction<Dim> v, Interval interval,
                                                      int rounds, const Bound& bound_of) {
  detail::Simplex<Dim> simplex;
  for (int round = 0; round < rounds; ++round) {
    const Projections p = at_ends(project(pair, v), interval);
    const double bound = bound_of(v);
    const double gap_begin = gap_above(p.q[0]), gap_end = gap_above(p.q[1]);
    if (gap_begin > bound && gap_end > bound) return v;
    const bool begin = gap_begin < gap_end;
    const auto w = detail::lowest(pair, p.q[begin ? 0 : 1], begin ? interval.begin : interval.end);
    const double before = formula::dot(v, v);
    if (!simplex.add(w, v)) return std::nullopt;
    if (round > 0 && !(formula::dot(v, v) < before)) return std::nullopt;
  }
  return std::nullopt;
}

/// A direction that certainly separates the two parts.
template <int Dim>
std::optional<std::array<double, Dim>> find_direction(const PartPair<Dim>& pair, const Direction<Dim>& v,
                                                      Interval interval, int rounds) {
  return find_direction<Dim>(pair, v, interval, rounds,
                             [&](const Direction<Dim>& n) { return error_bound<Dim>(n, pair.reach); });
}

/// An upper bound of the distance of the parts at one time: the least length of a vector in the search.
template <int Dim>
double distance_at_most(const PartPair<Dim>& pair, double s, int rounds) {
  detail::Simplex<Dim> simplex;
  Direction<Dim> v = between_middles(pair);
  double least = std::numeric_limits<double>::infinity();
  for (int round = 0; round < rounds; ++round) {
    const Projections p = at_ends(project(pair, v), {s, s});
    if (!simplex.add(detail::lowest(pair, p.q[0], s), v)) return least;  // inside or flat; rounding hides which
    const double length = std::sqrt(formula::dot(v, v));
    if (!(length < least)) return least;
    least = length;
  }
  return least;
}

}  // namespace noli
