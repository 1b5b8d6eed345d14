// SPDX-License-Identifier: Apache-2.0
//
// Finds the first time at which two features come within a distance.
//
// Candidates are 0 and the roots of the excesses. Proof: let t > 0 be the first time. Of the pairs of points that are
// nearest at t, take one in the faces of least dimension; its part is not degenerate, and strictly inside. Its excess
// is zero at t but not throughout: just before t the part is still inside, so the features would have been within
// already.
#include "kernel/thickness.h"
#include "kernel/arithmetic/algebraic.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <vector>

#include <noli/time_of_impact.h>
#include "kernel/arithmetic/rounding.h"
#include "kernel/arithmetic/scaled_integers.h"
#include "kernel/distance_parts.h"
#include "kernel/motion_points.h"

namespace noli {
namespace {

// --- a separating direction in double precision

constexpr double error =
    16 * 0x1p-53;  // more than the seven roundings of a scalar product of differences, in any rounding mode
constexpr double smallest = 0x1p-900;  // above any effect of underflow

template <int Dim>
using Direction = std::array<double, Dim>;

/// A lower bound for n . (b - a) over the points of the features at both ends of the step; -infinity if anything
/// overflows.
template <FeaturePair Pair, int Dim>
double least_gap(const Query<Pair, Dim>& q, const Direction<Dim>& n) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto* x : {&q.x_t0, &q.x_t1}) {
    for (std::size_t i = 0; i < first_size(Pair); ++i) {
      for (std::size_t j = first_size(Pair); j < x->size(); ++j) {
        double sum = 0, size = 0;
        for (std::size_t k = 0; k < Dim; ++k) {
          const double term = n[k] * ((*x)[j][k] - (*x)[i][k]);
          sum += term;
          size += std::abs(term);
        }
        if (!std::isfinite(size)) return -std::numeric_limits<double>::infinity();
        least = std::min(least, sum - (error * size + smallest));
      }
    }
  }
  return least;
}

template <FeaturePair Pair, int Dim>
bool separates(const Query<Pair, Dim>& q, Direction<Dim> n, double eta) {
  double square = 0;
  for (const double x : n) square += x * x;
  if (!(square > 0x1p-800)) return false;
  const double needed = std::sqrt(square) * eta * (1 + error) + smallest;
  if (least_gap<Pair, Dim>(q, n) > needed) return true;
  for (double& x : n) x = -x;
  return least_gap<Pair, Dim>(q, n) > needed;
}

/// Directions worth trying: from one feature to the other and the common normal, at the middle of the step.
template <FeaturePair Pair, int Dim>
std::vector<Direction<Dim>> directions(const Query<Pair, Dim>& q) {
  std::array<Point<Dim>, point_count(Pair)> x;
  for (std::size_t i = 0; i < x.size(); ++i) {
    for (std::size_t k = 0; k < Dim; ++k) x[i][k] = 0.5 * q.x_t0[i][k] + 0.5 * q.x_t1[i][k];
  }
  using formula::operator-;
  std::vector<Direction<Dim>> result;
  for (std::size_t k = 0; k < Dim; ++k) result.emplace_back()[k] = 1;
  result.push_back(x.back() - x.front());
  if constexpr (point_count(Pair) == 4) {
    const auto u = Pair == FeaturePair::vertex_face ? x[2] - x[1] : x[1] - x[0];
    const auto v = Pair == FeaturePair::vertex_face ? x[3] - x[1] : x[3] - x[2];
    result.push_back(formula::cross(u, v));
  }
  return result;
}

template <FeaturePair Pair, int Dim>
bool surely_farther(const Query<Pair, Dim>& q, double eta) {
  if (!rounding_self_test().nearest_ok) return false;
  return std::ranges::any_of(directions(q), [&](const auto& n) { return separates<Pair, Dim>(q, n, eta); });
}

// --- exact

struct At {
  const AlgebraicNumber& t;
  int sign(const Polynomial& p) const { return t.sign_of(p); }
};

bool within(const std::vector<distance::Part>& parts, const AlgebraicNumber& t) {
  return std::ranges::any_of(parts, [&t](const auto& part) { return part.within(At{t}); });
}

std::vector<AlgebraicNumber> candidate_times(const std::vector<distance::Part>& parts) {
  std::vector<AlgebraicNumber> times;
  for (const auto& part : parts) {
    if (part.excess.is_zero()) continue;
    auto roots = roots_in_unit_interval(part.excess);
    std::move(roots.begin(), roots.end(), std::back_inserter(times));
  }
  std::sort(times.begin(), times.end());
  return times;
}

/// `points`: formula::Moving in integers, `eta` in their unit.
template <FeaturePair Pair, int Dim, class Points>
std::vector<distance::Part> exact_parts_of(const Points& points, const Integer& eta) {
  std::array<distance::Vector<Dim>, point_count(Pair)> x;
  for (std::size_t i = 0; i < x.size(); ++i) {
    for (std::size_t k = 0; k < Dim; ++k) x[i][k] = from_form({points[i].at_t0[k], points[i].at_t1[k]});
  }
  return distance::parts_of<Pair, Dim>(x, eta * eta);
}

template <FeaturePair Pair, int Dim>
std::vector<distance::Part> exact_parts(const Query<Pair, Dim>& query, double eta) {
  exact::ExponentRange range = exact::exponent_range(query);
  range.add(eta);
  return exact_parts_of<Pair, Dim>(exact::scaled<Integer>(query, range), exact::coordinate<Integer>(eta, range));
}

template <FeaturePair Pair, int Dim>
std::vector<distance::Part> exact_parts(const MotionQuery<Pair, Dim>& query, double eta) {
  const auto motion = motion::integer_points(query, eta);
  return exact_parts_of<Pair, Dim>(motion.points, motion.length);
}

std::optional<TimeOfImpact> first_within(const std::vector<distance::Part>& parts) {
  if (within(parts, AlgebraicNumber())) return TimeOfImpact();
  for (AlgebraicNumber& t : candidate_times(parts)) {
    if (within(parts, t)) return TimeOfImpact(std::move(t));
  }
  return std::nullopt;
}

}  // namespace

template <FeaturePair Pair, int Dim>
std::optional<TimeOfImpact> first_within(const Query<Pair, Dim>& query, double eta) {
  if (surely_farther(query, eta)) return std::nullopt;
  if (eta > 0) return first_within(exact_parts(query, eta));
  auto contact = first_contact(query);
  return contact ? std::optional(std::move(contact->time)) : std::nullopt;
}

template <FeaturePair Pair, int Dim>
std::optional<TimeOfImpact> first_within(const MotionQuery<Pair, Dim>& query, double eta) {
  if (eta > 0) return first_within(exact_parts(query, eta));
  auto contact = first_contact(query);
  return contact ? std::optional(std::move(contact->time)) : std::nullopt;
}

#define NOLI_FIRST_WITHIN(Pair, Dim)                                                               \
  template std::optional<TimeOfImpact> first_within(const Query<FeaturePair::Pair, Dim>&, double); \
  template std::optional<TimeOfImpact> first_within(const MotionQuery<FeaturePair::Pair, Dim>&, double);
NOLI_FIRST_WITHIN(vertex_face, 3)
NOLI_FIRST_WITHIN(edge_edge, 3)
NOLI_FIRST_WITHIN(vertex_edge, 3)
NOLI_FIRST_WITHIN(vertex_vertex, 3)
NOLI_FIRST_WITHIN(vertex_edge, 2)
NOLI_FIRST_WITHIN(vertex_vertex, 2)
#undef NOLI_FIRST_WITHIN

}  // namespace noli
