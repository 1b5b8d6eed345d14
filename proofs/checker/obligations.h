// SPDX-License-Identifier: Apache-2.0
//
// The stack of obligations, and what each token does to it: proofs/FORMAT.md, sections 3 and 4.
//
// Notation
//   group   a node of the tree, less up to two vertices if it is a leaf
#pragma once

#include "enclosure.h"
#include "separation.h"

namespace noli::checker {

struct Group {
  std::uint32_t node = 0;
  std::uint32_t dropped = 0;  ///< bit i: the leaf's vertex number i was dropped
};

struct Obligation {
  Group x, y;
  bool self = false, distance = false;
  std::uint32_t interval = 0;  ///< its number; from the bottom of the stack to its top these numbers do not fall
};

/// The interval number k of the 2^halvings into which the step is cut; d = 2^halvings.
struct Piece {
  mpz_class k = 0;
  unsigned long halvings = 0;
};

class Obligations {
 public:
  Obligations(const Claim& claim, const Integers& motion, const Tree& tree)
      : claim_(claim), motion_(motion), tree_(tree), enclosures_(motion.motion()) {
    stack_.push_back({{}, {}, true, claim.eta > 0, 0});
  }

  bool done() const { return stack_.empty(); }

  /// Takes all tokens of a block.
  void take(Reader& c) {
    while (c.left() > 0) {
      const std::uint8_t code = c.u8();
      c.require(!stack_.empty(), "a token, but nothing is left to show");
      const Obligation top = stack_.back();
      stack_.pop_back();
      step(code, top, c);
    }
  }

 private:
  using Side = Group Obligation::*;

  void step(std::uint8_t code, const Obligation& top, Reader& c) {
    switch (code) {
      case 0x00: return halve(top, c);
      case 0x01: return split(top, &Obligation::x, c);
      case 0x02: return split(top, &Obligation::y, c);
      case 0x03: return parts(top, c);
      case 0x04:
        c.require(top.self && leaf(top.x), "F is for one cell by itself");
        return c.require(!claim_.strict, "F is for a claim that is not strict");
      case 0x05: {
        c.require(top.self, "B is for a group with itself");
        Obligation pair = top;
        pair.self = false;
        return push({pair});
      }
      case 0x06: return excluded(top, c);
      case 0x10: return packed(top, c);
      case 0x11: {
        const mpz_class x = c.sint(), y = c.sint(), z = c.sint();
        const bool small = std::max({abs(x), abs(y), abs(z)}) < Enclosures::limit;
        if (small) return direction(top, std::array<long, 3>{x.get_si(), y.get_si(), z.get_si()}, c);
        return direction(top, Vector{x, y, z}, c);
      }
      case 0x12: return half_space(top, c);
      case 0x20:
      case 0x21:
      case 0x22: return drop(top, code & 3u, c);
      case 0x30: return ring(top, c);
      default: break;
    }
    c.require(0x08 <= code && code <= 0x0e, "the byte before this is no token");
    std::array<long, 3> n = {0, 0, 0};
    if (code < 0x0e) n[(code - 8) / 2] = code % 2 == 0 ? 1 : -1;
    direction(top, n, c);
  }

  /// The new top first.
  void push(std::initializer_list<Obligation> parts) {
    stack_.insert(stack_.end(), std::rbegin(parts), std::rend(parts));
  }
  const Tree::Node& node(const Group& g) const { return tree_.node(g.node); }
  bool leaf(const Group& g) const { return node(g).leaf(); }
  /// Calls take(v) for each vertex of a group; for a leaf, ascending.
  template <class Take>
  void each(const Group& g, const Take& take) const {
    std::uint32_t left_out = g.dropped;
    tree_.each(g.node, [&](std::uint32_t v) {
      if ((left_out & 1) == 0) take(v);
      left_out >>= 1;
    });
  }
  std::vector<std::uint32_t> vertices(const Group& g) const {
    std::vector<std::uint32_t> result;
    each(g, [&](std::uint32_t v) { result.push_back(v); });
    return result;
  }
  /// With a leaf less a vertex that it has.
  Obligation less(Obligation o, Side side, std::uint64_t v) const {
    const auto own = tree_.own((o.*side).node);
    (o.*side).dropped |= 1u << (std::ranges::find(own, v) - own.begin());
    return o;
  }

  void halve(const Obligation& top, const Reader& c) {
    pieces_.resize(top.interval + 1);  // nobody speaks of the others any more
    const Piece whole = pieces_.back();
    c.require(whole.halvings < 1024, "the interval is too short for T");
    pieces_.push_back({2 * whole.k + 1, whole.halvings + 1});
    pieces_.push_back({2 * whole.k, whole.halvings + 1});
    Obligation first = top, second = top;
    second.interval = top.interval + 1;
    first.interval = top.interval + 2;
    push({first, second});
  }

