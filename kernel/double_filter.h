// SPDX-License-Identifier: Apache-2.0
//
// Bernstein coefficients in plain double, with error bounds: the stage after those of direction_filter.h.
//
// Notation
//   u = 2^-53         as in direction_filter.h
//   m_x               the largest magnitude of a computed component of the moving vector x, over both ends of the step
//
// Error bounds, to first order in u; the constants used are a few per cent larger, which covers the higher orders and
// the rounding of the bounds themselves. A computed difference of two coordinates has a relative error of u.
//   cross product     at one end, a component is at most 2 m_a m_b, its error 8u m_a m_b (each of two products
//                     has 3u, the subtraction u of the result); the middle coefficient is at most 4 m_a m_b,
//                     its error 20u m_a m_b
//   scaled inside     at most 4 m_a m_b, error 20u m_a m_b. c - w x u: bounds add up, and the subtraction adds 4u
//                     of each
//   determinant       at one end 46u m_a m_b m_c; the scaled coefficients are at most 18 m_a m_b m_c, their error
//                     168u m_a m_b m_c
//   de Casteljau      a level adds at most 3u times the largest coefficient: 162u m_a m_b m_c for a cubic,
//                     24u m_a m_b for an inside
//   inside at t       a vector at time t is off by 4u m, an inside by 20u m_a m_b (c - w x u: 22u of the sum);
//                     while t moves by r, a vector moves by at most 2 r m, an inside by (8 r + 8 r^2) m_a m_b,
//                     which is below 9 r m_a m_b for r < 1/8
// When all m_x are between 2^-300 and 2^300, which usable() tests, products do not overflow, and what they lose to
// underflow does not matter.
//
// Coplanar, touching or otherwise degenerate queries come out as `unknown`.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include <noli/query.h>
#include "kernel/bernstein.h"
#include "kernel/direction_filter.h"
#include "kernel/formula.h"
#include "kernel/root_filter.h"

namespace noli::filter {

using bernstein::Verdict;
using formula::Moving;

// The bounds, in units of u times the product of the m_x concerned. They are proved in proofs/gappa; a test compares
// them with Constants.v there.
constexpr double coplanarity_units = 176;        // of a scaled coefficient of f
constexpr double coplanarity_level_units = 168;  // added by de Casteljau
constexpr double inside_units = 21;
constexpr double inside_difference_units = 25;  // of each of the two products of an inside c - w x u
constexpr double inside_level_units = 25;

/// Certain signs of doubles with known error bounds: the Signs of bernstein.h.
template <std::size_t Insides>
struct DoubleSigns {
  double f_bound;  ///< of a scaled coefficient of f
  double f_level;  ///< added by de Casteljau
  std::array<double, Insides> g_bound;
  std::array<double, Insides> g_level;

  static int sign(double x, double bound) { return (x > bound) - (x < -bound); }

  int f(double x) const { return sign(x, f_bound); }
  int f_value(double x) const { return sign(x, f_bound + f_level); }
  int g(std::size_t k, double x) const { return sign(x, g_bound[k]); }

  /// The value in the middle, and how far g can go from there at its steepest.
  template <std::size_t N>
  int g_on(std::size_t k, const std::array<double, N>& c, double low, double high) const {
    double step = 0;
    for (std::size_t i = 0; i + 1 < N; ++i) step = std::max(step, std::abs(c[i + 1] - c[i]));
    const double slope = static_cast<double>(N - 1) * (step + 4 * g_bound[k]);
    const double value = bernstein::value_at(c, 0.5 * (low + high));
    return sign(value, g_bound[k] + g_level[k] + slope * (high - low));
  }

  static double center(double x) { return x; }
  double f_noise() const { return f_bound + f_level; }

