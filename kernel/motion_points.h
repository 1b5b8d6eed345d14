// SPDX-License-Identifier: Apache-2.0
//
// Points of a motion query (kernel/motion.h) as integers in one unit, each over its piece.
#pragma once

#include <array>
#include <utility>

#include "kernel/arithmetic/scaled_integers.h"
#include "kernel/formula.h"
#include "kernel/motion.h"

namespace noli::motion {

/// Times and coordinates as integers, each times a power of two of its own.
struct Scale {
  exact::ExponentRange time, space;

  Integer integer_time(double t) const { return exact::coordinate<Integer>(t, time); }
  Integer integer_place(double x) const { return exact::coordinate<Integer>(x, space); }
};

template <FeaturePair Pair, int Dim>
Scale scale_of(const MotionQuery<Pair, Dim>& query) {
  Scale scale;
  scale.time.add(query.begin);
  scale.time.add(query.end);
  for (const auto& path : query.paths) {
    scale.time.add(path.t0);
    scale.time.add(path.t1);
    scale.space.add(path.x_t0);
    scale.space.add(path.x_t1);
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

inline Integer common_multiple(const Integer& a, const Integer& b) {
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

/// The points of a query over its piece, and a length, as integers in one unit.
template <FeaturePair Pair, int Dim>
struct IntegerMotion {
  std::array<MovingPoint<Dim>, point_count(Pair)> points;
  Integer length;
};

/// Precondition: `length` is finite.
template <FeaturePair Pair, int Dim>
IntegerMotion<Pair, Dim> integer_points(const MotionQuery<Pair, Dim>& query, double length = 0) {
  Scale scale = scale_of(query);
  scale.space.add(length);
  std::array<MovingPoint<Dim>, point_count(Pair)> points;
  std::array<Integer, point_count(Pair)> denominators;
  Integer common(1);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto& path = query.paths[i];
    points[i] = {place_at(path, query.begin, scale), place_at(path, query.end, scale)};
    denominators[i] = scale.integer_time(path.t1) - scale.integer_time(path.t0);
    common = common_multiple(common, denominators[i]);
  }
  for (std::size_t i = 0; i < points.size(); ++i) multiply(points[i], divide_exactly(common, denominators[i]));
  return {std::move(points), common * scale.integer_place(length)};
}

}  // namespace noli::motion
