// SPDX-License-Identifier: Apache-2.0
//
// The end of the verifier's recursion: settles two cells that no box has separated, or one cell by itself.
//
// Notation
//   shared   a vertex that both cells have. No direction separates cells that share one. But two of their features that
//            share no vertex miss each shared vertex on at least one side. So it is enough to settle all *parts* that
//            arise by dropping each shared vertex from one side or the other: (bc, ade) and (abc, de) for abc and ade;
//            (c, abd), (bc, ad), (ac, bd), (abc, d) for abc and abd
//   open     a pair of parts for which no direction was found, over the whole step or over pieces of it
//   positions   as in proofs/prover/traversal.h; if they stray from straight lines, directions must hold with the radii
//            added, and pieces of time are cut at breakpoints (proofs/prover/windows/pieces.h)
//
// The kernel decides the features of an open pair one by one. Whether the pair meets at the beginning of the step is
// decided by a direction at that time or by the exact static predicate. Its tokens, if it has any, are found later
// (proofs/prover/tokens/step_tokens.h).
//
// With tokens, a direction is rounded to the bits of a short token before it is tested, so the tested direction is the
// one in the token.
#pragma once

#include "proofs/prover/cells/around.h"
#include "proofs/prover/cells/baseline.h"
#include "proofs/prover/cells/direction_search.h"
#include "proofs/prover/feature_pairs.h"
#include "proofs/prover/initial.h"
#include "proofs/prover/straight.h"
#include "proofs/prover/tokens/short_direction.h"
#include "proofs/prover/tokens/step_tokens.h"

namespace noli {

/// What to look for, besides pairs of features of different cells.
struct CellOptions {
  bool initial = true;      ///< as in VerifyOptions
  bool after_step = false;  ///< as in VerifyOptions
  bool strict = false;
  const Baseline* baseline = nullptr;  ///< as in VerifyOptions
};

/// `Positions`: Straight or Chords. `Out`: Tokens, or NoTokens.
template <class Positions, class Out>
class CellPairs {
 public:
  static constexpr int Dim = Positions::dim;
  using Cell = typename Positions::Cell;
  using Moving = typename Positions::Gathered;
  using Tally = typename Positions::Tally;

  CellPairs(CellOptions options, const Positions& positions, Tally& tally, WalkTokens<Dim, Out>& out)
      : options_(options), positions_(positions), tally_(tally), tokens_(out.tokens), open_(out.open) {}

  /// Settles the obligation about two different cells.
  void settle(const Cell& a, const Cell& b) {
    const unsigned same = same_vertices(a, b);
    if (!settle_usual(a, b, same)) settle_unusual(a, b, same);
  }

  /// Whether it was stopped before the end.
  bool stopped() const { return stops && stopped_; }

  /// Settles the obligation about the features of one cell.
  void settle_self(const Cell& c) {
    if constexpr (stops) return write_self(c);
    if (c.corners == 3) {
      for (unsigned i = 0; i < 3; ++i) settle_opposite(c, i);
    } else if (options_.strict && c.corners == 2 && (c.owned & cell_bit) != 0 && c.vertices[0] != c.vertices[1] &&
               !positions_.leftovers().place_of(vertex_vertex_pair(c.vertices[0], c.vertices[1]))) {
      const Moving at = gather(c);
      examine({FeaturePair::vertex_vertex, &at, corner_feature(0), &at, corner_feature(1)}, positions_.begin_time());
    }
    if constexpr (Out::on) write_self(c);
  }

 private:
  /// Whether this writes tokens of a window that has already been decided.
  static constexpr bool stops = Out::on && !Positions::straight;

  struct Parts {
    CornerMask a, b;
  };

  /// The shared vertices: the corners of a and of b at which the i-th of them is.
  struct Shared {
    std::array<CornerMask, 3> in_a{}, in_b{};
    std::size_t count = 0;
  };

  struct Gathered {
    Gathered(const Cell& first, const Cell& second) : a(gather(first)), b(gather(second)) {}
    Moving a, b;
  };

