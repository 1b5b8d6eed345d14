// SPDX-License-Identifier: Apache-2.0
//
// A short way to write polynomials in tests.
#pragma once

#include <utility>
#include <vector>

#include "kernel/arithmetic/polynomial.h"

namespace noli::test {

/// c[0] + c[1] t + ... + c[n] t^n
inline Polynomial polynomial(const std::vector<long>& c) {
  std::vector<Integer> coefficients;
  coefficients.reserve(c.size());
  for (const long x : c) coefficients.emplace_back(x);
  return Polynomial(std::move(coefficients));
}

}  // namespace noli::test