  void split(const Obligation& top, Side side, const Reader& c) {
    c.require(!top.self && !leaf(top.*side), "L and R are for a pair, the group of which has parts");
    Obligation left = top, right = top;
    (left.*side).node = node(top.*side).left;
    (right.*side).node = node(top.*side).right;
    push({left, right});
  }

  void parts(const Obligation& top, const Reader& c) {
    c.require(top.self && !leaf(top.x), "N is for a group with itself that has parts");
    const Group l{node(top.x).left, 0}, r{node(top.x).right, 0};
    push({{l, l, true, top.distance, top.interval},
          {l, r, false, top.distance, top.interval},
          {r, r, true, top.distance, top.interval}});
  }

  void excluded(const Obligation& top, const Reader& c) const {
    const std::int64_t a = node(top.x).label, b = node(top.y).label;
    c.require(a >= 0 && b >= 0, "the cells have several labels");
    c.require(claim_.is_excluded(static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b)),
              "the labels are not an excluded pair");
  }

  void drop(const Obligation& top, std::size_t k, const Reader& c) {
    c.require(!top.self && leaf(top.x) && leaf(top.y), "D is for two cells");
    std::vector<std::uint32_t> common;
    std::ranges::set_intersection(vertices(top.x), vertices(top.y), std::back_inserter(common));
    c.require(k < common.size(), "there is no such common vertex");
    push({less(top, &Obligation::x, common[k]), less(top, &Obligation::y, common[k])});
  }

  void ring(const Obligation& top, Reader& c) {
    const std::uint64_t m = c.uint(), first = c.uint();
    c.require(!top.self && leaf(top.x) && leaf(top.y) && top.distance, "W is for two cells at distance");
    c.require(m < claim_.ring && m <= 255, "a path that is not shorter than the ring, or longer than 255");
    std::uint64_t last = first;
    for (std::uint64_t i = 0; i < m; ++i) {
      const std::uint64_t cell = c.uint(), next = c.uint();
      c.require(cell < claim_.cells.size() && claim_.cells[cell].has(last) && claim_.cells[cell].has(next),
                "a cell of the path has not its vertices");
      last = next;
    }
    const auto x = vertices(top.x), y = vertices(top.y);
    c.require(std::ranges::count(x, first) == 1 && std::ranges::count(y, last) == 1,
              "the path does not join the cells");
    Obligation third = top;
    third.distance = false;
    push({less(top, &Obligation::x, first), less(top, &Obligation::y, last), third});
  }

  /// Requires holds(interval, eta2, x, y) of a pair.
  template <class Holds>
  void decide(const Obligation& top, const Reader& c, const Holds& holds) const {
    c.require(!top.self, "S and P are for a pair");
    const Piece& piece = pieces_[top.interval];
    const mpz_class duration = motion_.end() - motion_.begin(),
                    a = (motion_.begin() << piece.halvings) + piece.k * duration;
    std::vector<Path> x, y;
    each(top.x, [&](std::uint32_t v) { x.push_back(motion_.path(v)); });
    each(top.y, [&](std::uint32_t v) { y.push_back(motion_.path(v)); });
    const mpz_class eta = top.distance ? motion_.eta() : mpz_class(0);
    c.require(holds(Interval{a, a + duration, mpz_class(1) << piece.halvings}, eta * eta, x, y),
              "this does not separate the pair");
  }

  void direction(const Obligation& top, const Vector& n, const Reader& c) const {
    decide(top, c, [&](const auto&... rest) { return separated(n, rest...); });
  }
  /// With small components, quickly if possible.
  void direction(const Obligation& top, const std::array<long, 3>& n, const Reader& c) const {
    const Piece& piece = pieces_[top.interval];
    if (!top.self && !top.distance && enclosures_.usable(n, piece.halvings)) {
      Enclosures::Gap gap(enclosures_, n, piece.k.get_si(), static_cast<int>(piece.halvings));
      each(top.x, [&](std::uint32_t v) { gap.add(v, true); });
      each(top.y, [&](std::uint32_t v) { gap.add(v, false); });
      if (gap.open()) return;
    }
    direction(top, Vector{n[0], n[1], n[2]}, c);
  }
  void packed(const Obligation& top, Reader& c) const {
    const std::uint32_t word = c.u32();
    c.require(word >> 30 == 0, "the highest bits of a direction are not 0");
    const auto part = [&](int k) -> long { return static_cast<std::int32_t>(word << (22 - 10 * k)) >> 22; };
    direction(top, std::array{part(0), part(1), part(2)}, c);
  }

  void half_space(const Obligation& top, Reader& c) const {
    const unsigned long s = c.shift();
    Vector n;
    for (auto& part : n) part = c.sint() << s;
    const mpz_class nt = c.scaled(), nd = c.scaled(), w = c.scaled();
    decide(top, c, [&](const auto&... rest) { return separated(n, nt, nd, w, rest...); });
  }

  const Claim& claim_;
  const Integers& motion_;
  const Tree& tree_;
  std::vector<Obligation> stack_;
  Enclosures enclosures_;
  std::vector<Piece> pieces_{1};
};

}  // namespace noli::checker
