// SPDX-License-Identifier: Apache-2.0
//
// Proves that two parts of cells are apart: finds directions that separate them, piece of time by piece.
//
// Notation
//   part     vertices of a cell, by a mask of its corners
//   piece    the share [k / 2^e, (k + 1) / 2^e] of the step
//   span     the piece in which they must be separated
//   chord, radius   as in proofs/prover/windows/chord.h; for a vertex without breakpoints inside, the radius is 0, and
//                   the chord is its motion
//   margin   as in proofs/prover/windows/window_cell.h
//
// A piece is halved until a direction is found. The search uses doubles and the proved test of
// proofs/prover/cells/direction.h, with a margin for the radii; if that fails and the piece is short, exact arithmetic.
// The direction is then written with as few bits as pass the same test.
//
// It does not decide contact: if two parts meet, it halves until it gives up.
#pragma once

#include <cmath>
#include <utility>

#include <noli/findings.h>
#include "proofs/prover/cells/around.h"
#include "proofs/prover/cells/direction_search.h"
#include "proofs/prover/cells/exact_direction.h"
#include "proofs/prover/tokens/mesh_paths.h"
#include "proofs/prover/tokens/no_proof.h"
#include "proofs/prover/tokens/short_direction.h"
#include "proofs/prover/tokens/tokens.h"
#include "proofs/prover/traversal.h"
#include "proofs/prover/windows/window_cell.h"

namespace noli {

/// The vertices of a part, each once.
struct ProofCell {
  std::array<VertexId, 3> vertices{};
  std::uint8_t corners = 0;

  void add(VertexId v) {
    for (std::size_t i = 0; i < corners; ++i) {
      if (vertices[i] == v) return;
    }
    vertices[corners++] = v;
  }
};

/// A share of the step.
struct Piece {
  Integer k;
  unsigned e = 0;

  Piece half(long which) const { return {k * Integer(2) + Integer(which), e + 1}; }

  /// Doubles around the piece: exact for the whole step, otherwise at most a little outside it. Nothing if doubles
  /// cannot tell its ends apart.
  std::optional<Span> times(const WorldLines& lines) const {
    const double first = lines.first_time(), last = lines.last_time();
    if (e == 0) return Span{first, last};
    if (e > 45 || !std::isfinite(last - first)) return std::nullopt;
    const double width = std::ldexp(last - first, -static_cast<int>(e)), from = first + width * mpz_get_d(k.get());
    const double slack = 8 * std::max(std::abs(first), std::abs(last)) * 0x1p-53;
    const Span span{std::max(from - slack, first), std::min(from + width + slack, last)};
    return span.begin < span.end ? std::optional(span) : std::nullopt;
  }
};

/// Writes the tokens for the remaining parts of one pair of cells.
template <int Dim>
class ProofParts {
 public:
  /// `eta`, `paths`: the least distance, and the paths that allow features to be nearer (not needed if eta is 0).
  ProofParts(const WorldLines& lines, const Piece& span, double eta, const MeshPaths* paths, const StopSignal& stop,
             Tokens& tokens)
      : lines_(lines), span_(span), distance_(eta), paths_(paths), stop_(stop), tokens_(tokens) {}

  /// Writes the tokens for parts of two cells that have no vertex in common. False if it was stopped; the tokens are
  /// then incomplete. Throws TooNear, NoProof.
  bool settle(std::uint32_t i, const ProofCell& a, std::uint32_t j, const ProofCell& b) {
    first_cell_ = i;
    second_cell_ = j;
    separate({a, all_corners(a.corners)}, {b, all_corners(b.corners)});
    return !stopped_;
  }

 private:
  struct Part {
    const ProofCell& cell;
    CornerMask mask;

    Part without(std::size_t corner) const { return {cell, static_cast<CornerMask>(mask & ~(1U << corner))}; }
    bool has(std::size_t corner) const { return (mask >> corner & 1) != 0; }
  };

  struct Pair {
    PartPair<Dim> points;
    bool exact = true;  ///< all radii are 0
    double strays = 0;  ///< the greatest radii of both parts, added
  };

  /// The depth from which exact arithmetic is tried, and the depth at which to give up: there, neighbouring doubles are
  /// farther apart than anything moves.
  static constexpr unsigned exact_from = 6, give_up = 1000, give_up_near = 120, interval_bits = 20;
  static constexpr std::size_t most_exact = 60;

