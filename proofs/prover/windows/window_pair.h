// SPDX-License-Identifier: Apache-2.0
//
// The end of the recursion over groups in a span of a window: two cells that no box has separated, or one cell by
// itself.
//
// Notation
//   parts    as in proofs/prover/cell_pair.h: what is left of two cells when each shared vertex is dropped from one
//   piece    a time [begin, end]; it is cut at breakpoints of the vertices in question only
//   resists  no direction was found for two parts over a piece that has no breakpoint inside
//
// Two parts are settled by one direction over the span, or over the pieces into which it is cut. Where a piece resists,
// each pair of features of the parts is settled in the same way over what is left of the span, and is decided exactly
// over the pieces in which it resists; it counts once, in the first piece in which it meets.
//
// What this does not do: it never looks at cells other than the two.
#pragma once

#include "proofs/prover/cells/around.h"
#include "proofs/prover/cells/direction_search.h"
#include "proofs/prover/feature_pairs.h"
#include "proofs/prover/initial.h"
#include "proofs/prover/tally.h"
#include "proofs/prover/windows/window_cell.h"
#include "proofs/prover/windows/window_earliest.h"
#include "proofs/prover/windows/window_features.h"

namespace noli {

/// What one task of the verification of a window has found.
using WindowTally = TallyWith<WindowEarliest>;

template <int Dim>
class WindowPairs {
 public:
  using Cell = WindowCell<Dim>;

  WindowPairs(const WorldLines& lines, const Leftovers& leftovers, Span span, const WindowOptions& options,
              WindowTally& tally)
      : lines_(lines),
        leftovers_(leftovers),
        span_(span),
        initial_(options.initial && span.begin == lines.first_time()),
        strict_(options.strict),
        tally_(tally) {}

  /// Settles the obligation about two different cells.
  void settle(const Cell& a, const Cell& b) {
    Progress progress{a, b, pairs_owned(a, b)};
    if (progress.left == 0 && !initial_) return;
    const Shared shared = find_shared(a, b);
    if (shared.count == 0) {
      settle_parts(progress, {all_corners(a.corners), all_corners(b.corners)});
    } else {
      settle_neighbours(progress, shared);
    }
    if (!progress.open) return;
    ++tally_.cell_pairs;
    if (progress.meets_at_begin) tally_.add_initial(a.cell, b.cell);
  }

  /// Settles the obligation about the features of one cell.
  void settle_self(const Cell& c) {
    if (c.corners == 3) {
      for (unsigned i = 0; i < 3; ++i) settle_opposite(c, i);
    } else if (strict_ && c.corners == 2 && (c.owned & cell_bit) != 0 && c.vertices[0] != c.vertices[1] &&
               !leftovers_.place_of(vertex_vertex_pair(c.vertices[0], c.vertices[1]))) {
      examine({FeaturePair::vertex_vertex, &c, corner_feature(0), &c, corner_feature(1)}, span_.begin);
    }
  }

 private:
  struct Parts {
    CornerMask a, b;
  };

  struct Progress {
    const Cell& a;
    const Cell& b;
    PairSet left;  ///< pairs of features which belong here and have not been settled
    bool open = false;
    bool meets_at_begin = false;
  };

  static constexpr int search_rounds = 10;

  /// The vertices that both cells have: where they are in a and in b.
  struct Shared {
    std::array<CornerMask, 3> in_a{}, in_b{};
    std::size_t count = 0;
    bool once = true;  ///< each of them only once in either cell
  };

  static unsigned corners_at(const Cell& c, VertexId v) {
    const unsigned mask = (c.vertices[0] == v ? 1U : 0) | (c.vertices[1] == v ? 2U : 0) | (c.vertices[2] == v ? 4U : 0);
    return mask & all_corners(c.corners);
  }

  static bool is_single(unsigned mask) { return (mask & (mask - 1)) == 0; }
  static std::size_t place(unsigned mask) { return static_cast<std::size_t>(std::countr_zero(mask)); }
  static std::size_t next(std::size_t corner) { return corner == 2 ? 0 : corner + 1; }

  static Shared find_shared(const Cell& a, const Cell& b) {
    const std::array<unsigned, 3> in_b = {corners_at(b, a.vertices[0]), corners_at(b, a.vertices[1]),
                                          corners_at(b, a.vertices[2])};
    Shared shared;
    if ((in_b[0] | in_b[1] | in_b[2]) == 0) return shared;
    for (std::size_t i = 0; i < a.corners; ++i) {
      const unsigned in_a = corners_at(a, a.vertices[i]);
      if (in_b[i] == 0 || place(in_a) != i) continue;  // not shared, or the same vertex again
      shared.once = shared.once && is_single(in_a) && is_single(in_b[i]);
      shared.in_a[shared.count] = static_cast<CornerMask>(in_a);
      shared.in_b[shared.count++] = static_cast<CornerMask>(in_b[i]);
    }
    return shared;
  }

