// SPDX-License-Identifier: Apache-2.0
//
// Defines numbers of 60 decimal digits, and stencils of them.
#pragma once

#include <boost/multiprecision/mpfr.hpp>
// Must come after the number type.
#include <boost/multiprecision/eigen.hpp>

#include "integrator/force.h"

namespace noli::test {

using Big = boost::multiprecision::number<boost::multiprecision::mpfr_float_backend<60>, boost::multiprecision::et_off>;

template <int Dim, std::size_t N>
integrator::VertexVectors<Big, Dim, N> to_big(const integrator::VertexVectors<double, Dim, N>& x) {
  integrator::VertexVectors<Big, Dim, N> result;
  for (std::size_t i = 0; i < N; ++i) {
    for (int d = 0; d < Dim; ++d) result[i][d] = Big(x[i][d]);
  }
  return result;
}

}  // namespace noli::test
