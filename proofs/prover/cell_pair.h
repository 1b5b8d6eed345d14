// SPDX-License-Identifier: Apache-2.0
//
// The end of the verifier's recursion: two cells that no box has separated, or one cell by itself.
//
// Notation
//   shared   a vertex that both cells have. No direction separates cells that share one; but two simplices on them that
//            share none miss each shared vertex on one side at least, so it is enough to settle all *parts* that arise
//            by dropping each shared vertex from one side or the other: (bc, ade) and (abc, de) for abc and ade; (c,
//            abd), (bc, ad), (ac, bd), (abc, d) for abc and abd
//   open     a pair of parts for which no direction was found, over the whole step or over pieces of it
//
// The features of an open pair are taken to the kernel one by one, and whether it meets at the beginning of the step is
// decided by a direction at that time or by the exact static predicate.
//
// What this does not do: it never looks at cells other than the two.
#pragma once

#include "noli/proofs/prover/around.h"
#include "noli/proofs/prover/direction_search.h"
#include "noli/proofs/prover/feature_pairs.h"
#include "noli/proofs/prover/initial.h"
#include "noli/proofs/prover/step_record.h"
#include "noli/proofs/prover/tally.h"

namespace noli {

/// What to look for, beside the pairs of features of different cells.
struct CellOptions {
  bool initial = true;  ///< as in VerifyOptions
  bool strict = false;
};

template <int Dim>
class CellPairs {
 public:
  using Cell = MovingCell<Dim>;

  CellPairs(CellOptions options, Tally& tally, StepRecord& record)
      : options_(options), tally_(tally), record_(record) {}

  /// Settles the obligation about two different cells.
  void settle(const Cell& a, const Cell& b) {
    Progress progress{a, b, pairs_owned(a, b)};
    if (!share_vertex(a, b)) {
      settle_part(progress, pair_of(a, b), {all_corners(a.corners), all_corners(b.corners)});
    } else {
      settle_neighbours(progress, find_shared(a, b));
    }
    if (!progress.open) return;
    ++tally_.cell_pairs;
    if (progress.meets_at_begin) tally_.add_initial(a.cell, b.cell);
  }

  /// Settles the obligation about the features of one cell.
  void settle_self(const Cell& c) {
    if (c.corners == 3) {
      for (unsigned i = 0; i < 3; ++i) settle_opposite(c, i);
    } else if (options_.strict && c.corners == 2 && (c.owned & cell_bit) != 0 && c.vertices[0] != c.vertices[1]) {
      examine({FeaturePair::vertex_vertex, &c, corner_feature(0), &c, corner_feature(1)});
    }
    record_.cell();
  }

 private:
  struct Parts {
    CornerMask a, b;
  };

  /// The shared vertices: where in a and where in b the i-th of them is.
  struct Shared {
    std::array<CornerMask, 3> in_a{}, in_b{};
    std::size_t count = 0;
  };

  struct Progress {
    const Cell& a;
    const Cell& b;
    PairSet left;  ///< pairs of features which belong here and have not been settled
    bool open = false;
    bool meets_at_begin = false;
  };

  /// Rounds of the search for a direction, and how often the step is halved for it: what paid on simulated cloth and
  /// solids.
  static constexpr int search_rounds = 10;
  static constexpr int halvings = 1;

  static CornerMask corners_at(const Cell& c, VertexId v) {
    const int mask = (c.vertices[0] == v ? 1 : 0) | (c.vertices[1] == v ? 2 : 0) | (c.vertices[2] == v ? 4 : 0);
    return static_cast<CornerMask>(mask & all_corners(c.corners));
  }

  static bool share_vertex(const Cell& a, const Cell& b) {
    int same = 0;  // added up, not branched on
    for (const VertexId v : a.vertices) {
      for (const VertexId w : b.vertices) same += v == w ? 1 : 0;
    }
    return same != 0;
  }

  static Shared find_shared(const Cell& a, const Cell& b) {
    Shared shared;
    for (std::size_t i = 0; i < a.corners; ++i) {
      const CornerMask in_b = corners_at(b, a.vertices[i]);
      if (in_b == 0) continue;
      const CornerMask in_a = corners_at(a, a.vertices[i]);
      if ((in_a & ((1U << i) - 1)) != 0) continue;  // the same vertex again
      shared.in_a[shared.count] = in_a;
      shared.in_b[shared.count++] = in_b;
    }
    return shared;
  }

