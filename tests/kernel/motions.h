// SPDX-License-Identifier: Apache-2.0
//
// Builds motions that contain a known query as a step.
#pragma once

#include "kernel/motion.h"
#include "tests/kernel/random_queries.h"

namespace noli::test {

/// The query as a motion over [begin, end]; all paths begin and end there.
template <FeaturePair Pair, int Dim>
MotionQuery<Pair, Dim> motion_over(const Query<Pair, Dim>& query, double begin, double end) {
  MotionQuery<Pair, Dim> motion{{}, begin, end};
  for (std::size_t i = 0; i < motion.paths.size(); ++i) motion.paths[i] = {begin, end, query.x_t0[i], query.x_t1[i]};
  return motion;
}

/// The same, with each path prolonged at both ends by up to `most` steps of the same length. Precondition: the longer
/// paths are exact in double.
template <FeaturePair Pair, int Dim>
MotionQuery<Pair, Dim> prolonged(const Query<Pair, Dim>& query, Random& random, int most) {
  MotionQuery<Pair, Dim> motion = motion_over(query, 0, 1);
  for (auto& path : motion.paths) {
    const int before = random.below(most + 1), after = random.below(most + 1);
    const auto a = path.x_t0, b = path.x_t1;
    for (std::size_t k = 0; k < Dim; ++k) {
      path.x_t0[k] = a[k] - before * (b[k] - a[k]);
      path.x_t1[k] = b[k] + after * (b[k] - a[k]);
    }
    path.t0 = -before;
    path.t1 = 1 + after;
  }
  return motion;
}

}  // namespace noli::test
