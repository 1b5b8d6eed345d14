// SPDX-License-Identifier: Apache-2.0
//
// Points and straight motions of the certificates: Eigen's small vectors, without vector instructions, so that results
// are bit for bit those of the formulas.
#pragma once

#include <Eigen/Core>

namespace noli::certificates {

template <int Dim, class S = double>
using Vector = Eigen::Matrix<S, Dim, 1, Eigen::DontAlign>;

/// The motion of a vertex until its velocity changes: x + (time - t) v.
template <int Dim>
struct Line {
  Vector<Dim> x;
  double t = 0;
  Vector<Dim> v;

  Vector<Dim> at(double time) const { return x + (time - t) * v; }
};

}  // namespace noli::certificates
