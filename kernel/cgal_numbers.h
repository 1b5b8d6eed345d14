// SPDX-License-Identifier: Apache-2.0
//
// Converts the kernel's integers and polynomials to and from CGAL's.
#pragma once

#include <CGAL/Gmpq.h>
#include <CGAL/Gmpz.h>

#include <utility>
#include <vector>

#include <noli/cgal.h>
#include "kernel/arithmetic/polynomial.h"

namespace noli::cgal_detail {

inline CGAL::Gmpz gmpz(const Integer& x) { return CGAL::Gmpz(x.get()); }

inline CGAL::Gmpq gmpq(const Dyadic& x) { return CGAL::Gmpq(gmpz(x.m), gmpz(Integer(1) << x.e)); }

inline Integer integer(const CGAL::Gmpz& x) {
  Integer result;
  mpz_set(result.get(), x.mpz());
  return result;
}

inline AlgebraicKernel::Polynomial_1 polynomial(const Polynomial& p) {
  std::vector<CGAL::Gmpz> c;
  for (int i = 0; i <= p.degree(); ++i) c.push_back(gmpz(p[static_cast<std::size_t>(i)]));
  return AlgebraicKernel::Polynomial_1(c.begin(), c.end());
}

inline Polynomial polynomial(const AlgebraicKernel::Polynomial_1& p) {
  std::vector<Integer> c;
  for (int i = 0; i <= p.degree(); ++i) c.push_back(integer(p[i]));
  return Polynomial(std::move(c));
}

}  // namespace noli::cgal_detail