  /// The first piece in which parts resist.
  struct Resistance {
    double begin;         ///< of the piece
    bool apart_at_begin;  ///< the parts are known to be apart at the beginning of the span
  };

  struct Progress {
    const Cell& a;
    const Cell& b;
    PairSet left;  ///< pairs of features that belong here and are not settled yet
    bool open = false;
    bool meets_at_begin = false;
    std::optional<Gathered> gathered = std::nullopt;  ///< a and b, once they are needed
  };

  /// How often the step is halved for a direction. Chosen by measuring simulated cloth and solids.
  static constexpr int halvings = 1;

  static CornerMask corners_at(const Cell& c, VertexId v) {
    const int mask = (c.vertices[0] == v ? 1 : 0) | (c.vertices[1] == v ? 2 : 0) | (c.vertices[2] == v ? 4 : 0);
    return static_cast<CornerMask>(mask & all_corners(c.corners));
  }

  /// Bit 3 i + j: corner i of a is the same vertex as corner j of b.
  static unsigned same_vertices(const Cell& a, const Cell& b) {
    unsigned same = 0;  // computed without branches
    for (unsigned i = 0; i < 3; ++i) {
      for (unsigned j = 0; j < 3; ++j) same |= (a.vertices[i] == b.vertices[j] ? 1U : 0U) << (3 * i + j);
    }
    return same;
  }

  static bool are_faces(const Cell& a, const Cell& b) { return a.corners == 3 && b.corners == 3; }

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

  /// Rounds a direction to the bits of a short token, if there are tokens.
  static constexpr auto rounded = [](const std::array<double, Dim>& n) __attribute__((always_inline)) {
    if constexpr (Out::on) {
      return shortened(n);
    } else {
      return n;
    }
  };

  /// Closes an obligation with a direction that was rounded.
  [[gnu::always_inline]] void close(const Direction<Dim>& n, double sign) {
    ++tally_.obligations;
    if constexpr (Out::on) put_short(n, sign, tokens_);
  }

  static std::size_t place(unsigned mask) { return static_cast<std::size_t>(std::countr_zero(mask)); }

  static bool is_single(unsigned mask) { return mask != 0 && (mask & (mask - 1)) == 0; }

  /// Whether the usual directions settle a pair.
  bool settle_usual(const Cell& a, const Cell& b, unsigned same) {
    if (same == 0) return settle_apart(a, b);
    return is_single(same) ? settle_around_corner(a, b, same) : settle_around_edge(a, b, same);
  }

  /// Two cells without a common vertex: whether one of the usual directions separates them.
  bool settle_apart(const Cell& a, const Cell& b) {
    const auto points = points_around<Dim, 2, 3>(a, b, 0, {1, 2}, {0, 1, 2});
    if (try_direction(points, noli::between_middles(points))) return true;
    if constexpr (Dim == 3) {
      if (a.corners == 3 && try_direction(points, mid_normal(a.x(0), a.x(1), a.x(2)))) return true;
      if (b.corners == 3 && try_direction(points, mid_normal(b.x(0), b.x(1), b.x(2)))) return true;
    }
    return false;
  }

  /// Two faces with one vertex in common, which each has once: whether a usual direction settles them.
  bool settle_around_corner(const Cell& a, const Cell& b, unsigned same) {
    if (!are_faces(a, b)) return false;
    const std::size_t i = place(same) / 3, j = place(same) % 3;
    const auto n = around_corner<Dim>(
        points_around<Dim, 2, 2>(a, b, i, {next(i), next(next(i))}, {next(j), next(next(j))}), rounded);
    if (!n) return false;
    tokens_.drop(0);
    close(*n, 1);
    close(*n, 1);
    return true;
  }

  /// Two faces with two vertices in common, which each has once.
  struct Hinge {
    std::size_t a, b, c;  ///< in the first face: the common ones, the other
    std::size_t d;        ///< in the second face: the other one
  };

