// SPDX-License-Identifier: Apache-2.0
//
// Checks witnesses: proofs/FORMAT.md, section 5.
//
// Notation
//   Poly      coefficients, the constant term first; the variable is the time
//   l, u, e   the root of g is in [l / 2^e, u / 2^e]
#pragma once

#include "asked.h"
#include "separation.h"

namespace noli::checker {

using Poly = std::vector<mpz_class>;

inline Poly operator+(const Poly& f, const Poly& g) {
  if (f.size() < g.size()) return g + f;
  Poly sum = f;
  for (std::size_t i = 0; i < g.size(); ++i) sum[i] += g[i];
  return sum;
}
inline Poly operator*(const Poly& f, const Poly& g) {
  Poly product(g.empty() ? 0 : f.size() + g.size() - 1, 0);
  for (std::size_t i = 0; i < f.size(); ++i) {
    for (std::size_t j = 0; j < g.size(); ++j) product[i + j] += f[i] * g[j];
  }
  return product;
}
inline Poly operator*(const mpz_class& k, const Poly& f) { return Poly{k} * f; }

/// Whether g, whose last coefficient is not 0, divides f over the rational numbers.
inline bool divides(const Poly& g, Poly f) {
  while (f.size() >= g.size()) {
    const mpz_class lead = f.back();
    for (auto& coefficient : f) coefficient *= g.back();
    for (std::size_t i = 0; i < g.size(); ++i) f[f.size() - g.size() + i] -= lead * g[i];
    f.pop_back();
  }
  return std::ranges::all_of(f, [](const mpz_class& k) { return k == 0; });
}

/// The Bernstein coefficients of f on [l / 2^e, u / 2^e], up to positive factors: those of
/// 2^(e n) f((l + u z) / (2^e (1 + z))) (1 + z)^n, n being its degree. The first and last are f(l / 2^e), f(u / 2^e).
inline Poly bernstein(Poly f, const mpz_class& l, const mpz_class& u, unsigned long e) {
  while (!f.empty() && f.back() == 0) f.pop_back();
  Poly sum(f.size(), 0), power = {1};  // power: (l + u z)^k
  for (std::size_t k = 0; k < f.size(); ++k) {
    Poly term = mpz_class(f[k] << (e * (f.size() - 1 - k))) * power;
    for (std::size_t i = k + 1; i < f.size(); ++i) term = term * Poly{1, 1};
    sum = sum + term;
    power = power * Poly{l, u};
  }
  return sum;
}

/// Checks a witness; throws Rejected if it does not hold.
class Witness {
 public:
  Witness(Reader c, const Claim& claim, const Integers& motion) : claim_(claim), motion_(motion), c_(std::move(c)) {
    const std::uint32_t i = c_.u32(), j = c_.u32();
    require(std::max(i, j) < claim.cells.size(), "a cell that is not there is named");
    p_ = read(claim.cells[i]);
    q_ = read(claim.cells[j]);
    g_ = poly();
    e_ = c_.uint();
    require(e_ <= 8192, "the denominator is too long");
    l_ = c_.sint();
    u_ = c_.sint();
    c_.end();
    require(i != j || claim_.strict, "it is about one cell, and the claim is not strict");
    require(!claim_.is_excluded(claim_.cells[i].label, claim_.cells[j].label), "the pair is excluded");
    const Piece& step = motion_.step();
    require((step.a << e_) <= l_ && l_ <= u_ && u_ <= (step.b << e_), "the time is not in the step");
    for (const auto& [v, w] : p_) require(std::ranges::count(q_, v, &Corner::v) == 0, "a vertex is on both sides");
    require(g_.back() != 0, "the last coefficient of g is 0");
    const Poly signs = bernstein(g_, l_, u_, e_);
    require(sgn(signs.front()) * sgn(signs.back()) <= 0, "g has no change of sign");
    const std::uint32_t a = claim.cells[i].label, b = claim.cells[j].label;
    shown_.one_cell = i == j;
    shown_.of_points = std::max(i, j) >= claim.listed;
    shown_.labels = {std::min(a, b), std::max(a, b)};
    const bool same = meet(centre(p_), centre(q_));
    shown_.near = !same;
    words_ = "vertices" + names(p_, i) + " and" + names(q_, j) + (same ? " meet" : " are too near");
  }

  const std::string& words() const { return words_; }
  const Shown& shown() const { return shown_; }

 private:
  struct Corner {
    std::uint32_t v;
    Poly weight;
  };
  using Corners = std::vector<Corner>;
  /// The sum of weight times position, over `duration`, and the sum of the weights.
  struct Centre {
    std::array<Poly, 3> x;
    mpz_class duration = 1;
    Poly weight;
  };