  void separate(Part a, Part b) {
    if (a.mask == 0 || b.mask == 0) return tokens_.empty();
    const Pair pair = *pair_in(a, b, span_);
    if (closed_at_once(pair)) return;
    if (distance_ > 0) return go_around(a, b, pair);
    halve(a, b, pair, span_);
  }

  /// Whether a direction is found for the whole span.
  bool closed_at_once(const Pair& pair) {
    const auto n = last_ && above(pair, *last_, {}) ? last_ : find(pair, {});
    if (n) write(pair, *n, {});
    return n.has_value();
  }

  /// Two parts that were not shown to be far enough apart. If a path joins two of their vertices, features with both
  /// need only be disjoint.
  void go_around(const Part& a, const Part& b, const Pair& pair) {
    for (std::size_t i = 0; i < a.cell.corners; ++i) {
      for (std::size_t j = 0; j < b.cell.corners; ++j) {
        if (!a.has(i) || !b.has(j)) continue;
        const auto path = paths_->find(a.cell.vertices[i], b.cell.vertices[j]);
        if (!path) continue;
        tokens_.ring(a.cell.vertices[i], *path);
        separate(a.without(i), b);
        separate(a, b.without(j));
        const double distance = std::exchange(distance_, 0);
        separate(a, b);
        distance_ = distance;
        return;
      }
    }
    for (int k = 0; k <= 8; ++k) refuse_near(pair, k / 8.0, span_, k / 8.0);
    halve(a, b, pair, span_);
  }

  /// Throws TooNear if the parts are certainly nearer than the least distance at a time: this part of the piece, which
  /// is `at` on the pair's chords. (In three dimensions a vertex strays from its chord by less than two radii.)
  void refuse_near(const Pair& pair, double at, const Piece& piece, double part) const {
    if (distance_at_most(pair.points, at, search_rounds) + 2 * pair.strays >= distance_ * (1 - 0x1p-30)) return;
    throw TooNear{first_cell_, second_cell_, std::ldexp(mpz_get_d(piece.k.get()) + part, -static_cast<int>(piece.e))};
  }

  /// The bound that n.(a - b) must exceed: rounding, radii and the least distance.
  double bound_of(const Pair& pair, const Direction<Dim>& n) const {
    const double bound = error_bound<Dim>(n, pair.points.reach);
    return distance_ == 0 ? bound : bound + distance_ * std::sqrt(formula::dot(n, n)) * (1 + 0x1p-48);
  }

  bool above(const Pair& pair, const Direction<Dim>& n, const Interval& interval) const {
    const Projections p = at_ends(project(pair.points, n), interval);
    const double bound = bound_of(pair, n);
    return gap_above(p.q[0]) > bound && gap_above(p.q[1]) > bound;
  }

  std::optional<Direction<Dim>> find(const Pair& pair, const Interval& interval) const {
    return find_direction<Dim>(pair.points, between_middles(pair.points), interval, search_rounds,
                               [&](const Direction<Dim>& n) { return bound_of(pair, n); });
  }

  /// Parts exactly at the least distance are too near.
  [[noreturn]] void give_up_at(const Piece& piece) const {
    if (distance_ == 0) throw NoProof("no direction separates two parts, however short the time");
    const Integer at = piece.k.is_zero() ? piece.k : piece.k + Integer(1);
    throw TooNear{first_cell_, second_cell_, std::ldexp(mpz_get_d(at.get()), -static_cast<int>(piece.e))};
  }

  void halve(const Part& a, const Part& b, const Pair& pair, const Piece& piece) {
    if (piece.e == (distance_ == 0 ? give_up : give_up_near)) give_up_at(piece);
    stopped_ = stopped_ || stop_.raised();  // two cells with many breakpoints can take minutes
    tokens_.halve();
    for (long which = 0; which < 2 && !stopped_; ++which) over_piece(a, b, pair, piece.half(which));
  }

  void over_piece(const Part& a, const Part& b, const Pair& whole, const Piece& piece) {
    if (whole.exact && piece.e <= span_.e + interval_bits) {
      const unsigned deeper = piece.e - span_.e;
      const double width = std::ldexp(1.0, -static_cast<int>(deeper));
      const double begin = width * mpz_get_d((piece.k - (span_.k << deeper)).get());
      const Interval interval{begin, begin + width};
      if (const auto n = find(whole, interval)) return write(whole, *n, interval);
      const bool is_left_half = mpz_even_p(piece.k.get()) != 0;  // other ends were looked at before
      if (distance_ > 0 && is_left_half) refuse_near(whole, interval.end, piece, 1);
    } else if (!whole.exact) {
      if (const auto pair = pair_in(a, b, piece)) {
        if (const auto n = find(*pair, {})) return write(*pair, *n, {});
        for (const double part : {0.0, 1.0}) {
          if (distance_ > 0) refuse_near(*pair, part, piece, part);
        }
      }
    }
    if (piece.e >= exact_from) {
      if (const auto differences = differences_in(a, b, piece)) {
        if (const auto n = exact_direction(differences->w, differences->least2)) return tokens_.direction(*n);
      }
    }
    halve(a, b, whole, piece);
  }

