// SPDX-License-Identifier: Apache-2.0
//
// The conditions that close an obligation about two groups: S and P of proofs/FORMAT.md, section 3.
//
// Notation
//   c       a time over the denominator d of a piece
//   path    the breakpoints of a vertex around a piece, their times over d
//   paths   those of all vertices of both groups; the first `of_x` belong to x
#pragma once

#include "trajectory.h"

namespace noli::checker {

using Vector = std::array<mpz_class, 3>;

struct Breakpoint {
  mpz_class t;
  Vector x;
};
using Path = std::vector<Breakpoint>;
using Paths = std::span<const Path>;

/// The interval [a/d, b/d], number k of the d = 2^halvings into which the step is cut. Its id is unique.
struct Piece {
  mpz_class a, b;
  std::uint64_t k = 0, halvings = 0, id = 0;

  mpz_class d() const { return mpz_class(1) << halvings; }
};

/// The motion of a step in integers, computed on demand: positions in units of 2^p, times in units of 2^q.
class Integers {
 public:
  Integers(const Motion& motion, int p, int q, double eta, const Reader& c) : motion_(motion), p_(p), q_(q) {
    c.require(is_multiple(eta, p), "the least distance is no multiple of the step's unit");
    for (const double t : motion.times) c.require(is_multiple(t, q), "a time is no multiple of the step's unit");
    for (const Position& x : motion.x) {
      for (const double k : x) c.require(is_multiple(k, p), "a position is no multiple of the step's unit");
    }
    eta_ = integer(eta, p);
    step_ = {integer(motion.t0, q), integer(motion.t1, q)};
  }

  const Motion& motion() const { return motion_; }
  const mpz_class& eta() const { return eta_; }
  const Piece& step() const { return step_; }
  Path path(std::uint32_t v, const Piece& piece) const {
    const auto time = [&](std::uint64_t i) { return mpz_class(integer(motion_.times[i], q_) << piece.halvings); };
    std::uint64_t i = motion_.segment_end(v, [&](std::uint64_t k) { return time(k) <= piece.a; }) - 1;
    Path result;
    for (; result.empty() || result.back().t < piece.b; ++i) {
      const auto& x = motion_.x[i];
      result.push_back({time(i), {integer(x[0], p_), integer(x[1], p_), integer(x[2], p_)}});
    }
    return result;
  }

 private:
  /// x = m 2^e, m an integer: binary64 bit by bit.
  static std::pair<std::int64_t, int> parts(double x) {
    const auto bits = std::bit_cast<std::uint64_t>(x);
    const auto exponent = static_cast<int>(bits >> 52 & 0x7ff);
    const auto m = static_cast<std::int64_t>(bits << 12 >> 12) + (exponent > 0 ? std::int64_t{1} << 52 : 0);
    return {x < 0 ? -m : m, std::max(exponent, 1) - 1075};
  }
  static bool is_multiple(double x, int p) {
    const auto [m, e] = parts(x);
    return m == 0 || std::countr_zero(static_cast<std::uint64_t>(m)) + e >= p;
  }
  /// x / 2^p, which is an integer.
  static mpz_class integer(double x, int p) {
    const auto [m, e] = parts(x);
    const auto shift = static_cast<unsigned long>(std::abs(e - p));
    return e < p ? mpz_class(mpz_class(m) >> shift) : mpz_class(mpz_class(m) << shift);
  }

  const Motion& motion_;
  int p_, q_;
  mpz_class eta_;
  Piece step_;
};

struct Fraction {
  mpz_class numerator, denominator;  ///< denominator > 0
};

inline bool less(const Fraction& f, const Fraction& g) {
  return f.numerator * g.denominator < g.numerator * f.denominator;
}

inline mpz_class dot(const Vector& n, const Vector& x) { return n[0] * x[0] + n[1] * x[1] + n[2] * x[2]; }

/// n.u of a vertex at the time c.
inline Fraction value(const Vector& n, const Path& path, const mpz_class& c) {
  const auto end = std::partition_point(path.begin() + 1, path.end() - 1, [&](const Breakpoint& p) { return p.t < c; });
  const Breakpoint &p = *(end - 1), &q = *end;
  return {dot(n, p.x) * (q.t - c) + dot(n, q.x) * (c - p.t), q.t - p.t};
}

/// Both ends of the piece and the breakpoints between, ascending.
inline std::set<mpz_class> times_of(const Piece& piece, Paths paths) {
  std::set<mpz_class> times = {piece.a, piece.b};
  for (const Path& path : paths) {
    for (std::size_t i = 1; i + 1 < path.size(); ++i) times.insert(path[i].t);
  }
  return times;
}

/// S: eta2 is the square of the distance asked for.
inline bool separated(const Vector& n, const Piece& piece, const mpz_class& eta2, Paths paths, std::size_t of_x) {
  if (of_x == 0 || of_x == paths.size()) return true;
  const mpz_class least = eta2 * dot(n, n);
  for (const mpz_class& c : times_of(piece, paths)) {
    Fraction low = value(n, paths.front(), c), high = value(n, paths.back(), c);
    for (std::size_t i = 0; i < paths.size(); ++i) {
      Fraction f = value(n, paths[i], c);
      if (i < of_x ? less(f, low) : less(high, f)) std::swap(f, i < of_x ? low : high);
    }
    const mpz_class g = low.numerator * high.denominator - high.numerator * low.denominator,
                    h = low.denominator * high.denominator;
    const bool apart = g > 0 && g * g > least * h * h;
    if (!apart) return false;
  }
  return true;
}

/// P.
inline bool separated(const Vector& n, const mpz_class& nt, const mpz_class& nd, const mpz_class& w, const Piece& piece,
                      const mpz_class& eta2, Paths paths, std::size_t of_x) {
  const mpz_class d = piece.d();
  bool above = true, below = true;
  for (std::size_t i = 0; i < paths.size(); ++i) {
    const Path& path = paths[i];
    for (std::size_t k = 0; k < path.size(); ++k) {  // instead of the first and last breakpoint, the ends of the piece
      const bool inner = k > 0 && k + 1 < path.size();
      const mpz_class& c = inner ? path[k].t : k == 0 ? piece.a : piece.b;
      const auto [f, scale] = inner ? Fraction{dot(n, path[k].x), 1} : value(n, path, c);
      const mpz_class away = f * d + (nt * c - nd * d) * scale;  // n.u + nt c / d - nd, over d and its denominator
      above = above && (i >= of_x || away > 0);
      below = below && (i < of_x || away < -w * d * scale);
    }
  }
  const bool apart = w >= 0 && eta2 * dot(n, n) <= w * w && above && below;
  return apart;
}

}  // namespace noli::checker
