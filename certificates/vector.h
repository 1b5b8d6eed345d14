// SPDX-License-Identifier: Apache-2.0
//
// Points and straight motions of the certificates: Eigen's small vectors, without its vector instructions, so that the
// bits are those of the formulas.
#pragma once

#include <Eigen/Core>

namespace noli::certificates {

template <int Dim, class S = double>
using Vector = Eigen::Matrix<S, Dim, 1, Eigen::DontAlign>;

/// A vertex as it moves until its velocity changes: x + (time - t) v.
template <int Dim>
struct Line {
  Vector<Dim> x;
  double t = 0;
  Vector<Dim> v;

  Vector<Dim> at(double time) const { return x + (time - t) * v; }
};

}  // namespace noli::certificates