  DoubleSigns finer() const {
    DoubleSigns result = *this;
    result.f_bound += f_level;
    for (std::size_t k = 0; k < Insides; ++k) result.g_bound[k] += g_level[k];
    return result;
  }
};

// --- Differences of a query ------------------------------------------------------------------------------------------

inline EndVectors swapped(const EndVectors& x) { return {x[0].swapped(), x[1].swapped(), x[2].swapped()}; }

inline double sum_of_ends(BothEnds x) { return x.at_t0() + x.at_t1(); }

/// det(a, b, c), scaled. It is the formula of formula.h (a form's middle coefficients take one factor from each end),
/// evaluated for both ends at once.
inline Cubic coplanarity(const EndVectors& a, const EndVectors& b, const EndVectors& c) {
  const EndVectors ends = formula::cross(a, b), mixed = formula::cross(a, swapped(b));
  const EndVectors middle = constant({sum_of_ends(mixed[0]), sum_of_ends(mixed[1]), sum_of_ends(mixed[2])});
  const BothEnds outer = dot(c, ends), inner = dot(swapped(c), ends) + dot(c, middle);
  return bernstein::scaled_coefficients(Cubic{outer.at_t0(), inner.at_t0(), inner.at_t1(), outer.at_t1()});
}

inline Moving<double, 3> moving(const EndVectors& x) {
  return {{x[0].at_t0(), x[1].at_t0(), x[2].at_t0()}, {x[0].at_t1(), x[1].at_t1(), x[2].at_t1()}};
}

inline double largest_magnitude(const EndVectors& x) {
  const BothEnds m = magnitude(x);
  return std::max(m.at_t0(), m.at_t1());
}

inline std::size_t largest_component(const Vec<double, 3>& n) {
  const double x = std::abs(n[0]), y = std::abs(n[1]), z = std::abs(n[2]);
  if (x >= y) return x >= z ? 0 : 2;
  return y >= z ? 1 : 2;
}

/// Where moving vectors are at time t, seen along the axis in which `normal` is largest.
class PlaneView {
 public:
  PlaneView(const Vec<double, 3>& normal, double t)
      : i_((largest_component(normal) + 1) % 3), j_((i_ + 1) % 3), weights_(1 - t, t) {}

  Vec<double, 2> operator()(const EndVectors& x) const {
    return {sum_of_ends(x[i_] * weights_), sum_of_ends(x[j_] * weights_)};
  }

  /// Whether three points share one of the view's two coordinates at both ends. They are then collinear in this view
  /// all the time, and their inside is exactly zero throughout.
  template <class Query>
  bool share_a_coordinate(const Query& q, const std::array<std::size_t, 3>& points) const {
    return share(q.x_t0, q.x_t1, points, i_) || share(q.x_t0, q.x_t1, points, j_);
  }

 private:
  template <class Points>
  static bool share(const Points& x_t0, const Points& x_t1, const std::array<std::size_t, 3>& points,
                    std::size_t axis) {
    const auto [a, b, c] = points;
    return x_t0[a][axis] == x_t0[b][axis] && x_t0[b][axis] == x_t0[c][axis] && x_t1[a][axis] == x_t1[b][axis] &&
           x_t1[b][axis] == x_t1[c][axis];
  }

  std::size_t i_, j_;
  BothEnds weights_;
};

/// Collects the certain signs of insides. The others can decide even if one is zero throughout: if they have the same
/// strict sign, the view is not degenerate, and the contact is on the border of a feature.
struct InsideSigns {
  bool some_positive = false, some_negative = false, all_positive = true, all_negative = true;

  template <class ZeroThroughout>
  void add(double value, double bound, ZeroThroughout&& zero_throughout) {
    const bool positive = value > bound, negative = value < -bound;
    if (!positive && !negative && zero_throughout()) return;
    some_positive |= positive;
    some_negative |= negative;
    all_positive &= positive;
    all_negative &= negative;
  }
  Verdict verdict() const {
    if (some_positive & some_negative) return Verdict::apart;
    return all_positive != all_negative ? Verdict::contact : Verdict::unknown;
  }
};

/// The common part of both filters. `separation`: of the query; its normal decides the axis along which to look. Both
/// must outlive the filter.
template <class Query>
class FourPoints {
 public:
  FourPoints(const Query& q, const Separation& separation)
      : query_(q),
        normal_(separation.normal),
        d_(separation.differences),
        m_{largest_magnitude(d_[0]), largest_magnitude(d_[1]), largest_magnitude(d_[2])} {}

  std::size_t axis() const { return largest_component(normal_); }
  Cubic coplanarity() const { return filter::coplanarity(d_[0], d_[1], d_[2]); }
  /// Whether the error bounds hold: nothing overflows or underflows. False for NaN, too.
  bool usable() const {
    return std::min({m_[0], m_[1], m_[2]}) > least_size && std::max({m_[0], m_[1], m_[2]}) < greatest_size;
  }
  double volume() const { return m_[0] * m_[1] * m_[2]; }

 protected:
  const Query& query_;
  const Vec<double, 3>& normal_;
  const std::array<EndVectors, 3>& d_;
  std::array<double, 3> m_;
};

// --- vertex_face -----------------------------------------------------------------------------------------------------

class VertexFaceFilter : public FourPoints<VertexFace3> {
 public:
  using FourPoints::FourPoints;

  formula::VertexFace<double> forms() const { return {{moving(d_[0]), moving(d_[1]), moving(d_[2])}}; }