  /// Two faces around a corner or an edge, the usual ones in few operations.
  void settle_neighbours(Progress& progress, const Shared& shared) {
    const bool usual = shared.once && progress.a.corners == 3 && progress.b.corners == 3;
    if (usual && shared.count == 1 && around_shared_corner(progress, shared)) {
      tally_.obligations += 2;
      return;
    }
    AroundEdge<Dim> known;
    if (usual && shared.count == 2) known = around_shared_edge(progress, shared);
    std::size_t number = 0;
    drop_shared(progress, {all_corners(progress.a.corners), all_corners(progress.b.corners)}, shared, 0, known, number);
  }

  FourAround<Dim> four_of(const Progress& progress, std::size_t origin, const std::array<CornerOf, 4>& points) const {
    auto four = four_around<Dim>(progress.a, progress.b, origin, points);
    four.reach = raised(four.reach, margin_of(progress.a, progress.b));
    return four;
  }

  bool around_shared_corner(const Progress& progress, const Shared& shared) const {
    const std::size_t i = place(shared.in_a[0]), j = place(shared.in_b[0]);
    const auto four =
        four_of(progress, i, {{{false, next(i)}, {false, next(next(i))}, {true, next(j)}, {true, next(next(j))}}});
    return around_corner(four).has_value();
  }

  AroundEdge<Dim> around_shared_edge(const Progress& progress, const Shared& shared) const {
    const std::size_t i = place(shared.in_a[0]), j = place(shared.in_a[1]), c = 3 - i - j;
    const std::size_t d = 3 - place(shared.in_b[0]) - place(shared.in_b[1]);
    return around_edge(four_of(progress, i, {{{false, j}, {false, c}, {true, d}, {true, d}}}));
  }

  /// Goes through the pairs of parts that arise by dropping each shared vertex from one or the other, in the order of
  /// AroundEdge.
  void drop_shared(Progress& progress, Parts parts, const Shared& shared, std::size_t from,
                   const AroundEdge<Dim>& known, std::size_t& number) {
    if (from < shared.count) {
      const Parts without_a = {static_cast<CornerMask>(parts.a & ~shared.in_a[from]), parts.b};
      const Parts without_b = {parts.a, static_cast<CornerMask>(parts.b & ~shared.in_b[from])};
      drop_shared(progress, without_a, shared, from + 1, known, number);
      drop_shared(progress, without_b, shared, from + 1, known, number);
      return;
    }
    const std::size_t i = number++;
    if (i < known.found.size() && known.found[i]) {
      ++tally_.obligations;
      progress.left &= ~pairs_within(progress.a, parts.a, progress.b, parts.b);
    } else if (parts.a != 0 && parts.b != 0) {
      settle_parts(progress, parts);
    }
  }

  void settle_parts(Progress& progress, Parts parts) {
    const Cell &a = progress.a, &b = progress.b;
    const PairSet within = pairs_within(a, parts.a, b, parts.b);
    if ((progress.left & within) == 0 && !initial_) return;
    std::optional<double> resisting;
    const bool closed = apart(a, parts.a, b, parts.b) || settle_over(a, parts.a, b, parts.b, span_.begin, span_.end,
                                                                     [&](const Cell&, const Cell&, double at, double) {
                                                                       resisting = at;
                                                                       return false;
                                                                     });
    if (!closed) open(progress, parts, within, *resisting);
    progress.left &= ~within;
  }

  void open(Progress& progress, Parts parts, PairSet within, double begin) {
    const Cell &a = progress.a, &b = progress.b;
    progress.open = true;
    for (PairSet todo = progress.left & within; todo != 0; todo &= todo - 1) {
      if (counted_here(todo, a, b, leftovers_)) examine(first_of(todo, a, b), begin);
    }
    if (initial_ && !progress.meets_at_begin && begin == span_.begin) {
      progress.meets_at_begin = meet_at_begin<Dim>(at_begin(a), parts.a, at_begin(b), parts.b);
    }
  }

  /// The cell with its exact positions at T0.
  Cell at_begin(const Cell& cell) const {
    Cell c = cell;
    for (std::size_t i = 0; i < 4; ++i) {
      const Position& x = lines_.positions(c.vertices[std::min<std::size_t>(i, 2)]).front();
      for (std::size_t k = 0; k < Dim; ++k) c.x[0][k][i] = x[k];
    }
    return c;
  }

  /// Whether a direction was found that separates the parts, with the radii of their cells.
  bool apart(const Cell& a, CornerMask a_part, const Cell& b, CornerMask b_part) {
    PartPair<Dim> pair = pair_of(a, a_part, b, b_part, place(a_part));
    pair.reach = raised(pair.reach, margin_of(a, b));
    const Direction<Dim> guess = between_middles(pair);
    if (separates(pair, guess) != 0 || normal_separates(pair, a, a_part) || normal_separates(pair, b, b_part) ||
        find_direction(pair, guess, {}, search_rounds)) {
      ++tally_.obligations;
      return true;
    }
    return false;
  }

  static bool normal_separates(const PartPair<Dim>& pair, const Cell& c, CornerMask part) {
    if constexpr (Dim == 3) return part == all_corners(3) && separates(pair, detail::mid_normal(c)) != 0;
    return false;
  }

