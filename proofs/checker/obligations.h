// SPDX-License-Identifier: Apache-2.0
//
// The tree over the cells, the stack of obligations, and what each token does to it: proofs/FORMAT.md, sections 2 to 4.
//
// Notation
//   vertices   ids after merging, each once, ascending
//   group      a node of the tree, less up to two vertices if it is a leaf
#pragma once

#include "enclosure.h"

namespace noli::checker {

using Vertices = std::span<const std::uint32_t>;

/// The tree of block TREE. Nodes are numbered in prefix order: the root is 0, the left child of node i is i + 1.
class Tree {
 public:
  struct Node {
    std::uint32_t right = 0;             ///< 0 for a leaf
    std::uint32_t count = 0;             ///< of its vertices; 0 if it has more than `few`
    std::uint64_t first = 0;             ///< where they begin
    std::optional<std::uint32_t> label;  ///< of all cells below, if it is the same
  };

  Tree(Reader c, const std::vector<Cell>& cells) : cells_(cells), seen_(cells.size(), false) {
    nodes_.reserve(2 * cells.size());
    vertices_.reserve(24 * cells.size());  // more than a balanced tree needs; unused memory is never touched
    add(c, 0);
    c.end();
    c.require(nodes_.size() + 1 == 2 * cells.size(), "the tree has not all cells");
  }

  const Node& node(std::uint32_t i) const { return nodes_[i]; }
  /// Vertices of large nodes are not stored, as memory would grow with the depth; they are collected in `room`.
  Vertices vertices(std::uint32_t i, std::vector<std::uint32_t>& room) const {
    if (nodes_[i].count > 0) return kept(i);
    gather(i, room);
    std::ranges::sort(room);
    room.erase(std::unique(room.begin(), room.end()), room.end());
    return room;
  }

 private:
  static constexpr std::size_t few = 1024;

  Vertices kept(std::uint32_t i) const { return Vertices(vertices_).subspan(nodes_[i].first, nodes_[i].count); }
  void gather(std::uint32_t i, std::vector<std::uint32_t>& all) const {
    all.insert(all.end(), kept(i).begin(), kept(i).end());
    if (nodes_[i].count > 0) return;
    gather(i + 1, all);
    gather(nodes_[i].right, all);
  }
  /// Reads the next node, and returns its number.
  std::uint32_t add(Reader& c, int depth) {
    const std::uint64_t code = c.uint();
    const auto i = static_cast<std::uint32_t>(nodes_.size());
    nodes_.emplace_back();
    std::vector<std::uint32_t> all;  // its vertices
    if (code != 0) {
      c.require(code <= cells_.size() && !seen_[code - 1], "a cell that is not there, or is in the tree twice");
      seen_[code - 1] = true;
      nodes_[i].label = cells_[code - 1].label;
      all.assign(cells_[code - 1].begin(), cells_[code - 1].end());
      std::ranges::sort(all);
      all.erase(std::unique(all.begin(), all.end()), all.end());
    } else {
      c.require(depth < 255, "the tree is too deep");
      const std::uint32_t left = add(c, depth + 1), right = add(c, depth + 1);
      nodes_[i].right = right;
      if (nodes_[left].label == nodes_[right].label) nodes_[i].label = nodes_[left].label;
      const bool large = nodes_[left].count == 0 || nodes_[right].count == 0;
      if (!large) std::ranges::set_union(kept(left), kept(right), std::back_inserter(all));
      if (all.size() > few) all.clear();
    }
    nodes_[i].first = vertices_.size();
    nodes_[i].count = static_cast<std::uint32_t>(all.size());
    vertices_.insert(vertices_.end(), all.begin(), all.end());
    return i;
  }

  const std::vector<Cell>& cells_;
  std::vector<bool> seen_;
  std::vector<Node> nodes_;
  std::vector<std::uint32_t> vertices_;
};

/// The first byte of each token, and its letter in proofs/FORMAT.md.
enum class TokenCode : std::uint8_t {
  halve = 0x00,            ///< T
  left = 0x01,             ///< L
  right = 0x02,            ///< R
  parts = 0x03,            ///< N
  one = 0x04,              ///< F
  both = 0x05,             ///< B
  excluded = 0x06,         ///< X
  axis = 0x08,             ///< S along an axis: the first of six codes
  last_axis = 0x0d,        ///< the last of them
  empty = 0x0e,            ///< S with direction 0
  short_direction = 0x10,  ///< S
  direction = 0x11,        ///< S
  half_space = 0x12,       ///< P
  drop = 0x20,             ///< D 0
  last_drop = 0x22,        ///< D 2
  ring = 0x30              ///< W
};

/// The distance of a code from the first one of its range.
constexpr int operator-(TokenCode code, TokenCode first) { return static_cast<int>(code) - static_cast<int>(first); }

struct Group {
  std::uint32_t node = 0;
  std::uint32_t dropped = 0;  ///< bit i: the leaf's vertex number i was dropped
};

struct Obligation {
  Group x, y;
  bool self = false, distance = false;
  std::uint32_t piece = 0;  ///< its number; these numbers do not decrease from the bottom of the stack to its top
};

class Obligations {
 public:
  Obligations(const Claim& claim, const Integers& motion, const Tree& tree)
      : claim_(claim), motion_(motion), tree_(tree), enclosures_(motion.motion(), claim.eta) {
    stack_.push_back({{}, {}, true, claim.eta > 0, 0});
    pieces_.push_back(motion.step());
  }

