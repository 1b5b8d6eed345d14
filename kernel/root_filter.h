// SPDX-License-Identifier: Apache-2.0
//
// The quick way through the Bernstein stage in double: when the roots of the coplanarity cubic can be told apart, only
// the insides at those roots matter.
//
// Notation
//   f                 the cubic, as scaled Bernstein coefficients on a piece of the step; a sign of a coefficient
//                     is *certain* when its magnitude is above `bound`
//   sliver            the part of the piece that is within `reach` of x; f has certain, opposite signs at its ends,
//                     and exactly one root in it
// One certain change of sign (Descartes) is one root: a few safeguarded steps of Halley's method propose where, and the
// signs at the ends of a sliver prove it. Two roots are separated by splitting where f seems to have its extremum.
//
// The verdict is `unknown` when f is nearly zero at an end of the step or a root is nearly double; bernstein.h decides
// more of these.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "kernel/bernstein.h"

namespace noli::filter {

using bernstein::Verdict;
/// A verdict and, with `contact`, where it may have begun.
struct Decision {
  Verdict verdict = Verdict::apart;
  TimeEnclosure enclosure;
};

constexpr Decision undecided{Verdict::unknown, {}};

using Cubic = std::array<double, 4>;

struct Root {
  double x;
  double reach;
};

/// Approximates the one root in (0, 1); stops after the first step that is no longer than `last_step`. The remaining
/// error is about the cube of that step, so its square is a generous reach.
inline Root halley(const Cubic& c, double last_step) {
  const double d0 = c[1] - c[0], d1 = c[2] - c[1], d2 = c[3] - c[2], e0 = d1 - d0;
  const double a0 = c[0], a1 = 3 * d0, a2 = 3 * e0, a3 = (d2 - d1) - e0;
  double low = 0, high = 1, x = c[0] / (c[0] - c[3]), step = 1;
  for (int i = 0; i < 8 && std::abs(step) > last_step; ++i) {
    const double f = ((a3 * x + a2) * x + a1) * x + a0;
    const double df = (3 * a3 * x + 2 * a2) * x + a1;
    const double half_ddf = 3 * a3 * x + a2;
    const bool before_root = (f < 0) == (a0 < 0);
    low = before_root ? x : low;
    high = before_root ? high : x;
    const double square = df * df, curvature = f * half_ddf;
    double next = x - f * df / (square - curvature);
    // Near an extremum of f the step is short although no root is near.
    if (!(next >= low && next <= high) || square < std::abs(curvature)) next = 0.5 * (low + high);
    step = next - x;
    x = next;
  }
  return {x, std::max(0x1p-32, step * step)};
}

/// A cubic with what is known about its coefficients.
struct RoundedCubic {
  Cubic f;
  double bound;  ///< of the error of a coefficient
  double level;  ///< of what one run of de Casteljau adds to that
};

/// The search. It calls inside(low, high, f_before) for each root, in ascending order, until that returns `contact`.
/// The root is between low and high, no other root is (except within 2^-49 beyond), and f_before is the sign of f
/// before it.
template <class Inside>
class RootSearch {
 public:
  RootSearch(const RoundedCubic& cubic, Inside& inside) : cubic_(cubic), inside_(inside) {}

  Decision run(int depth) {
    const Verdict verdict = settle(cubic_.f, cubic_.bound, 0, 1, depth);
    return {verdict, enclosure_};
  }

  /// After `unknown`: whether the reason is that at some root the features meet on or near the border of one.
  bool near_border() const { return near_border_; }

 private:
  static int sign(double x, double bound) { return (x > bound) - (x < -bound); }

  /// The part of f on [begin, begin + width].
  Verdict settle(Cubic f, double bound, double begin, double width, int depth) {
    const std::array<int, 4> s = {sign(f[0], bound), sign(f[1], bound), sign(f[2], bound), sign(f[3], bound)};
    if (s[0] * s[3] < 0) {
      if (s[1] == s[0] || s[2] == s[3]) return settle_root(f, bound, begin, width);
    } else {
      if (std::abs(s[0] + s[1] + s[2] + s[3]) == 4) return Verdict::apart;
      if (s[0] * s[3] == 0) return lost(begin);
    }
    if (depth == 0) return lost(begin);
    const double x = bernstein::proposed_split(f);
    const Cubic left = bernstein::split_at(f, x);
    const double left_width = width * x;  // exact: few bits each
    const Verdict before = settle(left, bound + cubic_.level, begin, left_width, depth - 1);
    if (before == Verdict::contact) return before;
    const Verdict after = settle(f, bound + cubic_.level, begin + left_width, width - left_width, depth - 1);
    return after == Verdict::apart ? before : after;
  }

  /// The piece has one root. A rough sliver usually suffices; narrower ones follow if it was too wide or missed the
  /// root.
  Verdict settle_root(const Cubic& f, double bound, double begin, double width) {
    const double value_bound = bound + cubic_.level;
    const Verdict rough = settle_sliver(f, halley(f, 0x1p-6), value_bound, begin, width);
    if (rough != Verdict::unknown) return rough;
    const Root root = halley(f, 0x1p-11);
    const Verdict verdict = settle_sliver(f, root, value_bound, begin, width);
    if (verdict != Verdict::unknown) return verdict;
    const Verdict sharper = settle_sliver(f, sharpened(f, root, value_bound), value_bound, begin, width);
    return sharper == Verdict::unknown ? lost(begin) : sharper;
  }

  /// One more step, and the reach that the noise of f leaves.
  static Root sharpened(const Cubic& f, const Root& root, double value_bound) {
    const double d0 = f[1] - f[0], d1 = f[2] - f[1], d2 = f[3] - f[2];
    const double slope = 3 * bernstein::value_at(std::array<double, 3>{d0, d1, d2}, root.x);
    const double x = std::clamp(root.x - bernstein::value_at(f, root.x) / slope, 0.0, 1.0);
    return {x, std::max(0x1p-46, 4 * value_bound / std::abs(slope))};
  }

  Verdict settle_sliver(const Cubic& f, const Root& root, double value_bound, double begin, double width) {
    const double low = std::max(0.0, root.x - root.reach), high = std::min(1.0, root.x + root.reach);
    if (!(high - low < 0.125))
      return Verdict::unknown;  // nothing would be certain on it, and the error bounds hold only for short slivers
    const int before = sign(bernstein::value_at(f, low), value_bound);
    if (before * sign(bernstein::value_at(f, high), value_bound) >= 0) return Verdict::unknown;
    constexpr double outward = 0x1p-50;  // above the rounding of times, which stay in [0, 1]
    const double first = begin + width * low - outward, last = begin + width * high + outward;
    const Verdict verdict = inside_(first, last, before);
    near_border_ |= verdict == Verdict::unknown;
    if (verdict == Verdict::contact) enclosure_ = {std::max(0.0, std::min(first_lost_, first)), std::min(1.0, last)};
    return verdict;
  }

  Verdict lost(double begin) {
    first_lost_ = std::min(first_lost_, begin);
    return Verdict::unknown;
  }

  const RoundedCubic& cubic_;
  Inside& inside_;
  bool near_border_ = false;
  double first_lost_ = 1;
  TimeEnclosure enclosure_;
};

}  // namespace noli::filter