  /// What the insides say, seen along the axis, on all of [low, high].
  Verdict inside(double low, double high) const {
    const double t = 0.5 * (low + high), reach = (high - t) + 2 * u;
    const PlaneView view(normal_, t);
    const Vec<double, 2> d0 = view(d_[0]), d1 = view(d_[1]), d2 = view(d_[2]);
    const double bound = 25 * u + 9 * reach;
    const auto collinear = [&](std::size_t a, std::size_t b) { return view.share_a_coordinate(query_, {0, a, b}); };
    InsideSigns signs;
    signs.add(formula::cross(d0, d1), bound * (m_[0] * m_[1]), [&] { return collinear(1, 2); });
    signs.add(formula::cross(d1, d2), bound * (m_[1] * m_[2]), [&] { return collinear(2, 3); });
    signs.add(formula::cross(d2, d0), bound * (m_[2] * m_[0]), [&] { return collinear(3, 1); });
    return signs.verdict();
  }

  DoubleSigns<3> signs() const {
    const double v = volume() * u;
    const std::array<double, 3> area = {m_[0] * m_[1] * u, m_[1] * m_[2] * u, m_[2] * m_[0] * u};
    return {coplanarity_units * v,
            coplanarity_level_units * v,
            {inside_units * area[0], inside_units * area[1], inside_units * area[2]},
            {inside_level_units * area[0], inside_level_units * area[1], inside_level_units * area[2]}};
  }
};

// --- edge_edge -------------------------------------------------------------------------------------------------------

class EdgeEdgeFilter : public FourPoints<EdgeEdge3> {
 public:
  using FourPoints::FourPoints;

  formula::EdgeEdge<double> forms() const { return {moving(d_[0]), moving(d_[1]), moving(d_[2])}; }

  /// What the insides say, seen along the axis, on all of [low, high].
  Verdict inside(double low, double high) const {
    const double t = 0.5 * (low + high), reach = (high - t) + 2 * u;
    const PlaneView view(normal_, t);
    const Vec<double, 2> du = view(d_[0]), dv = view(d_[1]), dw = view(d_[2]);
    const double wu = formula::cross(dw, du), wv = formula::cross(dw, dv), c = formula::cross(du, dv);
    const double bound = 25 * u + 9 * reach;
    const auto [mu, mv, mw] = m_;
    const double size_wu = bound * (mw * mu), size_wv = bound * (mw * mv), size_c = bound * (mu * mv);
    const auto collinear = [&](const std::array<std::size_t, 3>& points) {
      return view.share_a_coordinate(query_, points);
    };
    InsideSigns signs;  // a0 a1 b0, a0 a1 b1, a0 b0 b1, a1 b0 b1
    signs.add(wu, size_wu, [&] { return collinear({0, 1, 2}); });
    signs.add(c - wu, size_c + size_wu, [&] { return collinear({0, 1, 3}); });
    signs.add(wv, size_wv, [&] { return collinear({0, 2, 3}); });
    signs.add(c - wv, size_c + size_wv, [&] { return collinear({1, 2, 3}); });
    return signs.verdict();
  }

  DoubleSigns<4> signs() const {
    const auto [mu, mv, mw] = m_;
    const double v = volume() * u, wu = mw * mu * u, wv = mw * mv * u, uv = mu * mv * u;
    return {coplanarity_units * v,
            coplanarity_level_units * v,
            {inside_units * wu, inside_difference_units * (uv + wu), inside_units * wv,
             inside_difference_units * (uv + wv)},
            {inside_level_units * wu, inside_level_units * (uv + wu), inside_level_units * wv,
             inside_level_units * (uv + wv)}};
  }
};

// --- Stage: bernstein ------------------------------------------------------------------------------------------------

/// How often a piece of the step may be split. Queries still open after three splits are nearly always degenerate.
constexpr int subdivision_depth = 3;

/// Root by root: the quick way for queries that are not degenerate. `near_border` as in RootSearch.
template <class Filter>
Decision search_roots(const Filter& filter, bool& near_border) {
  const double volume = filter.volume() * u;
  const RoundedCubic cubic{filter.coplanarity(), coplanarity_units * volume, coplanarity_level_units * volume};
  const auto inside = [&filter](double low, double high, int) { return filter.inside(low, high); };
  RootSearch search(cubic, inside);
  const Decision decision = search.run(subdivision_depth);
  near_border = search.near_border();
  return decision;
}

/// The Bernstein search on the forms of a query, seen along an axis.
template <class Forms, class Signs>
Decision search(const Forms& forms, std::size_t axis, const Signs& signs) {
  const auto f = bernstein::scaled_coefficients(forms.coplanarity());
  using Number = typename decltype(f)::value_type;
  using Piece = bernstein::Piece<Number, 3, Forms::insides_count, 2>;
  Piece piece{f, {}, {}, 0, 1};
  const auto insides = forms.insides(axis);
  for (std::size_t k = 0; k < insides.size(); ++k) piece.g[k] = bernstein::scaled_coefficients(insides[k]);
  bernstein::Search<Piece, Signs> search;
  const Verdict verdict = search.run(piece, signs, subdivision_depth);
  return {verdict, search.enclosure()};
}

}  // namespace noli::filter
