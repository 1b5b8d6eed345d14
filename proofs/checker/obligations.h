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

  friend bool operator==(const Group&, const Group&) = default;
};

struct Obligation {
  Group x, y;
  bool self = false, distance = false;
  std::uint32_t interval = 0;  ///< its number; from the bottom of the stack to its top these numbers do not fall
};

/// The interval number k of the 2^halvings into which the step is cut; d = 2^halvings.
struct Piece {
  mpz_class k;
  unsigned long halvings = 0;
};

class Obligations {
 public:
  Obligations(const Claim& claim, const Integers& motion, const Tree& tree)
      : claim_(claim), motion_(motion), tree_(tree), enclosures_(motion.motion()) {
    if (!(motion.begin() < motion.end())) reject("the step", "it ends before it begins");
    stack_.push_back({{}, {}, true, claim.eta > 0, 0});
    pieces_.push_back({0, 0});
  }

  bool done() const { return stack_.empty(); }

  /// Takes all tokens of a block.
  void take(Cursor& c) {
    while (c.left() > 0) {
      if (stack_.empty()) c.fail("a token, but nothing is left to show");
      step(c);
    }
  }

 private:
  [[noreturn]] static void refuse(const Cursor& c, const char* why) {
    c.fail(std::string("the token before this may not be used here: ") + why);
  }
  static void require(bool condition, const Cursor& c, const char* why) {
    if (!condition) refuse(c, why);
  }

  void step(Cursor& c) {
    const std::uint8_t code = c.u8();
    Obligation top = stack_.back();
    stack_.pop_back();
    switch (code) {
      case 0x00: return halve(top, c);
      case 0x01: return split(top, true, c);
      case 0x02: return split(top, false, c);
      case 0x03: return parts(top, c);
      case 0x04: return one(top, c);
      case 0x05:
        require(top.self, c, "B is for a group with itself");
        top.self = false;
        return stack_.push_back(top);
      case 0x06: return excluded(top, c);
      case 0x10: return direction(top, packed(c), c);
      case 0x11: {
        const mpz_class x = read_sint(c), y = read_sint(c), z = read_sint(c);
        const mpz_class most = std::max({abs(x), abs(y), abs(z)});
        if (most < Enclosures::limit) return direction(top, std::array<long, 3>{x.get_si(), y.get_si(), z.get_si()}, c);
        return direction(top, Direction{x, y, z}, c);
      }
      case 0x12: return half_space(top, c);
      case 0x20:
      case 0x21:
      case 0x22: return drop(top, code & 3u, c);
      case 0x30: return ring(top, c);
      default: break;
    }
    if (code < 0x08 || code > 0x0e) c.fail("the byte before this is no token");
    std::array<long, 3> n = {0, 0, 0};
    if (code < 0x0e) n[(code - 8) / 2] = code % 2 == 0 ? 1 : -1;
    direction(top, n, c);
  }

  static std::array<long, 3> packed(Cursor& c) {
    const std::uint32_t word = c.u32();
    if (word >> 30 != 0) c.fail("the highest bits of a direction are not 0");
    const auto part = [&](int k) { return static_cast<std::int32_t>(word << (22 - 10 * k)) >> 22; };
    return {part(0), part(1), part(2)};
  }

  void push_both(const Obligation& first, const Obligation& second) {
    stack_.push_back(second);
    stack_.push_back(first);
  }

  void halve(const Obligation& top, const Cursor& c) {
    pieces_.erase(pieces_.begin() + top.interval + 1, pieces_.end());  // what nobody speaks of any more
    const Piece whole = pieces_[top.interval];
    require(whole.halvings < 1024, c, "the interval is too short for T");
    Obligation first = top, second = top;
    second.interval = static_cast<std::uint32_t>(pieces_.size());
    first.interval = second.interval + 1;
    pieces_.push_back({2 * whole.k + 1, whole.halvings + 1});
    pieces_.push_back({2 * whole.k, whole.halvings + 1});
    push_both(first, second);
  }

  void split(const Obligation& top, bool first, const Cursor& c) {
    const Tree::Node& node = tree_.node((first ? top.x : top.y).node);
    require(!top.self && !node.leaf(), c, "L and R are for a pair, the group of which has parts");
    Obligation left = top, right = top;
    (first ? left.x : left.y).node = node.left;
    (first ? right.x : right.y).node = node.right;
    push_both(left, right);
  }

  void parts(const Obligation& top, const Cursor& c) {
    const Tree::Node& node = tree_.node(top.x.node);
    require(top.self && !node.leaf(), c, "N is for a group with itself that has parts");
    Obligation left = top, right = top, both = top;
    left.x.node = left.y.node = both.x.node = node.left;
    right.x.node = right.y.node = both.y.node = node.right;
    both.self = false;
    stack_.push_back(right);
    push_both(left, both);
  }

  void one(const Obligation& top, const Cursor& c) const {
    require(top.self && tree_.node(top.x.node).leaf() && !claim_.strict, c,
            "F is for one cell by itself, of a claim that is not strict");
  }