  bool done() const { return stack_.empty(); }

  /// Takes all tokens of a block.
  void take(Reader& c) {
    while (c.left() > 0) {
      const auto code = static_cast<TokenCode>(c.u8());
      c.require(!stack_.empty(), "a token, but nothing is left to show");
      const Obligation top = stack_.back();
      stack_.pop_back();
      step(code, top, c);
    }
  }

 private:
  using Side = Group Obligation::*;

  void step(TokenCode code, const Obligation& top, Reader& c) {
    switch (code) {
      case TokenCode::halve: return halve(top, c);
      case TokenCode::left: return split(top, &Obligation::x, c);
      case TokenCode::right: return split(top, &Obligation::y, c);
      case TokenCode::parts: return parts(top, c);
      case TokenCode::one:
        c.require(top.self && leaf(top.x), "F is for one cell by itself");
        return c.require(!claim_.strict, "F is for a claim that is not strict");
      case TokenCode::both:
        c.require(top.self, "B is for a group with itself");
        return push({{top.x, top.y, false, top.distance, top.piece}});
      case TokenCode::excluded: return excluded(top, c);
      case TokenCode::short_direction: return packed(top, c);
      case TokenCode::direction: {
        const Vector n = {c.sint(), c.sint(), c.sint()};
        const bool small = std::ranges::all_of(n, [](const mpz_class& k) { return abs(k) < Enclosures::limit; });
        if (small) return direction(top, {n[0].get_si(), n[1].get_si(), n[2].get_si()}, c);
        return exactly(top, c, [&](auto&&... rest) { return separated(n, rest...); });
      }
      case TokenCode::half_space: return half_space(top, c);
      case TokenCode::ring: return ring(top, c);
      default: break;
    }
    if (TokenCode::drop <= code && code <= TokenCode::last_drop)
      return drop(top, static_cast<std::size_t>(code - TokenCode::drop), c);
    c.require(TokenCode::axis <= code && code <= TokenCode::empty, "the byte before this is no token");
    std::array<std::int64_t, 3> n = {0, 0, 0};
    const int k = code - TokenCode::axis;  // two codes for each axis
    if (code <= TokenCode::last_axis) n[static_cast<std::size_t>(k / 2)] = k % 2 == 0 ? 1 : -1;
    direction(top, n, c);
  }

  /// Pushes obligations; the first one becomes the top.
  void push(std::initializer_list<Obligation> parts) {
    stack_.insert(stack_.end(), std::rbegin(parts), std::rend(parts));
  }
  const Tree::Node& node(const Group& g) const { return tree_.node(g.node); }
  bool leaf(const Group& g) const { return node(g).right == 0; }
  /// The vertices of a group; those of a leaf with dropped ones are put into `room`.
  using Room = std::vector<std::uint32_t>;
  Vertices vertices(const Group& g, Room& room) const {
    const Vertices all = tree_.vertices(g.node, room);
    if (g.dropped == 0) return all;
    for (std::size_t i = 0; i < all.size(); ++i) {
      if ((g.dropped >> i & 1) == 0) room.push_back(all[i]);
    }
    return room;
  }
  /// The obligation with one vertex of a leaf dropped.
  Obligation less(Obligation o, Side side, std::uint64_t v) const {
    Room room;
    const Vertices all = tree_.vertices((o.*side).node, room);
    (o.*side).dropped |= 1u << (std::ranges::find(all, v) - all.begin());
    return o;
  }

  void halve(const Obligation& top, const Reader& c) {
    pieces_.resize(top.piece + 1);  // no obligation refers to the others any more
    const auto [a, b, k, halvings, id] = pieces_.back();
    c.require(halvings < 1024, "the interval is too short for T");
    pieces_.push_back({a + b, 2 * b, 2 * k + 1, halvings + 1, ++pieces_made_});
    pieces_.push_back({2 * a, a + b, 2 * k, halvings + 1, ++pieces_made_});
    push(
        {{top.x, top.y, top.self, top.distance, top.piece + 2}, {top.x, top.y, top.self, top.distance, top.piece + 1}});
  }