  /// From the middle of the second part to the middle of the first, at mid-time, four times as long.
  static Direction<Dim> between_middles(const PartPair<Dim>& pair) {
    Direction<Dim> n;
    for (std::size_t k = 0; k < Dim; ++k) {
      const auto &p = pair.d[0][k], &q = pair.d[1][k];
      n[k] = ((p[0] + q[0]) + (p[1] + q[1]) + (p[2] + q[2])) - ((p[4] + q[4]) + (p[5] + q[5]) + (p[6] + q[6]));
    }
    return n;
  }

  void close(const Direction<Dim>& n, double sign) {
    ++tally_.obligations;
    if (!record_.on()) return;
    std::array<double, 3> signed_n{};
    for (std::size_t k = 0; k < Dim; ++k) signed_n[k] = sign * n[k];
    record_.direction(signed_n);
  }

  static std::size_t place(CornerMask mask) { return static_cast<std::size_t>(std::countr_zero(mask)); }

  static bool is_single(CornerMask mask) { return (mask & (mask - 1)) == 0; }

  /// Two faces that have one vertex in common, each of them once.
  static bool is_fan(const Cell& a, const Cell& b, const Shared& shared) {
    return shared.count == 1 && a.corners == 3 && b.corners == 3 && is_single(shared.in_a[0]) &&
           is_single(shared.in_b[0]);
  }

  /// Two faces that have two vertices in common, each of them once.
  static bool is_hinge(const Cell& a, const Cell& b, const Shared& shared) {
    return shared.count == 2 && a.corners == 3 && b.corners == 3 && is_single(shared.in_a[0]) &&
           is_single(shared.in_a[1]) && is_single(shared.in_b[0]) && is_single(shared.in_b[1]);
  }

  void settle_neighbours(Progress& progress, const Shared& shared) {
    if (is_fan(progress.a, progress.b, shared)) {
      settle_around_corner(progress, shared);
    } else if (is_hinge(progress.a, progress.b, shared)) {
      settle_around_edge(progress, shared);
    } else {
      settle_parts(progress, shared);
    }
  }

  void settle_around_corner(Progress& progress, const Shared& shared) {
    const Cell &a = progress.a, &b = progress.b;
    const std::size_t i = place(shared.in_a[0]), j = place(shared.in_b[0]);
    const auto four =
        four_around(a, b, i, {{{false, next(i)}, {false, next(next(i))}, {true, next(j)}, {true, next(next(j))}}});
    const auto n = around_corner(four);
    if (!n) return settle_parts(progress, shared);
    record_.drop_vertex(a.vertices[i]);
    close(*n, 1);
    close(*n, 1);
  }

  void settle_around_edge(Progress& progress, const Shared& shared) {
    const Cell &a = progress.a, &b = progress.b;
    const std::size_t i = place(shared.in_a[0]), j = place(shared.in_a[1]);
    const std::size_t c = 3 - i - j, d = 3 - place(shared.in_b[0]) - place(shared.in_b[1]);
    const auto known = around_edge(four_around(a, b, i, {{{false, j}, {false, c}, {true, d}, {true, d}}}));
    settle_parts(progress, shared, &known);
  }

  static std::size_t next(std::size_t corner) { return corner == 2 ? 0 : corner + 1; }

  void settle_parts(Progress& progress, const Shared& shared, const AroundEdge<Dim>* known = nullptr) {
    std::size_t number = 0;
    drop_shared(progress, {all_corners(progress.a.corners), all_corners(progress.b.corners)}, shared, 0, known, number);
  }

  /// Goes through the pairs of parts in prefix order and numbers them.
  void drop_shared(Progress& progress, Parts parts, const Shared& shared, std::size_t from,
                   const AroundEdge<Dim>* known, std::size_t& number) {
    if (from < shared.count) {
      const CornerMask in_a = shared.in_a[from], in_b = shared.in_b[from];
      record_.drop_vertex(progress.a.vertices[place(in_a)]);
      const Parts without_a = {static_cast<CornerMask>(parts.a & ~in_a), parts.b};
      const Parts without_b = {parts.a, static_cast<CornerMask>(parts.b & ~in_b)};
      drop_shared(progress, without_a, shared, from + 1, known, number);
      drop_shared(progress, without_b, shared, from + 1, known, number);
      return;
    }
    const std::size_t i = number++;
    if (parts.a == 0 || parts.b == 0) {
      record_.empty();
    } else if (known != nullptr && known->found[i]) {
      close(known->n[i], 1);
      progress.left &= ~pairs_within(progress.a, parts.a, progress.b, parts.b);
    } else {
      settle_part(progress, pair_of(progress.a, parts.a, progress.b, parts.b, place(parts.a)), parts);
    }
  }

