// SPDX-License-Identifier: Apache-2.0
#include "noli/kernel/motion.h"

#include "noli/kernel/first_contact_search.h"
#include "noli/kernel/integer_coordinates.h"

namespace noli {
namespace {

/// Times and coordinates as integers, each times a power of two of its own.
struct Scale {
  exact::ExponentRange time, space;

  Integer integer_time(double t) const { return integer_coordinate(t, time); }
  Integer integer_place(double x) const { return integer_coordinate(x, space); }
};

template <FeaturePair Pair, int Dim>
Scale scale_of(const MotionQuery<Pair, Dim>& query) {
  Scale scale;
  scale.time.add(query.begin);
  scale.time.add(query.end);
  for (const auto& path : query.paths) {
    scale.time.add(path.t0);
    scale.time.add(path.t1);
    for (std::size_t k = 0; k < Dim; ++k) {
      scale.space.add(path.x_t0[k]);
      scale.space.add(path.x_t1[k]);
    }
  }
  return scale;
}

template <int Dim>
using MovingPoint = formula::Moving<Integer, Dim>;

/// (t1 - t0) x(t) = (t1 - t) x_t0 + (t - t0) x_t1.
template <int Dim>
auto place_at(const LinearPath<Dim>& path, double t, const Scale& scale) {
  const Integer time = scale.integer_time(t);
  const Integer before = time - scale.integer_time(path.t0), after = scale.integer_time(path.t1) - time;
  formula::Vec<Integer, Dim> x;
  for (std::size_t k = 0; k < Dim; ++k) {
    x[k] = after * scale.integer_place(path.x_t0[k]) + before * scale.integer_place(path.x_t1[k]);
  }
  return x;
}

/// A point over the piece, times its denominator.
template <int Dim>
MovingPoint<Dim> moving_point(const LinearPath<Dim>& path, double begin, double end, const Scale& scale) {
  return {place_at(path, begin, scale), place_at(path, end, scale)};
}

Integer common_multiple(const Integer& a, const Integer& b) {
  Integer c;
  mpz_lcm(c.get(), a.get(), b.get());
  return c;
}

template <std::size_t Dim>
void multiply(formula::Moving<Integer, Dim>& point, const Integer& factor) {
  for (auto* x : {&point.at_t0, &point.at_t1}) {
    for (Integer& coordinate : *x) coordinate *= factor;
  }
}

/// The points of a query over its piece, in integers.
template <FeaturePair Pair, int Dim>
auto integer_points(const MotionQuery<Pair, Dim>& query) {
  const Scale scale = scale_of(query);
  std::array<MovingPoint<Dim>, point_count(Pair)> points;
  std::array<Integer, point_count(Pair)> denominators;
  Integer common(1);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto& path = query.paths[i];
    points[i] = moving_point(path, query.begin, query.end, scale);
    denominators[i] = scale.integer_time(path.t1) - scale.integer_time(path.t0);
    common = common_multiple(common, denominators[i]);
  }
  for (std::size_t i = 0; i < points.size(); ++i) multiply(points[i], divide_exactly(common, denominators[i]));
  return points;
}

int sign_after_begin(const Polynomial& p) {
  AlgebraicNumber begin;
  return condition::JustAfter{begin}.sign(p);
}

/// The k-th derivative counts with the sign of (-1)^k.
int sign_before_end(const Polynomial& p) {
  const Dyadic end = Dyadic::from_integer(1);
  int sign = 1;
  for (Polynomial d = p; !d.is_zero(); d = d.derivative()) {
    if (const int s = d.sign_at(end)) return sign * s;
    sign = -sign;
  }
  return 0;
}

}  // namespace

template <FeaturePair Pair, int Dim>
std::optional<FirstContact> first_contact(const MotionQuery<Pair, Dim>& query) {
  return condition::first_contact_of<Pair>(integer_points(query));
}

template <FeaturePair Pair, int Dim>
ContactKind kind_at_border(const MotionQuery<Pair, Dim>& before, const MotionQuery<Pair, Dim>& after) {
  const auto points_before = integer_points(before), points_after = integer_points(after);
  if (condition::first_contact_of<Pair>(points_after)->kind == ContactKind::persistent) return ContactKind::persistent;
  auto condition_before = condition::make<Pair>(points_before);
  auto condition_after = condition::make<Pair>(points_after);
  AlgebraicNumber begin;
  if (!condition_after.transversal(condition::At{begin})) return ContactKind::touching;
  const Polynomial *f = condition_before.equality(), *g = condition_after.equality();
  if (f == nullptr || g == nullptr) return ContactKind::touching;
  return sign_before_end(*f) * sign_after_begin(*g) < 0 ? ContactKind::crossing : ContactKind::touching;
}

#define NOLI_MOTION(Pair, Dim)                                                                    \
  template std::optional<FirstContact> first_contact(const MotionQuery<FeaturePair::Pair, Dim>&); \
  template ContactKind kind_at_border(const MotionQuery<FeaturePair::Pair, Dim>&,                 \
                                      const MotionQuery<FeaturePair::Pair, Dim>&);
NOLI_MOTION(vertex_face, 3)
NOLI_MOTION(edge_edge, 3)
NOLI_MOTION(vertex_edge, 3)
NOLI_MOTION(vertex_vertex, 3)
NOLI_MOTION(vertex_edge, 2)
NOLI_MOTION(vertex_vertex, 2)
#undef NOLI_MOTION

}  // namespace noli