  void require(bool condition, const char* why) const { c_.require(condition, why); }

  Poly poly() {
    const std::uint8_t n = c_.u8();
    require(n >= 1 && n <= 32, "a polynomial has 1 to 32 coefficients");
    Poly f(n);
    for (auto& coefficient : f) coefficient = c_.sint();
    return f;
  }
  Corners read(const Cell& cell) {
    const std::uint8_t n = c_.u8();
    require(n >= 1 && n <= 3, "expected 1 to 3 vertices");
    Corners corners(n);
    for (Corner& corner : corners) {
      corner.v = c_.u32();
      require(cell.has(corner.v), "a vertex is not one of its cell");
      corner.weight = poly();
    }
    return corners;
  }
  static std::string names(const Corners& corners, std::uint32_t cell) {
    std::string text;
    for (const Corner& corner : corners) text += (text.empty() ? " {" : " ") + std::to_string(corner.v);
    return text + "} of cell " + std::to_string(cell);
  }

  /// The least sign of the Bernstein coefficients of f; 0 if f = 0.
  int least_sign(const Poly& f) const {
    const Poly coefficients = bernstein(f, l_, u_, e_);
    return coefficients.empty() ? 0 : sgn(std::ranges::min(coefficients));
  }
  bool not_negative(const Poly& f) const { return divides(g_, f) || least_sign(f) >= 0; }

  Centre centre(const Corners& corners) const {
    Centre sum;
    for (const auto& [v, w] : corners) {
      require(not_negative(w), "a weight may be negative");
      // The segment that begins at the last breakpoint at or before l; after the last breakpoint the vertex rests.
      Path path = motion_.path(v, motion_.step());
      std::size_t k = path.size() - 1;
      while (k > 0 && (path[k].t << e_) > l_) --k;
      const bool last = k + 1 == path.size();
      if (last) path.push_back({path[k].t + 1, path[k].x});
      const Breakpoint &p = path[k], &q = path[k + 1];
      require(u_ <= ((last ? p : q).t << e_), "a vertex has a breakpoint between l and u");
      const mpz_class duration = q.t - p.t;
      for (std::size_t i = 0; i < 3; ++i) {
        const Poly x = {p.x[i] * q.t - q.x[i] * p.t, q.x[i] - p.x[i]};
        sum.x[i] = duration * sum.x[i] + sum.duration * (w * x);
      }
      sum.duration *= duration;
      sum.weight = sum.weight + w;
    }
    require(least_sign(sum.weight) > 0, "a sum of weights may not be positive");
    return sum;
  }

  /// Whether the two points coincide; otherwise they are too near.
  bool meet(const Centre& p, const Centre& q) const {
    bool same = true;
    Poly square;
    for (std::size_t k = 0; k < 3; ++k) {
      const Poly d = q.duration * (q.weight * p.x[k]) + mpz_class(-p.duration) * (p.weight * q.x[k]);
      same = same && divides(g_, d);
      square = square + d * d;
    }
    if (same) return true;
    require(claim_.eta > 0, "the points do not meet");
    require(!near(), "the points do not meet, and the distance of what is so near by edges does not count");
    const Poly scale = (motion_.eta() * p.duration * q.duration) * (p.weight * q.weight);
    require(not_negative(scale * scale + mpz_class(-1) * square), "the points are not as near as the least distance");
    return false;
  }

  /// Whether a path of fewer than K edges joins the sides. Reaches vertices from P, one edge at a time.
  bool near() const {
    std::vector<std::vector<std::uint32_t>> cells(claim_.same.size());  // by vertex
    for (std::uint32_t i = 0; i < claim_.cells.size(); ++i) {
      for (const std::uint32_t v : claim_.cells[i]) cells[v].push_back(i);
    }
    std::set<std::uint32_t> reached, border;
    for (const Corner& corner : p_) border.insert(corner.v);
    for (std::uint32_t k = 1; !border.empty(); ++k) {
      reached.merge(std::set(border));
      std::set<std::uint32_t> next;
      for (const std::uint32_t v : border) {
        for (const std::uint32_t i : cells[v]) {
          for (const std::uint32_t w : claim_.cells[i])
            if (k < claim_.ring && !reached.contains(w)) next.insert(w);
        }
      }
      border = std::move(next);
    }
    return std::ranges::any_of(q_, [&](const Corner& corner) { return reached.contains(corner.v); });
  }

  const Claim& claim_;
  const Integers& motion_;
  Reader c_;
  Corners p_, q_;
  Poly g_;
  std::uint64_t e_ = 0;
  mpz_class l_, u_;
  Shown shown_;
  std::string words_;
};

}  // namespace noli::checker
