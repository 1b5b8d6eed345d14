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

struct Interval {
  mpz_class a, b, d;
};

struct Value {
  mpz_class numerator, denominator;
};

inline mpz_class dot(const Vector& n, const Vector& x) { return n[0] * x[0] + n[1] * x[1] + n[2] * x[2]; }

/// The end of the segment that has the time c/d.
inline Path::const_iterator segment_end(const Path& path, const mpz_class& c, const mpz_class& d) {
  return std::partition_point(path.begin() + 1, path.end() - 1, [&](const Breakpoint& p) { return p.t * d < c; });
}

/// Both ends of the interval and the breakpoints between, ascending.
inline std::set<mpz_class> times_of(const Interval& i, const std::vector<Path>& x, const std::vector<Path>& y) {
  std::set<mpz_class> times = {i.a, i.b};
  for (const auto* paths : {&x, &y}) {
    for (const Path& path : *paths) {
      for (auto p = segment_end(path, i.a, i.d); p != path.end() && p->t * i.d < i.b; ++p) times.insert(p->t * i.d);
    }
  }
  return times;
}

/// The values of a vertex at the times.
inline std::vector<Value> along(const Vector& n, const mpz_class& d, const Path& path,
                                const std::set<mpz_class>& times) {
  std::vector<Value> values;
  auto end = segment_end(path, *times.begin(), d);
  for (const mpz_class& c : times) {
    while (end->t * d < c) ++end;
    const mpz_class s = (end - 1)->t * d, t = end->t * d;
    values.push_back({dot(n, (end - 1)->x) * (t - c) + dot(n, end->x) * (c - s), t - s});
  }
  return values;
}

/// S: eta2 is the square of the distance asked for.
inline bool separated(const Vector& n, const Interval& i, const mpz_class& eta2, const std::vector<Path>& x,
                      const std::vector<Path>& y) {
  if (x.empty() || y.empty()) return true;
  const auto times = times_of(i, x, y);
  std::vector<Value> low;
  for (const Path& path : x) {
    const auto values = along(n, i.d, path, times);
    if (low.empty()) low = values;
    for (std::size_t k = 0; k < low.size(); ++k) {
      if (values[k].numerator * low[k].denominator < low[k].numerator * values[k].denominator) low[k] = values[k];
    }
  }
  const mpz_class least = eta2 * dot(n, n);
  for (const Path& path : y) {
    const auto values = along(n, i.d, path, times);
    for (std::size_t k = 0; k < low.size(); ++k) {
      const mpz_class h = low[k].denominator * values[k].denominator,
                      g = low[k].numerator * values[k].denominator - values[k].numerator * low[k].denominator;
      const bool apart = g > 0 && g * g > least * h * h;
      if (!apart) return false;
    }
  }
  return true;
}

/// n.u + nt t - nd > 0 over the interval: at both ends of each segment cut to it.
inline bool positive(const Vector& n, const mpz_class& nt, const mpz_class& nd, const Interval& i, const Path& path) {
  for (auto q = segment_end(path, i.a, i.d);; ++q) {
    const auto p = q - 1;
    const mpz_class f = dot(n, p->x) + nt * p->t - nd, g = dot(n, q->x) + nt * q->t - nd;
    const mpz_class s = p->t * i.d, t = q->t * i.d, from = std::max(s, i.a), to = std::min(t, i.b);
    const bool apart = f * (t - from) + g * (from - s) > 0 && f * (t - to) + g * (to - s) > 0;
    if (!apart) return false;
    if (t >= i.b) return true;
  }
}

/// P.
inline bool separated(const Vector& n, const mpz_class& nt, const mpz_class& nd, const mpz_class& w, const Interval& i,
                      const mpz_class& eta2, const std::vector<Path>& x, const std::vector<Path>& y) {
  const Vector back = {-n[0], -n[1], -n[2]};
  const bool apart = w >= 0 && eta2 * dot(n, n) <= w * w &&
                     std::ranges::all_of(x, [&](const Path& path) { return positive(n, nt, nd, i, path); }) &&
                     std::ranges::all_of(y, [&](const Path& path) { return positive(back, -nt, w - nd, i, path); });
  return apart;
}

}  // namespace noli::checker