  void excluded(const Obligation& top, const Cursor& c) const {
    const std::int64_t a = tree_.node(top.x.node).label, b = tree_.node(top.y.node).label;
    require(a >= 0 && b >= 0 && claim_.is_excluded(static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b)), c,
            "the labels are not an excluded pair");
  }

  /// Calls take(v) for each vertex of a group, ascending.
  template <class Take>
  void each(const Group& g, const Take& take) const {
    const auto all = tree_.vertices(g.node);
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (i >= 32 || (g.dropped >> i & 1) == 0) take(all[i]);
    }
  }
  std::vector<std::uint32_t> vertices(const Group& g) const {
    std::vector<std::uint32_t> result;
    each(g, [&](std::uint32_t v) { result.push_back(v); });
    return result;
  }
  /// Without a vertex that it has.
  Group less(Group g, std::uint32_t v) const {
    const auto all = tree_.vertices(g.node);
    g.dropped |= 1u << (std::ranges::find(all, v) - all.begin());
    return g;
  }
  bool leaves(const Obligation& o) const {
    return !o.self && tree_.node(o.x.node).leaf() && tree_.node(o.y.node).leaf();
  }

  void drop(const Obligation& top, std::size_t k, const Cursor& c) {
    require(leaves(top), c, "D is for two cells");
    const auto x = vertices(top.x), y = vertices(top.y);
    std::vector<std::uint32_t> common;
    std::ranges::set_intersection(x, y, std::back_inserter(common));
    require(k < common.size(), c, "there is no such common vertex");
    Obligation first = top, second = top;
    first.x = less(top.x, common[k]);
    second.y = less(top.y, common[k]);
    push_both(first, second);
  }

  bool in_cell(std::uint64_t cell, std::uint64_t v) const {
    return std::find(claim_.cells[cell].begin(), claim_.cells[cell].end(), v) != claim_.cells[cell].end();
  }

  void ring(const Obligation& top, Cursor& c) {
    const std::uint64_t m = c.uint(), v0 = c.uint();
    std::uint64_t v = v0;
    require(leaves(top) && top.distance && m < claim_.ring, c,
            "W is for two cells at distance, and a path shorter than the ring");
    for (std::uint64_t i = 0; i < m; ++i) {
      const std::uint64_t cell = c.uint(), next = c.uint();
      require(cell < claim_.cells.size() && in_cell(cell, v) && in_cell(cell, next), c,
              "a cell of the path has not its vertices");
      v = next;
    }
    const auto x = vertices(top.x), y = vertices(top.y);
    require(std::ranges::binary_search(x, v0) && std::ranges::binary_search(y, v), c,
            "the path does not join the cells");
    Obligation first = top, second = top, third = top;
    first.x = less(top.x, static_cast<std::uint32_t>(v0));
    second.y = less(top.y, static_cast<std::uint32_t>(v));
    third.distance = false;
    stack_.push_back(third);
    push_both(first, second);
  }

  /// Asks holds(interval, eta2, x, y).
  template <class Holds>
  bool decide(const Obligation& top, const Holds& holds) const {
    const Piece& piece = pieces_[top.interval];
    const mpz_class duration = motion_.end() - motion_.begin(),
                    a = (motion_.begin() << piece.halvings) + piece.k * duration;
    const Interval interval = {a, a + duration, mpz_class(1) << piece.halvings};
    std::vector<Path> paths;
    each(top.x, [&](std::uint32_t v) { paths.push_back(motion_.path(v)); });
    const std::size_t n = paths.size();
    each(top.y, [&](std::uint32_t v) { paths.push_back(motion_.path(v)); });
    Paths x, y;
    for (std::size_t i = 0; i < paths.size(); ++i) (i < n ? x : y).emplace_back(paths[i], interval);
    return holds(interval, top.distance ? mpz_class(motion_.eta() * motion_.eta()) : mpz_class(0), x, y);
  }

  /// A direction with small components, quickly if possible.
  void direction(const Obligation& top, const std::array<long, 3>& n, const Cursor& c) const {
    const Piece& piece = pieces_[top.interval];
    if (!top.self && !top.distance && enclosures_.usable(n, piece.halvings)) {
      Enclosures::Gap gap(enclosures_, n, piece.k.get_si(), static_cast<int>(piece.halvings));
      each(top.x, [&](std::uint32_t v) { gap.add(v, true); });
      each(top.y, [&](std::uint32_t v) { gap.add(v, false); });
      if (gap.open()) return;
    }
    direction(top, Direction{n[0], n[1], n[2]}, c);
  }

  void direction(const Obligation& top, const Direction& n, const Cursor& c) const {
    require(!top.self, c, "S is for a pair");
    const bool apart = decide(top, [&](const auto&... rest) { return separated(n, rest...); });
    require(apart, c, "the direction does not separate the pair");
  }

  void half_space(const Obligation& top, Cursor& c) const {
    const std::uint64_t s = c.uint();
    if (s > 4096) c.fail("a shift is above 4,096");
    Direction n;
    for (auto& part : n) part = read_sint(c) << static_cast<unsigned long>(s);
    const mpz_class nt = read_scaled(c), nd = read_scaled(c), w = read_scaled(c);
    require(!top.self, c, "P is for a pair");
    const bool apart = decide(top, [&](const auto&... rest) { return separated(n, nt, nd, w, rest...); });
    require(apart, c, "the half space does not separate the pair");
  }

  const Claim& claim_;
  const Integers& motion_;
  const Tree& tree_;
  std::vector<Obligation> stack_;
  Enclosures enclosures_;
  std::vector<Piece> pieces_;
};

}  // namespace noli::checker
