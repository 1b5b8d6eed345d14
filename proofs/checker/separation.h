// SPDX-License-Identifier: Apache-2.0
//
// The conditions that close an obligation about two groups: S and P of proofs/FORMAT.md, section 3.
//
// Notation
//   [a/d, b/d]   the interval; c is a time with that denominator
//   value        n.u of a vertex at a time: a fraction, numerator and denominator > 0
//   path         the breakpoints of a vertex, which cover the interval
#pragma once

#include "scene.h"

namespace noli::checker {

using Direction = std::array<mpz_class, 3>;

struct Interval {
  mpz_class a, b, d;
};

inline mpz_class dot(const Direction& n, const std::array<mpz_class, 3>& x) {
  return n[0] * x[0] + n[1] * x[1] + n[2] * x[2];
}

/// A path with the number of its first segment that does not end at or before a/d, made by search.
struct Placed {
  const Path* path;
  std::size_t segment;

  Placed(const Path& p, const Interval& i) : path(&p), segment(0) {
    std::size_t high = p.size() - 1;  // the segment is in [segment, high)
    while (high - segment > 1) {
      const std::size_t middle = (segment + high) / 2;
      (p[middle].t * i.d <= i.a ? segment : high) = middle;
    }
  }
};

/// A group over an interval.
using Paths = std::vector<Placed>;

struct Value {
  mpz_class numerator, denominator;
};

inline bool less(const Value& p, const Value& q) { return p.numerator * q.denominator < q.numerator * p.denominator; }

/// Whether q - p is positive, and its square above `least`.
inline bool over(const mpz_class& least, const Value& p, const Value& q) {
  const mpz_class g = q.numerator * p.denominator - p.numerator * q.denominator, h = p.denominator * q.denominator;
  return g > 0 && least * h * h < g * g;
}

/// Both ends of the interval and the breakpoints between, ascending.
inline std::set<mpz_class> times_of(const Interval& i, const Paths& x, const Paths& y) {
  std::set<mpz_class> times = {i.a, i.b};
  for (const Paths* paths : {&x, &y}) {
    for (const auto& [path, segment] : *paths) {
      for (std::size_t k = segment + 1; k < path->size() && (*path)[k].t * i.d < i.b; ++k)
        times.insert((*path)[k].t * i.d);
    }
  }
  return times;
}

/// The values of a vertex at the times, which have all of its breakpoints between the first and the last of them.
inline std::vector<Value> along(const Direction& n, const Interval& i, const Placed& vertex,
                                const std::set<mpz_class>& times) {
  const Path& path = *vertex.path;
  std::size_t s = vertex.segment;
  std::vector<Value> values;
  for (const mpz_class& c : times) {
    while (path[s + 1].t * i.d < c) ++s;
    const mpz_class s0 = path[s].t * i.d, s1 = path[s + 1].t * i.d;
    values.push_back({dot(n, path[s].x) * (s1 - c) + dot(n, path[s + 1].x) * (c - s0), s1 - s0});
  }
  return values;
}

/// S: eta2 is the square of the distance asked for.
inline bool separated(const Direction& n, const Interval& i, const mpz_class& eta2, const Paths& x, const Paths& y) {
  if (x.empty() || y.empty()) return true;
  const auto times = times_of(i, x, y);
  std::vector<Value> low = along(n, i, x[0], times);
  for (const Placed& vertex : x) {
    const auto values = along(n, i, vertex, times);
    for (std::size_t k = 0; k < low.size(); ++k) {
      if (less(values[k], low[k])) low[k] = values[k];
    }
  }
  const mpz_class least = eta2 * dot(n, n);
  for (const Placed& vertex : y) {
    const auto values = along(n, i, vertex, times);
    for (std::size_t k = 0; k < low.size(); ++k) {
      if (!over(least, values[k], low[k])) return false;
    }
  }
  return true;
}

/// n.u + nt t - nd > 0 over the interval: at both ends of each segment cut to it.
inline bool positive(const Direction& n, const mpz_class& nt, const mpz_class& nd, const Interval& i,
                     const Placed& vertex) {
  const Path& path = *vertex.path;
  for (std::size_t s = vertex.segment; s + 1 < path.size() && (s == vertex.segment || path[s].t * i.d < i.b); ++s) {
    const mpz_class g0 = dot(n, path[s].x) + nt * path[s].t - nd, g1 = dot(n, path[s + 1].x) + nt * path[s + 1].t - nd;
    const mpz_class s0 = path[s].t * i.d, s1 = path[s + 1].t * i.d, from = std::max(s0, i.a), to = std::min(s1, i.b);
    if (g0 * (s1 - from) + g1 * (from - s0) <= 0 || g0 * (s1 - to) + g1 * (to - s0) <= 0) return false;
  }
  return true;
}

/// P.
inline bool separated(const Direction& n, const mpz_class& nt, const mpz_class& nd, const mpz_class& w,
                      const Interval& i, const mpz_class& eta2, const Paths& x, const Paths& y) {
  const Direction back = {-n[0], -n[1], -n[2]};
  return w >= 0 && eta2 * dot(n, n) <= w * w &&
         std::ranges::all_of(x, [&](const Placed& vertex) { return positive(n, nt, nd, i, vertex); }) &&
         std::ranges::all_of(y, [&](const Placed& vertex) { return positive(back, -nt, w - nd, i, vertex); });
}

}  // namespace noli::checker
