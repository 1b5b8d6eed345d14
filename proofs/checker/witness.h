// SPDX-License-Identifier: Apache-2.0
//
// Witnesses: proofs/FORMAT.md, section 5.
//
// Notation
//   Poly      coefficients, the constant term first; the variable is the time
//   l, u, e   the root of g is in [l / 2^e, u / 2^e]
#pragma once

#include "scene.h"

namespace noli::checker {

using Poly = std::vector<mpz_class>;

inline Poly operator+(const Poly& f, const Poly& g) {
  Poly sum = f.size() < g.size() ? g : f;
  const Poly& shorter = f.size() < g.size() ? f : g;
  for (std::size_t i = 0; i < shorter.size(); ++i) sum[i] += shorter[i];
  return sum;
}
inline Poly operator*(const Poly& f, const Poly& g) {
  Poly product(f.empty() || g.empty() ? 0 : f.size() + g.size() - 1, 0);
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
  return std::all_of(f.begin(), f.end(), [](const mpz_class& k) { return k == 0; });
}

/// 2^(e n) f(at / 2^e), where n is the degree.
inline mpz_class value(const Poly& f, const mpz_class& at, unsigned long e) {
  mpz_class sum = 0;
  for (std::size_t i = f.size(); i-- > 0;) sum = sum * at + (f[i] << (e * (f.size() - 1 - i)));
  return sum;
}

/// The least sign of its Bernstein coefficients on [l / 2^e, u / 2^e]: those of f((l + u z) / (2^e (1 + z))) (1 + z)^n,
/// n being its degree. Of 0 it is 0.
inline int least_sign(Poly f, const mpz_class& l, const mpz_class& u, unsigned long e) {
  while (!f.empty() && f.back() == 0) f.pop_back();
  Poly sum(f.size(), 0), power = {1};  // power: (l + u z)^k
  for (std::size_t k = 0; k < f.size(); ++k) {
    Poly term = mpz_class(f[k] << (e * (f.size() - 1 - k))) * power;
    for (std::size_t i = k + 1; i < f.size(); ++i) term = term * Poly{1, 1};
    sum = sum + term;
    power = power * Poly{l, u};
  }
  int least = f.empty() ? 0 : 1;
  for (const mpz_class& k : sum) least = std::min(least, sgn(k));
  return least;
}

class Witness {
 public:
  Witness(Cursor c, const Claim& claim, const Integers& motion) : claim_(claim), motion_(motion), c_(c) {
    cell_ = {c_.u32(), c_.u32()};
    for (const std::uint32_t cell : cell_) require(cell < claim.cells.size(), "a cell that is not there is named");
    for (auto& side : sides_) read(side);
    g_ = poly();
    const std::uint64_t e = c_.uint();
    require(e <= 1024, "the denominator is too long");
    e_ = e;
    l_ = read_sint(c_);
    u_ = read_sint(c_);
    c_.end();
  }

  /// Rejects what does not hold.
  void check() const {
    require(cell_[0] != cell_[1] || claim_.strict, "it is about one cell, and the claim is not strict");
    require(!claim_.is_excluded(claim_.labels[cell_[0]], claim_.labels[cell_[1]]), "the pair is excluded");
    require((motion_.begin() << e_) <= l_ && l_ <= u_ && u_ <= (motion_.end() << e_), "the time is not in the step");
    for (std::size_t s = 0; s < 2; ++s) check_vertices(s);
    require(!g_.empty() && g_.back() != 0, "the last coefficient of g is 0");
    require(sgn(value(g_, l_, e_)) * sgn(value(g_, u_, e_)) <= 0, "g has no change of sign");
    for (const auto& side : sides_) {
      for (const auto& [v, w] : side) require(not_negative(w), "a weight may be negative");
    }
    check_points();
  }

  std::string words() const {
    const auto names = [](const Side& side) {
      std::string text;
      for (const auto& [v, w] : side) text += (text.empty() ? "" : " ") + std::to_string(v);
      return text;
    };
    return "vertices {" + names(sides_[0]) + "} of cell " + std::to_string(cell_[0]) + " and {" + names(sides_[1]) +
           "} of cell " + std::to_string(cell_[1]) + " meet";
  }

 private:
  using Side = std::vector<std::pair<std::uint32_t, Poly>>;

  void require(bool condition, const char* why) const {
    if (!condition) c_.fail(std::string("the witness does not hold: ") + why);
  }

