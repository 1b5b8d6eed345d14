// SPDX-License-Identifier: Apache-2.0
//
// Angles without arc tangent: stored as cosine and sine, so that + - * / and the square root are enough and the bits
// are the same on every machine.
//
// Notation
//   theta, theta0   an angle now and at rest; delta = theta - theta0
//   V(delta)        K (1 - cos delta), of slope K sin delta and curvature K cos delta <= K. For small delta it is
//                   K/2 delta^2 up to K/24 delta^4
//
// V weakens when delta passes a right angle, where its slope is greatest, and gives no moment at a half turn. It does
// not count turns.
#pragma once

namespace noli::integrator {

template <class S>
struct Angle {
  S cosine = S(1), sine = S(0);
};

template <class S>
Angle<S> operator-(const Angle<S>& a, const Angle<S>& b) {
  return {a.cosine * b.cosine + a.sine * b.sine, a.sine * b.cosine - a.cosine * b.sine};
}

/// 1 - cos delta, to a few ulps for small angles too.
template <class S>
S one_minus_cosine(const Angle<S>& delta) {
  return delta.cosine > S(0) ? delta.sine * delta.sine / (S(1) + delta.cosine) : S(1) - delta.cosine;
}

}  // namespace noli::integrator