  static std::optional<Hinge> hinge_of(const Cell& a, const Cell& b, unsigned same) {
    const unsigned rest = same & (same - 1);
    if (!is_single(rest) || !are_faces(a, b)) return std::nullopt;
    const std::size_t p = place(same), q = place(rest);
    if (p / 3 == q / 3 || p % 3 == q % 3) return std::nullopt;
    return Hinge{p / 3, q / 3, 3 - p / 3 - q / 3, 3 - p % 3 - q % 3};
  }

  static AroundEdge<Dim> around_hinge(const Cell& a, const Cell& b, const Hinge& hinge) {
    return around_edge<Dim>(points_around<Dim, 2, 1>(a, b, hinge.a, {hinge.b, hinge.c}, {hinge.d}), rounded);
  }

  /// Whether the usual directions settle a hinge.
  bool settle_around_edge(const Cell& a, const Cell& b, unsigned same) {
    const auto hinge = hinge_of(a, b, same);
    if (!hinge) return false;
    const AroundEdge<Dim> around = around_hinge(a, b, *hinge);
    const auto& found = around.found;
    if (!(found[0] && found[1] && found[2] && found[3])) return false;
    tokens_.drop(a.vertices[hinge->a] < a.vertices[hinge->b] ? 0 : 1);
    tokens_.drop(0);
    close(around.n[0], 1);
    close(around.n[1], 1);
    tokens_.drop(0);
    close(around.n[2], 1);
    close(around.n[3], 1);
    return true;
  }

  [[gnu::noinline]] void settle_unusual(const Cell& a, const Cell& b, unsigned same) {
    Progress progress{a, b, pairs_owned<Dim>(a, b)};
    if (needless(progress.left)) return;
    if (same == 0) {
      settle_part(progress, {all_corners(a.corners), all_corners(b.corners)}, true);
    } else {
      const auto hinge = hinge_of(a, b, same);
      settle_parts(progress, find_shared(a, b), hinge ? around_hinge(a, b, *hinge) : AroundEdge<Dim>{});
    }
    if (!progress.open) return;
    ++tally_.cell_pairs;
    if (!progress.meets_at_begin || (options_.baseline != nullptr && options_.baseline->has(a.cell, b.cell))) return;
    tally_.add_initial(a.cell, b.cell);
  }

  /// Whether parts need not be settled if these are their unsettled pairs of features.
  bool needless(PairSet wanted) const { return !Positions::straight && !Out::on && wanted == 0 && !options_.initial; }

  /// Writes the tokens about the features of one cell.
  void write_self(const Cell& c) {
    if (!options_.strict) return tokens_.one();
    tokens_.both();
    Progress progress{c, c, 0};
    const std::uint64_t obligations = tally_.obligations;
    settle_parts(progress, find_shared(c, c), {});
    tally_.obligations = obligations;  // the kernel decides these pairs, with or without tokens
  }

  /// The rank of shared vertex `from` among shared vertices `from`, `from` + 1, ..., by vertex.
  static std::size_t rank(const Cell& a, const Shared& shared, std::size_t from) {
    const VertexId v = a.vertices[place(shared.in_a[from])];
    std::size_t smaller = 0;
    for (std::size_t i = from + 1; i < shared.count; ++i) smaller += a.vertices[place(shared.in_a[i])] < v ? 1 : 0;
    return smaller;
  }

  static std::size_t next(std::size_t corner) { return corner == 2 ? 0 : corner + 1; }

  void settle_parts(Progress& progress, const Shared& shared, const AroundEdge<Dim>& known) {
    std::size_t number = 0;
    drop_shared(progress, {all_corners(progress.a.corners), all_corners(progress.b.corners)}, shared, 0, known, number);
  }