  /// The pair, with chords over the piece.
  std::optional<Pair> pair_in(const Part& a, const Part& b, const Piece& piece) const {
    const auto times = piece.times(lines_);
    if (!times) return std::nullopt;
    const CornerChords of_a = chords_over(a, *times), of_b = chords_over(b, *times);
    const Chord<Dim>& origin = of_a[static_cast<std::size_t>(std::countr_zero(a.mask))];
    Pair pair;
    const auto put = [&](CornerMask mask, const CornerChords& chords, std::size_t lane) {
      double margin = 0;
      const auto& lanes = detail::lanes_of(mask);
      for (std::size_t l = 0; l < 4; ++l) {
        const Chord<Dim>& c = chords[lanes[l]];
        for (std::size_t k = 0; k < Dim; ++k) {
          pair.points.d[0][k][lane + l] = c.x_t0[k] - origin.x_t0[k];
          pair.points.d[1][k][lane + l] = c.x_t1[k] - origin.x_t1[k];
          margin = std::max(margin, c.radius[k]);
        }
      }
      return margin;
    };
    pair.strays = put(a.mask, of_a, 0) + put(b.mask, of_b, 4);
    pair.exact = pair.strays == 0;
    pair.points.reach = detail::reach_of<Dim>(pair.points.d);
    if (!pair.exact) pair.points.reach = raised(pair.points.reach, pair.strays);
    return pair;
  }

  /// By corner; meaningless for one that is not in the part.
  using CornerChords = std::array<Chord<Dim>, 3>;

  CornerChords chords_over(const Part& part, Span times) const {
    CornerChords chords;
    for (std::size_t i = 0; i < part.cell.corners; ++i) {
      if (part.has(i)) chords[i] = chord_of<Dim>(WorldLine(lines_, part.cell.vertices[i]), times.begin, times.end);
    }
    return chords;
  }

  /// Writes the direction with as few bits as separate by the same test.
  void write(const Pair& pair, const Direction<Dim>& n, const Interval& interval) {
    last_ = n;
    put_direction(
        n, [&](const Direction<Dim>& m) { return above(pair, m, interval); }, tokens_);
  }

  /// D and least2 of proofs/prover/cells/exact_direction.h.
  struct Differences {
    std::vector<IntegerVector> w;
    Integer least2;
  };

  /// The breakpoints of a vertex that determine its motion within the piece: from the last one not after the piece's
  /// begin to the first one not before its end.
  struct Stretch {
    std::span<const double> times;
    std::span<const Position> positions;
  };

  /// Times of the step as whole numbers of one unit, 2^(range.low - e).
  struct Unit {
    exact::ExponentRange range;
    unsigned e;

    Integer operator()(double t) const { return exact::coordinate<Integer>(t, range) << e; }
  };

  /// The differences at both ends of the piece and at each breakpoint of the parts in between. Nothing if they are too
  /// many.
  std::optional<Differences> differences_in(const Part& a, const Part& b, const Piece& piece) const {
    std::vector<Stretch> vertices;
    std::size_t of_a = 0, breakpoints = 2;
    for (const Part* part : {&a, &b}) {
      for (std::size_t i = 0; i < part->cell.corners; ++i) {
        if (!part->has(i)) continue;
        vertices.push_back(stretch(part->cell.vertices[i], piece));
        breakpoints += vertices.back().times.size() - 2;
      }
      if (part == &a) of_a = vertices.size();
    }
    if (breakpoints * of_a * (vertices.size() - of_a) > most_exact) return std::nullopt;
    return differences_at(vertices, of_a, piece);
  }

