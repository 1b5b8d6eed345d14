// SPDX-License-Identifier: Apache-2.0
//
// Computes a straight line near a world line over a time interval, and how far the world line strays from it.
//
// Notation
//   u          2^-53; fl(.) rounds to nearest
//   [b, e]     the interval: b < e within [T0, T1]
//   x(t)       one coordinate of the world line, exactly; x_a, x_b its rounded values at b and e, which are exact if b,
//              e are breakpoints
//   L(t)       the line through (b, x_a) and (e, x_b);   low, high  its least and greatest deviation (rounded) x_k -
//              L(t_k) over the breakpoints b < t_k < e, and 0
//   chord      L moved by fl((low + high) / 2), its ends rounded: x_t0 at b, x_t1 at e
//   M          a bound of all values involved
//
// Claim: |x(t) - chord(t)| <= radius for all t in [b, e], and fl(x_t0 - radius), fl(x_t0 + radius) (and the same with
// x_t1) are bounds of chord -+ the true deviation, too.
// Proof. If b is not a breakpoint, w = (b - t_k) / (t_k+1 - t_k) has a relative error of 3.01 u; the difference of two
// positions is at most 2 M and has one of u. So the error of x_a is at most (6.1 + 2 + 2 + 1.1) u M < 12 u M. At a
// breakpoint inside, (t_k - b) / (e - b), computed as a product with a rounded reciprocal, has a relative error of
// 4.01 u. So the error of L(t_k) is at most (8.1 + 2 + 2 + 1.1) u M, and that of the deviation, at most 4 M, 4 u M
// more: 18 u M. Between breakpoints x - L is linear. Moving L rounds by 2 u M in the middle, 3 u M at the ends, 4 u M
// in the half width. The total is 27 u M, plus 8 u M for the two bounds and 5 u M for the sum below; the radius has a
// margin of 64 u M. Products may underflow by less than 2^-1070 in all, for which 2^-1021 is added. If something
// overflows, or e - b or its reciprocal is beyond the normal doubles, the radius is infinite and the chord zero.
// A world line without breakpoints inside and with breakpoints at both ends is its own chord: then the radius is 0.
//
// The strip is along L, so it need not be the narrowest one.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

#include "trajectory/world_lines.h"

namespace noli {

template <int Dim>
struct Chord {
  std::array<double, Dim> x_t0, x_t1, radius;
  std::size_t inside;  ///< number of breakpoints b < t_k < e
};

/// The breakpoints of one vertex.
struct WorldLine {
  std::span<const double> t;
  std::span<const Position> x;

  WorldLine(const WorldLines& lines, VertexId v) : t(lines.times(v)), x(lines.positions(v)) {}

  /// The segment that contains `time` and begins before it, or at T0. Precondition: T0 <= time <= T1.
  std::size_t segment_before(double time) const {
    return static_cast<std::size_t>(std::lower_bound(t.begin() + 1, t.end() - 1, time) - t.begin()) - 1;
  }
  /// The segment that contains `time` and ends after it, or at T1.
  std::size_t segment_after(double time) const {
    return static_cast<std::size_t>(std::upper_bound(t.begin() + 1, t.end() - 1, time) - t.begin()) - 1;
  }
};

namespace detail {

/// One end of a chord before it is moved, with a bound of the values from which it is computed.
template <int Dim>
struct ChordEnd {
  std::array<double, Dim> x, most;
  bool exact;
};

template <int Dim>
ChordEnd<Dim> chord_end(const WorldLine& line, std::size_t segment, double time) {
  ChordEnd<Dim> end;
  const bool at_begin = time == line.t[segment], at_end = time == line.t[segment + 1];
  end.exact = at_begin || at_end;
  const double span = line.t[segment + 1] - line.t[segment];
  const double w = std::isfinite(span) ? (time - line.t[segment]) / span : std::numeric_limits<double>::quiet_NaN();
  const Position &p = line.x[segment], &q = line.x[segment + 1];
  for (std::size_t k = 0; k < Dim; ++k) {
    end.x[k] = at_begin ? p[k] : at_end ? q[k] : p[k] + w * (q[k] - p[k]);
    end.most[k] = end.exact ? std::abs(end.x[k]) : std::max(std::abs(p[k]), std::abs(q[k]));
  }
  return end;
}

/// The deviations of some breakpoints from a line.
template <int Dim>
struct Strip {
  std::array<double, Dim> low{}, high{};
};

template <int Dim>
Strip<Dim> deviations(const WorldLine& line, std::size_t first, std::size_t last, double begin, double end,
                      const std::array<double, Dim>& a, const std::array<double, Dim>& b) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const double span = end - begin, per_time = 1 / span;
  const bool usable = std::isfinite(span) && std::isnormal(per_time);
  std::array<double, Dim> d;
  for (std::size_t k = 0; k < Dim; ++k) d[k] = b[k] - a[k];
  Strip<Dim> strip;
  for (std::size_t k = 0; k < Dim; ++k) strip.high[k] = usable && std::isfinite(d[k]) ? 0 : infinity;
  for (std::size_t i = first; i < last; ++i) {
    const double s = (line.t[i] - begin) * per_time;
    for (std::size_t k = 0; k < Dim; ++k) {
      const double away = line.x[i][k] - (a[k] + s * d[k]);
      strip.low[k] = away < strip.low[k] ? away : strip.low[k];
      strip.high[k] = away > strip.high[k] ? away : strip.high[k];
    }
  }
  return strip;
}

}  // namespace detail

/// The chord over [begin, end]. Preconditions: T0 <= begin < end <= T1.
template <int Dim>
Chord<Dim> chord_of(const WorldLine& line, double begin, double end) {
  const std::size_t first = line.segment_after(begin), last = line.segment_before(end);
  const auto a = detail::chord_end<Dim>(line, first, begin), b = detail::chord_end<Dim>(line, last, end);
  Chord<Dim> chord{a.x, b.x, {}, last - first};
  if (first == last && a.exact && b.exact) return chord;
  const auto strip = detail::deviations<Dim>(line, first + 1, last + 1, begin, end, a.x, b.x);
  for (std::size_t k = 0; k < Dim; ++k) {
    const double low = strip.low[k], high = strip.high[k], centre = 0.5 * (low + high);
    const double most = std::max(a.most[k], b.most[k]) + std::max(high, -low);
    chord.x_t0[k] += centre;
    chord.x_t1[k] += centre;
    chord.radius[k] = std::max(high - centre, centre - low) + (0x1p-47 * most + 0x1p-1021);
    if (std::isfinite(chord.x_t0[k] + chord.x_t1[k] + chord.radius[k])) continue;
    chord.x_t0[k] = chord.x_t1[k] = 0;
    chord.radius[k] = std::numeric_limits<double>::infinity();
  }
  return chord;
}

}  // namespace noli