  Poly poly() {
    const std::uint8_t n = c_.u8();
    require(n >= 1 && n <= 32, "a polynomial has 1 to 32 coefficients");
    Poly f;
    for (std::uint8_t i = 0; i < n; ++i) f.push_back(read_sint(c_));
    return f;
  }

  void read(Side& side) {
    const std::uint8_t n = c_.u8();
    require(n >= 1 && n <= 3, "expected 1 to 3 vertices");
    for (std::uint8_t i = 0; i < n; ++i) {
      const std::uint32_t v = c_.u32();
      side.emplace_back(v, poly());
    }
  }

  void check_vertices(std::size_t s) const {
    const Cell& cell = claim_.cells[cell_[s]];
    for (const auto& [v, w] : sides_[s]) {
      require(std::find(cell.begin(), cell.end(), v) != cell.end(), "a vertex is not one of its cell");
      for (const auto& [other, weight] : sides_[1 - s]) require(v != other, "a vertex is on both sides");
    }
  }

  bool not_negative(const Poly& f) const { return divides(g_, f) || least_sign(f, l_, u_, e_) >= 0; }

  /// The position is `x` over `duration`.
  struct Position {
    std::array<Poly, 3> x;
    mpz_class duration;
  };

  /// On the segment from the last breakpoint at or before l on; at the last of all it rests.
  Position position(std::uint32_t v) const {
    const Path path = motion_.path(v);
    std::size_t k = path.size() - 1;
    while (k > 0 && (path[k].t << e_) > l_) --k;
    const Breakpoint& p = path[k];
    const Breakpoint q = k + 1 < path.size() ? path[k + 1] : Breakpoint{p.t + 1, p.x};
    require(u_ <= ((k + 1 < path.size() ? q : p).t << e_), "a vertex has a breakpoint between l and u");
    Position at{{}, q.t - p.t};
    for (std::size_t i = 0; i < 3; ++i) at.x[i] = {p.x[i] * q.t - q.x[i] * p.t, q.x[i] - p.x[i]};
    return at;
  }

  /// The sum of weight times position, over `duration`, and the sum of the weights.
  struct Centre {
    std::array<Poly, 3> x;
    mpz_class duration = 1;
    Poly weight;
  };

  Centre centre(const Side& side) const {
    Centre sum;
    for (const auto& [v, w] : side) {
      const Position at = position(v);
      for (std::size_t k = 0; k < 3; ++k) sum.x[k] = at.duration * sum.x[k] + sum.duration * (w * at.x[k]);
      sum.duration *= at.duration;
      sum.weight = sum.weight + w;
    }
    require(least_sign(sum.weight, l_, u_, e_) > 0, "a sum of weights may not be positive");
    return sum;
  }

  void check_points() const {
    const Centre p = centre(sides_[0]), q = centre(sides_[1]);
    bool meet = true;
    Poly square;
    for (std::size_t k = 0; k < 3; ++k) {
      const Poly d = q.duration * (q.weight * p.x[k]) + mpz_class(-p.duration) * (p.weight * q.x[k]);
      meet = meet && divides(g_, d);
      square = square + d * d;
    }
    if (meet) return;
    require(claim_.eta > 0 && !near(), "the points do not meet");
    const Poly scale = (motion_.eta() * p.duration * q.duration) * (p.weight * q.weight);
    require(not_negative(scale * scale + mpz_class(-1) * square), "the points are not as near as the least distance");
  }

  /// Whether a path of fewer than K edges joins the sides.
  bool near() const {
    std::set<std::uint32_t> reached;
    for (const auto& [v, w] : sides_[0]) reached.insert(v);
    for (std::uint32_t k = 1; k < claim_.ring; ++k) {
      const std::set<std::uint32_t> before = reached;
      for (const Cell& cell : claim_.cells) {
        if (std::any_of(cell.begin(), cell.end(), [&](auto v) { return before.count(v) != 0; }))
          reached.insert(cell.begin(), cell.end());
      }
      if (reached.size() == before.size()) break;
    }
    return std::any_of(sides_[1].begin(), sides_[1].end(),
                       [&](const auto& side) { return reached.count(side.first) != 0; });
  }

  const Claim& claim_;
  const Integers& motion_;
  Cursor c_;
  std::array<std::uint32_t, 2> cell_{};
  std::array<Side, 2> sides_;
  Poly g_;
  unsigned long e_ = 0;
  mpz_class l_, u_;
};

}  // namespace noli::checker