  /// Visits the pairs of parts in prefix order and numbers them.
  void drop_shared(Progress& progress, Parts parts, const Shared& shared, std::size_t from,
                   const AroundEdge<Dim>& known, std::size_t& number) {
    if (from < shared.count) {
      const CornerMask in_a = shared.in_a[from], in_b = shared.in_b[from];
      tokens_.drop(rank(progress.a, shared, from));
      const Parts without_a = {static_cast<CornerMask>(parts.a & ~in_a), parts.b};
      const Parts without_b = {parts.a, static_cast<CornerMask>(parts.b & ~in_b)};
      drop_shared(progress, without_a, shared, from + 1, known, number);
      drop_shared(progress, without_b, shared, from + 1, known, number);
      return;
    }
    const std::size_t i = number++;
    if (parts.a == 0 || parts.b == 0) {
      tokens_.empty();
    } else if (i < known.found.size() && known.found[i]) {
      close(known.n[i], 1);
      progress.left &= ~pairs_within<Dim>(progress.a, parts.a, progress.b, parts.b);
    } else {
      settle_part(progress, parts, false);
    }
  }

  /// `tried`: the usual directions have already failed.
  void settle_part(Progress& progress, Parts parts, bool tried) {
    const PairSet within = pairs_within<Dim>(progress.a, parts.a, progress.b, parts.b);
    if (needless(progress.left & within)) return;
    if (!progress.gathered) progress.gathered.emplace(progress.a, progress.b);
    const auto& [a, b] = *progress.gathered;
    const PartPair<Dim> pair = pair_of(a, parts.a, b, parts.b, place(parts.a));
    const Direction<Dim> guess = between_middles(pair);
    const bool usual = !tried && (try_direction(pair, guess) || try_normals(pair, a, b));
    const auto resistance =
        usual || search(pair, guess, {}, 0) ? std::nullopt : resist(pair, guess, *progress.gathered, parts);
    const PairSet left = progress.left & within;
    progress.left &= ~within;
    if constexpr (!stops) {
      if (resistance) open(progress, parts, left, *resistance);
    }
  }

  /// Decides the unsettled pairs of features of parts that resist, one by one.
  void open(Progress& progress, Parts parts, PairSet left, Resistance resistance) {
    const auto& [a, b] = *progress.gathered;
    progress.open = true;
    for (PairSet todo = left; todo != 0; todo &= todo - 1) {
      if (counted_here(todo, a, b, positions_.leftovers())) examine(first_of(todo, a, b), resistance.begin);
    }
    if constexpr (Out::on) {
      if (!tally_.something_meets()) open_.push_back({tokens_.place(), &progress.a, &progress.b, parts.a, parts.b});
    }
    if (&progress.a == &progress.b || !options_.initial || progress.meets_at_begin) return;
    progress.meets_at_begin = !resistance.apart_at_begin &&
                              meet_at_begin<Dim>(positions_.at_begin(a), parts.a, positions_.at_begin(b), parts.b);
  }

  /// For parts that no direction separates throughout: settles them over pieces of time, or says where they resist.
  std::optional<Resistance> resist(const PartPair<Dim>& pair, const Direction<Dim>& guess, const Gathered& cells,
                                   Parts parts) {
    if constexpr (Positions::straight) {
      const bool apart_at_begin = find_direction(pair, guess, {0, 0}, search_rounds).has_value();
      if (apart_at_begin && search_halves(pair, guess, {}, halvings)) return std::nullopt;
      return Resistance{positions_.begin_time(), apart_at_begin};
    } else if constexpr (Out::on) {
      if (!positions_.prove_apart(cells.a, parts.a, cells.b, parts.b, tokens_)) stopped_ = true;
      return std::nullopt;
    } else {
      const auto begin = positions_.resisting(cells.a, parts.a, cells.b, parts.b, tally_);
      if (!begin) return std::nullopt;
      return Resistance{*begin, *begin != positions_.begin_time()};
    }
  }

  template <class Points>
  bool try_direction(const Points& pair, const Direction<Dim>& full) {
    const Direction<Dim> n = rounded(full);
    const int sign = separates(pair, n);
    if (sign != 0) close(n, sign);
    return sign != 0;
  }

