// SPDX-License-Identifier: Apache-2.0
//
// Writes directions with few bits as tokens.
//
// A direction whose components are integers of at most ten bits takes a token of five bytes, and an axis one byte. It
// is rounded before it is tested, so the tested direction is the one that is written.
#pragma once

#include <cmath>

#include "kernel/arithmetic/scaled_integers.h"
#include "proofs/prover/cells/direction.h"
#include "proofs/prover/tokens/tokens.h"

namespace noli {

/// n, scaled and rounded to integers from -511 to 511. If its components are tiny, infinite or NaN, the result passes
/// no test.
template <std::size_t Dim>
[[gnu::always_inline]] inline std::array<double, Dim> shortened(const std::array<double, Dim>& n) {
  double most = std::max(std::abs(n[0]), std::abs(n[1]));
  if constexpr (Dim == 3) most = std::max(most, std::abs(n[2]));
  const double scale = 511 / most;
  constexpr double whole = 0x1.8p52;  // adding it rounds to an integer
  std::array<double, Dim> m;
  for (std::size_t k = 0; k < Dim; ++k) m[k] = (n[k] * scale + whole) - whole;
  return m;
}

/// Writes a direction of integers from -511 to 511.
template <std::size_t Dim>
[[gnu::always_inline]] inline void put_short(const std::array<double, Dim>& m, double sign, Tokens& tokens) {
  std::array<int, 3> n{};
  for (std::size_t k = 0; k < Dim; ++k) n[k] = static_cast<int>(sign * m[k]);
  const int used = (n[0] != 0 ? 1 : 0) + (n[1] != 0 ? 1 : 0) + (n[2] != 0 ? 1 : 0);
  if (used != 1) return tokens.direction(n);
  const std::size_t k = n[0] != 0 ? 0 : n[1] != 0 ? 1 : 2;
  tokens.axis(k, n[k] > 0);
}

/// Writes a direction that passes a test, with as few bits as still pass it.
template <std::size_t Dim, class Passes>
void put_direction(const std::array<double, Dim>& n, const Passes& passes, Tokens& tokens) {
  std::array<double, Dim> m = shortened(n);
  if (passes(m)) return put_short(m, 1, tokens);
  double most = 0;
  for (const double part : n) most = std::max(most, std::abs(part));
  for (const double scale : {0x1p20, 0x1p31, 0x1p45}) {
    for (std::size_t k = 0; k < Dim; ++k) m[k] = std::nearbyint(n[k] / most * scale);
    if (passes(m)) break;
    m = n;
  }
  exact::ExponentRange range;
  range.add(m);
  std::array<Integer, 3> integers;
  for (std::size_t k = 0; k < Dim; ++k) integers[k] = exact::coordinate<Integer>(m[k], range);
  tokens.direction(integers);
}

}  // namespace noli