  /// Settles two parts over [begin, end] by directions; calls resist(a, b, begin, end), with the chords of the piece,
  /// on pieces that resist, in order, until one returns false, and returns whether none did.
  template <class Resist>
  bool settle_over(const Cell& a, CornerMask a_part, const Cell& b, CornerMask b_part, double begin, double end,
                   const Resist& resist) {
    const std::optional<double> cut = time_to_cut(a, a_part, b, b_part, begin, end);
    if (cut) {
      return settle_piece(a, a_part, b, b_part, begin, *cut, resist) &&
             settle_piece(a, a_part, b, b_part, *cut, end, resist);
    }
    return resist(a, b, begin, end);
  }

  template <class Resist>
  bool settle_piece(const Cell& a, CornerMask a_part, const Cell& b, CornerMask b_part, double begin, double end,
                    const Resist& resist) {
    const Cell a_now = over(a, a_part, lines_, begin, end), b_now = over(b, b_part, lines_, begin, end);
    return apart(a_now, a_part, b_now, b_part) || settle_over(a_now, a_part, b_now, b_part, begin, end, resist);
  }

  /// The median of the breakpoints inside of the vertex that has most; nothing if none has any.
  std::optional<double> time_to_cut(const Cell& a, CornerMask a_part, const Cell& b, CornerMask b_part, double begin,
                                    double end) const {
    std::size_t most = 0;
    std::optional<double> cut;
    const auto look = [&](const Cell& c, CornerMask part) {
      for (std::size_t i = 0; i < 3; ++i) {
        if ((part >> i & 1) == 0) continue;
        const WorldLine line(lines_, c.vertices[i]);
        const std::size_t first = line.segment_after(begin), last = line.segment_before(end);
        if (last <= first || last - first <= most) continue;
        most = last - first;
        cut = line.t[first + 1 + (most - 1) / 2];
      }
    };
    look(a, a_part);
    look(b, b_part);
    return cut;
  }

  /// A corner of a face against the edge opposite to it (proofs/prover/cell_pair.h).
  void settle_opposite(const Cell& c, unsigned corner) {
    const unsigned edge = (corner + 1) % 3;
    const FeatureMask mask = corner_bit(static_cast<int>(corner)) | edge_bit(static_cast<int>(edge));
    const bool belongs = Dim == 2 ? (c.owned & mask) == mask : (c.owned & cell_bit) != 0;
    const bool wanted = strict_ || (Dim == 2 && (c.shared & mask) != 0);
    const VertexId v = c.vertices[corner];
    if (!belongs || !wanted || v == c.vertices[(corner + 1) % 3] || v == c.vertices[(corner + 2) % 3]) return;
    if (Dim == 3 && leftovers_.place_of(vertex_edge_pair(v, shape_of(c).edge(edge)))) return;
    const FeatureQuestion<Dim> question{FeaturePair::vertex_edge, &c, corner_feature(corner), &c, edge_feature(edge)};
    if (!apart(c, part_of(question.first), c, part_of(question.second))) examine(question, span_.begin);
  }

  static CornerMask part_of(const Feature& feature) {
    CornerMask part = 0;
    for (std::size_t i = 0; i < feature.size; ++i) part |= static_cast<CornerMask>(1 << feature.corners[i]);
    return part;
  }

  /// Settles a pair of features over the span from `begin` on.
  void examine(const FeatureQuestion<Dim>& question, double begin) {
    const auto& a = static_cast<const Cell&>(*question.first_cell);
    const auto& b = static_cast<const Cell&>(*question.second_cell);
    std::optional<TimeEnclosure> first;
    settle_piece(a, part_of(question.first), b, part_of(question.second), begin, span_.end,
                 [&](const Cell& a_now, const Cell& b_now, double from, double to) {
                   first = ask_piece({question.pair, &a_now, question.first, &b_now, question.second}, from, to);
                   return !first;
                 });
    if (first) tally_.add_contact(canonical(question.pair, question.vertices(), *first));
  }

  static bool exact(const Cell& c) {
    return std::all_of(c.radius.begin(), c.radius.end(), [](double r) { return r == 0; });
  }

  /// Decides a pair of features, which move linearly over [begin, end] along the chords of the cells.
  std::optional<TimeEnclosure> ask_piece(const FeatureQuestion<Dim>& question, double begin, double end) {
    const bool doubles =
        exact(static_cast<const Cell&>(*question.first_cell)) && exact(static_cast<const Cell&>(*question.second_cell));
    if (doubles) {
      const auto s = ask(question, tally_.stages);
      return s ? std::optional(enclosure_in_window(*s, begin, end)) : std::nullopt;
    }
    tally_.stages.count(Stage::gmp);
    return meet_in_piece({question.pair, question.vertices()}, lines_, Dim, begin, end);
  }

  const WorldLines& lines_;
  const Leftovers& leftovers_;
  Span span_;
  bool initial_, strict_;
  WindowTally& tally_;
};

}  // namespace noli