  void settle_part(Progress& progress, const PartPair<Dim>& pair, Parts parts) {
    const Cell &a = progress.a, &b = progress.b;
    const Direction<Dim> guess = between_middles(pair);
    const PairSet within = pairs_within(a, parts.a, b, parts.b);
    const bool closed = try_direction(pair, guess) || try_normals(pair, a, b) || search(pair, guess, {}, 0);
    const bool apart_at_begin = closed || find_direction(pair, guess, {0, 0}, search_rounds).has_value();
    if (closed || (apart_at_begin && search_halves(pair, guess, {}, halvings))) {
      progress.left &= ~within;
      return;
    }
    progress.open = true;
    for (PairSet todo = progress.left & within; todo != 0; todo &= todo - 1) examine(first_of(todo, a, b));
    progress.left &= ~within;
    if (options_.initial && !progress.meets_at_begin) {
      progress.meets_at_begin = !apart_at_begin && meet_at_begin(a, parts.a, b, parts.b);
      record_.at_begin(progress.meets_at_begin);
    }
    record_.features();
  }

  bool try_direction(const PartPair<Dim>& pair, const Direction<Dim>& n) {
    const int sign = separates(pair, n);
    if (sign != 0) close(n, sign);
    return sign != 0;
  }

  bool try_normals(const PartPair<Dim>& pair, const Cell& a, const Cell& b) {
    if constexpr (Dim == 2) return false;
    return (a.corners == 3 && try_direction(pair, a.normal)) || (b.corners == 3 && try_direction(pair, b.normal));
  }

  /// Looks for a direction over the interval, else over its halves.
  bool search(const PartPair<Dim>& pair, const Direction<Dim>& guess, Interval interval, int depth) {
    if (const auto n = find_direction(pair, guess, interval, search_rounds)) {
      close(*n, 1);
      return true;
    }
    return depth > 0 && search_halves(pair, guess, interval, depth);
  }

  bool search_halves(const PartPair<Dim>& pair, const Direction<Dim>& guess, Interval interval, int depth) {
    const std::size_t recorded = record_.size();
    const std::uint64_t obligations = tally_.obligations;
    record_.halve();
    if (search(pair, guess, {interval.begin, interval.middle()}, depth - 1) &&
        search(pair, guess, {interval.middle(), interval.end}, depth - 1)) {
      return true;
    }
    record_.truncate(recorded);
    tally_.obligations = obligations;
    return false;
  }

  /// A corner of a face against the edge opposite to it: features of one cell, which count if it is asked for or (in
  /// 2D, where a pair of features may have both its owners in one cell) if they are features of two different cells as
  /// well.
  void settle_opposite(const Cell& c, unsigned corner) {
    const unsigned edge = (corner + 1) % 3;
    const FeatureMask mask = corner_bit(static_cast<int>(corner)) | edge_bit(static_cast<int>(edge));
    const bool belongs = Dim == 2 ? (c.owned & mask) == mask : (c.owned & cell_bit) != 0;
    const bool wanted = options_.strict || (Dim == 2 && (c.shared & mask) != 0);
    const VertexId v = c.vertices[corner];
    if (!belongs || !wanted || v == c.vertices[(corner + 1) % 3] || v == c.vertices[(corner + 2) % 3]) return;
    examine({FeaturePair::vertex_edge, &c, corner_feature(corner), &c, edge_feature(edge)});
  }

  void examine(const FeatureQuestion<Dim>& question) {
    const auto enclosure = ask(question, tally_.stages);
    if (enclosure) tally_.add_contact(canonical(question.pair, question.vertices(), *enclosure));
    if (record_.on()) record_.decided(question.pair, question.vertices(), enclosure.has_value());
  }

  CellOptions options_;
  Tally& tally_;
  StepRecord& record_;
};

}  // namespace noli
