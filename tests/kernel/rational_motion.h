// SPDX-License-Identifier: Apache-2.0
//
// Evaluates motions and certificates of kernel/failure_time.h in rational arithmetic, by their definitions.
#pragma once

#include <gmpxx.h>

#include "kernel/failure_time.h"

namespace noli::test {

template <int Dim>
mpq_class coordinate(const Ray<Dim>& p, std::size_t i, const mpq_class& t) {
  return mpq_class(p.x[i]) + (t - mpq_class(p.t)) * mpq_class(p.v[i]);
}
template <int Dim>
mpq_class coordinate(const MotionSegment<Dim>& p, std::size_t i, const mpq_class& t) {
  const mpq_class part = (t - mpq_class(p.t0)) / (mpq_class(p.t1) - mpq_class(p.t0));
  return (1 - part) * mpq_class(p.x0[i]) + part * mpq_class(p.x1[i]);
}

template <int Dim>
bool holds(const Ray<Dim>& p, const MovingWall<Dim>& wall, const mpq_class& t) {
  mpq_class height = -(mpq_class(wall.offset) + mpq_class(wall.rate) * (t - mpq_class(wall.since)));
  for (std::size_t k = 0; k < Dim; ++k) height += mpq_class(wall.n[k]) * coordinate<Dim>(p, k, t);
  return wall.above ? height >= wall.half : height <= -mpq_class(wall.half);
}
template <int Dim>
bool holds(const Ray<Dim>& p, const MovingBall<Dim>& ball, const mpq_class& t) {
  mpq_class sum = 0;
  for (std::size_t k = 0; k < Dim; ++k) {
    const mpq_class d = coordinate<Dim>(p, k, t) - coordinate<Dim>(ball.centre, k, t);
    sum += d * d;
  }
  return sum <= mpq_class(ball.radius) * mpq_class(ball.radius);
}

}  // namespace noli::test