  bool try_normals(const PartPair<Dim>& pair, const MovingCell<Dim>& a, const MovingCell<Dim>& b) {
    if constexpr (Dim == 2) return false;
    return (a.corners == 3 && try_direction(pair, a.normal)) || (b.corners == 3 && try_direction(pair, b.normal));
  }

  /// Looks for a direction over the interval, or for directions over its halves.
  bool search(const PartPair<Dim>& pair, const Direction<Dim>& guess, Interval interval, int depth) {
    if (const auto n = find_direction(pair, guess, interval, search_rounds)) {
      ++tally_.obligations;
      if constexpr (Out::on) {
        put_direction(
            *n, [&](const Direction<Dim>& m) { return separates<Dim>(pair, m, interval) > 0; }, tokens_);
      }
      return true;
    }
    return depth > 0 && search_halves(pair, guess, interval, depth);
  }

  bool search_halves(const PartPair<Dim>& pair, const Direction<Dim>& guess, Interval interval, int depth) {
    const std::size_t written = tokens_.place();
    const std::uint64_t obligations = tally_.obligations;
    tokens_.halve();
    if (search(pair, guess, {interval.begin, interval.middle()}, depth - 1) &&
        search(pair, guess, {interval.middle(), interval.end}, depth - 1)) {
      return true;
    }
    tokens_.truncate(written);
    tally_.obligations = obligations;
    return false;
  }

  /// Settles a corner of a face against the opposite edge. These features of one cell count with `strict`. In 2D they
  /// also count if they are features of two different cells too: both owners of a pair may then be this cell.
  void settle_opposite(const Cell& c, unsigned corner) {
    const unsigned edge = (corner + 1) % 3;
    const FeatureMask mask = corner_bit(static_cast<int>(corner)) | edge_bit(static_cast<int>(edge));
    const bool belongs = Dim == 2 ? (c.owned & mask) == mask : (c.owned & cell_bit) != 0;
    const bool wanted = options_.strict || (Dim == 2 && (c.shared & mask) != 0);
    const VertexId v = c.vertices[corner];
    if (!belongs || !wanted || v == c.vertices[(corner + 1) % 3] || v == c.vertices[(corner + 2) % 3]) return;
    if (Dim == 3 && positions_.leftovers().place_of(vertex_edge_pair(v, shape_of(c).edge(edge)))) return;
    const Moving at = gather(c);
    examine({FeaturePair::vertex_edge, &at, corner_feature(corner), &at, edge_feature(edge)}, positions_.begin_time());
  }

  /// Whether a pair of features that meets is not compared.
  bool is_known(const FeatureQuestion<Dim>& question) const {
    if (options_.baseline == nullptr) return false;
    const auto v = question.vertices();
    const std::span<const VertexId> first(v.data(), question.first.size);
    return options_.baseline->covers(first, {v.data() + first.size(), question.second.size}, options_.strict);
  }

  void examine(const FeatureQuestion<Dim>& question, double begin) {
    const auto enclosure = positions_.meet(question, begin, tally_);
    if (!enclosure || is_known(question)) return;
    if (options_.after_step && enclosure->begin <= positions_.begin_time() && met_before(question)) {
      ++tally_.going_on;
    } else {
      tally_.add_contact(canonical(question.pair, question.vertices(), *enclosure));
    }
  }

  /// Whether features meet at the beginning of the step.
  bool met_before(FeatureQuestion<Dim> question) const {
    const Moving& a = positions_.at_begin(static_cast<const Moving&>(*question.first_cell));
    const Moving& b = positions_.at_begin(static_cast<const Moving&>(*question.second_cell));
    question.first_cell = &a;
    question.second_cell = &b;
    return meet_at_begin(question);
  }

  CellOptions options_;
  const Positions& positions_;
  Tally& tally_;
  Out& tokens_;
  std::vector<OpenParts<Dim>>& open_;
  bool stopped_ = false;
};

}  // namespace noli