  Differences differences_at(const std::vector<Stretch>& vertices, std::size_t of_a, const Piece& piece) const {
    exact::ExponentRange space, time;
    for (const Stretch& v : vertices) {
      for (const Position& x : v.positions) {
        for (std::size_t k = 0; k < Dim; ++k) space.add(x[k]);
      }
      for (const double t : v.times) time.add(t);
    }
    if (distance_ > 0) space.add(distance_);
    time.add(lines_.first_time());
    time.add(lines_.last_time());
    const Unit unit{time, piece.e};
    std::vector<Integer> times = {time_of(piece.k, unit), time_of(piece.k + Integer(1), unit)};
    for (const Stretch& v : vertices) {
      for (std::size_t s = 1; s + 1 < v.times.size(); ++s) times.push_back(unit(v.times[s]));
    }
    Differences result;
    std::vector<Integer> denominators;
    for (const Integer& c : times) {
      std::vector<std::pair<IntegerVector, Integer>> at;  // numerators, denominator > 0
      at.reserve(vertices.size());
      for (const Stretch& v : vertices) at.push_back(position(v, c, space, unit));
      for (std::size_t i = 0; i < of_a; ++i) {
        for (std::size_t j = of_a; j < vertices.size(); ++j) {
          IntegerVector w;
          for (std::size_t k = 0; k < Dim; ++k) w[k] = at[i].first[k] * at[j].second - at[j].first[k] * at[i].second;
          result.w.push_back(std::move(w));
          denominators.push_back(at[i].second * at[j].second);
        }
      }
    }
    make_common(result, denominators);
    if (distance_ > 0) {
      const Integer least = exact::coordinate<Integer>(distance_, space) * denominators[0];
      result.least2 = least * least;
    }
    return result;
  }

  /// The time at the share k / 2^e of the step, in the unit, which has the same e.
  Integer time_of(const Integer& k, const Unit& unit) const {
    const Integer first = exact::coordinate<Integer>(lines_.first_time(), unit.range);
    const Integer last = exact::coordinate<Integer>(lines_.last_time(), unit.range);
    return (first << unit.e) + (last - first) * k;
  }

  /// Uses binary search, as the step can have many breakpoints.
  Stretch stretch(VertexId v, const Piece& piece) const {
    const auto t = lines_.times(v);
    const auto order = [&](double time, const Integer& k) {
      exact::ExponentRange range;
      for (const double of : {time, lines_.first_time(), lines_.last_time()}) range.add(of);
      const Unit unit{range, piece.e};
      return mpz_cmp(unit(time).get(), time_of(k, unit).get());
    };
    const Integer begin = piece.k, end = piece.k + Integer(1);
    const auto from = std::partition_point(t.begin() + 1, t.end() - 1, [&](double x) { return order(x, begin) <= 0; });
    const auto to = std::partition_point(from, t.end() - 1, [&](double x) { return order(x, end) < 0; });
    const auto first = static_cast<std::size_t>(from - t.begin()) - 1, last = static_cast<std::size_t>(to - t.begin());
    return {t.subspan(first, last + 1 - first), lines_.positions(v).subspan(first, last + 1 - first)};
  }

  /// Multiplies each vector so that all have the same denominator, which replaces the first one.
  static void make_common(Differences& differences, std::vector<Integer>& denominators) {
    Integer common = denominators[0];
    for (const Integer& d : denominators) mpz_lcm(common.get(), common.get(), d.get());
    for (std::size_t i = 0; i < denominators.size(); ++i) {
      const Integer factor = divide_exactly(common, denominators[i]);
      for (Integer& part : differences.w[i]) part *= factor;
    }
    denominators[0] = common;
  }

  static std::pair<IntegerVector, Integer> position(const Stretch& v, const Integer& c,
                                                    const exact::ExponentRange& space, const Unit& unit) {
    std::size_t s = 0;
    while (s + 2 < v.times.size() && unit(v.times[s + 1]) <= c) ++s;
    const Integer before = c - unit(v.times[s]), after = unit(v.times[s + 1]) - c;
    IntegerVector numerators;
    for (std::size_t k = 0; k < Dim; ++k) {
      const Integer from = exact::coordinate<Integer>(v.positions[s][k], space);
      const Integer to = exact::coordinate<Integer>(v.positions[s + 1][k], space);
      numerators[k] = from * after + to * before;
    }
    return {std::move(numerators), before + after};
  }

  const WorldLines& lines_;
  Piece span_;
  double distance_;  ///< the least distance, or 0 if parts need only be disjoint
  const MeshPaths* paths_;
  const StopSignal& stop_;
  Tokens& tokens_;
  bool stopped_ = false;
  std::uint32_t first_cell_ = 0, second_cell_ = 0;
  std::optional<Direction<Dim>> last_;  ///< separated other parts of the same cells
};

}  // namespace noli