  void split(const Obligation& top, Side side, const Reader& c) {
    c.require(!top.self && !leaf(top.*side), "L and R are for a pair, the group of which has parts");
    Obligation left = top, right = top;
    (left.*side).node = (top.*side).node + 1;
    (right.*side).node = node(top.*side).right;
    push({left, right});
  }

  void parts(const Obligation& top, const Reader& c) {
    c.require(top.self && !leaf(top.x), "N is for a group with itself that has parts");
    const Group l{top.x.node + 1}, r{node(top.x).right};
    const auto part = [&](Group x, Group y, bool self) { return Obligation{x, y, self, top.distance, top.piece}; };
    push({part(l, l, true), part(l, r, false), part(r, r, true)});
  }

  void excluded(const Obligation& top, const Reader& c) const {
    const auto a = node(top.x).label, b = node(top.y).label;
    c.require(a && b, "the cells have several labels");
    c.require(claim_.is_excluded(*a, *b), "the labels are not an excluded pair");
  }

  void drop(const Obligation& top, std::size_t k, const Reader& c) {
    c.require(!top.self && leaf(top.x) && leaf(top.y), "D is for two cells");
    Room of_x, of_y, common;
    std::ranges::set_intersection(vertices(top.x, of_x), vertices(top.y, of_y), std::back_inserter(common));
    c.require(k < common.size(), "there is no such common vertex");
    push({less(top, &Obligation::x, common[k]), less(top, &Obligation::y, common[k])});
  }

  void ring(const Obligation& top, Reader& c) {
    const std::uint64_t m = c.uint(), first = c.uint();
    c.require(!top.self && leaf(top.x) && leaf(top.y) && top.distance, "W is for two cells at distance");
    c.require(m < claim_.ring && m <= 255, "a path that is not shorter than the ring, or longer than 255");
    std::uint64_t last = first;
    for (std::uint64_t k = 0; k < m; ++k) {
      const std::uint64_t i = c.uint(), next = c.uint();
      const auto& cells = claim_.cells;
      c.require(i < cells.size() && cells[i].has(last) && cells[i].has(next),
                "a cell of the path has not its vertices");
      last = next;
    }
    const auto has = [&](const Group& g, std::uint64_t v) {
      Room room;
      return std::ranges::count(vertices(g, room), v) == 1;
    };
    c.require(has(top.x, first) && has(top.y, last), "the path does not join the cells");
    Obligation third = top;
    third.distance = false;
    push({less(top, &Obligation::x, first), less(top, &Obligation::y, last), third});
  }

  /// A direction with small components: tries the quick tests first.
  void direction(const Obligation& top, const std::array<std::int64_t, 3>& n, const Reader& c) {
    Room of_x, of_y;
    const Vertices x = vertices(top.x, of_x), y = vertices(top.y, of_y);
    if (!top.self && !x.empty() && !y.empty() && enclosures_.apart(n, pieces_[top.piece], x, y, top.distance)) return;
    exactly(top, c, [&](auto&&... rest) { return separated(Vector{n[0], n[1], n[2]}, rest...); });
  }

  void packed(const Obligation& top, Reader& c) {
    const std::uint32_t word = c.u32();
    c.require(word >> 30 == 0, "the highest bits of a direction are not 0");
    const auto part = [&](int k) -> std::int64_t { return static_cast<std::int32_t>(word << (22 - 10 * k)) >> 22; };
    direction(top, {part(0), part(1), part(2)}, c);
  }
  void half_space(const Obligation& top, Reader& c) const {
    const unsigned long s = c.shift();
    Vector n;
    for (auto& part : n) part = c.sint() << s;
    const mpz_class nt = c.scaled(), nd = c.scaled(), w = c.scaled();
    exactly(top, c, [&](auto&&... rest) { return separated(n, nt, nd, w, rest...); });
  }

  /// Requires that holds(piece, eta2, paths, of_x) is true for a pair.
  template <class Holds>
  void exactly(const Obligation& top, const Reader& c, const Holds& holds) const {
    c.require(!top.self, "S and P are for a pair");
    Room of_x, of_y;
    const Vertices x = vertices(top.x, of_x), y = vertices(top.y, of_y);
    const Piece& piece = pieces_[top.piece];
    std::vector<Path> paths;
    for (const Vertices& group : {x, y}) {
      for (const std::uint32_t v : group) paths.push_back(motion_.path(v, piece));
    }
    const mpz_class eta = top.distance ? motion_.eta() : mpz_class(0);
    c.require(holds(piece, eta * eta, paths, x.size()), "this does not separate the pair");
  }

  const Claim& claim_;
  const Integers& motion_;
  const Tree& tree_;
  Enclosures enclosures_;
  std::vector<Obligation> stack_;
  std::vector<Piece> pieces_;  ///< those of the obligations, by number
  std::uint64_t pieces_made_ = 0;
};

}  // namespace noli::checker
