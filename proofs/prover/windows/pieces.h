// SPDX-License-Identifier: Apache-2.0
//
// Settles two parts over pieces of a span, if no direction settles them over the whole span.
//
// Notation
//   piece     a time interval [begin, end]; it is cut only at breakpoints of the vertices in question
//   resists   no direction was found for two parts over a piece that has no breakpoint inside
//
// If two parts resist in a piece, each of their pairs of features is settled in the same way over the rest of the span,
// and is decided exactly over the pieces in which it resists. It counts once, in the first piece in which it meets.
#pragma once

#include "proofs/prover/cells/direction_search.h"
#include "proofs/prover/feature_pairs.h"
#include "proofs/prover/tally.h"
#include "proofs/prover/windows/window_cell.h"
#include "proofs/prover/windows/window_features.h"

namespace noli {

/// The findings of one task of the verification of a window.
using WindowTally = TallyWith<EarliestOf<ExactlyInWindow>>;

template <int Dim>
class Pieces {
 public:
  using Cell = WindowCell<Dim>;

  Pieces(const WorldLines& lines, Span span) : lines_(lines), span_(span) {}

  /// The beginning of the first piece of the span in which two parts resist; nothing if they resist in none.
  std::optional<double> resisting(const Cell& a, CornerMask a_part, const Cell& b, CornerMask b_part,
                                  WindowTally& tally) const {
    std::optional<double> begin;
    settle_over(a, a_part, b, b_part, span_, tally, [&](const Cell&, const Cell&, Span piece) {
      begin = piece.begin;
      return false;
    });
    return begin;
  }

  /// When two features first meet in the span from `begin` on. The question is about cells with the span's chords.
  std::optional<TimeEnclosure> meet(const FeatureQuestion<Dim>& question, double begin, WindowTally& tally) const {
    const auto& a = static_cast<const Cell&>(*question.first_cell);
    const auto& b = static_cast<const Cell&>(*question.second_cell);
    const CornerMask a_part = part_of(question.first), b_part = part_of(question.second);
    if (begin == span_.begin && apart(a, a_part, b, b_part, tally)) return std::nullopt;
    std::optional<TimeEnclosure> first;
    settle_piece(a, a_part, b, b_part, {begin, span_.end}, tally,
                 [&](const Cell& a_now, const Cell& b_now, Span piece) {
                   first = ask_piece({question.pair, &a_now, question.first, &b_now, question.second}, piece, tally);
                   return !first;
                 });
    return first;
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

 private:
  /// Whether a direction was found that separates the parts, with the radii of their cells.
  static bool apart(const Cell& a, CornerMask a_part, const Cell& b, CornerMask b_part, WindowTally& tally) {
    const PartPair<Dim> pair = pair_of(a, a_part, b, b_part, static_cast<std::size_t>(std::countr_zero(a_part)));
    const Direction<Dim> guess = between_middles(pair);
    const bool found = separates(pair, guess) != 0 || separates(pair, a.normal) != 0 ||
                       separates(pair, b.normal) != 0 || find_direction(pair, guess, {}, search_rounds);
    tally.obligations += found ? 1 : 0;
    return found;
  }

  /// Settles two parts over a piece by directions. Calls resist(a, b, piece), with the chords of the piece, for each
  /// piece that resists, in order, until a call returns false. Returns whether none did.
  template <class Resist>
  bool settle_over(const Cell& a, CornerMask a_part, const Cell& b, CornerMask b_part, Span piece, WindowTally& tally,
                   const Resist& resist) const {
    const std::optional<double> cut = time_to_cut(a, a_part, b, b_part, piece);
    if (!cut) return resist(a, b, piece);
    return settle_piece(a, a_part, b, b_part, {piece.begin, *cut}, tally, resist) &&
           settle_piece(a, a_part, b, b_part, {*cut, piece.end}, tally, resist);
  }

  template <class Resist>
  bool settle_piece(const Cell& a, CornerMask a_part, const Cell& b, CornerMask b_part, Span piece, WindowTally& tally,
                    const Resist& resist) const {
    const Cell a_now = over(a, a_part, lines_, piece.begin, piece.end);
    const Cell b_now = over(b, b_part, lines_, piece.begin, piece.end);
    return apart(a_now, a_part, b_now, b_part, tally) ||
           settle_over(a_now, a_part, b_now, b_part, piece, tally, resist);
  }

  /// The median of the breakpoints inside the piece, of the vertex that has most; nothing if none has any.
  std::optional<double> time_to_cut(const Cell& a, CornerMask a_part, const Cell& b, CornerMask b_part,
                                    Span piece) const {
    std::size_t most = 0;
    std::optional<double> cut;
    const auto look = [&](const Cell& c, CornerMask part) {
      for (std::size_t i = 0; i < 3; ++i) {
        if ((part >> i & 1) == 0) continue;
        const WorldLine line(lines_, c.vertices[i]);
        const std::size_t first = line.segment_after(piece.begin), last = line.segment_before(piece.end);
        if (last <= first || last - first <= most) continue;
        most = last - first;
        cut = line.t[first + 1 + (most - 1) / 2];
      }
    };
    look(a, a_part);
    look(b, b_part);
    return cut;
  }

  static CornerMask part_of(const Feature& feature) {
    CornerMask part = 0;
    for (std::size_t i = 0; i < feature.size; ++i) part |= static_cast<CornerMask>(1 << feature.corners[i]);
    return part;
  }

  static bool exact(const Cell& c) {
    return std::all_of(c.radius.begin(), c.radius.end(), [](double r) { return r == 0; });
  }

  /// Decides a pair of features, which move linearly over the piece along the chords of the cells.
  std::optional<TimeEnclosure> ask_piece(const FeatureQuestion<Dim>& question, Span piece, WindowTally& tally) const {
    const bool doubles =
        exact(static_cast<const Cell&>(*question.first_cell)) && exact(static_cast<const Cell&>(*question.second_cell));
    if (doubles) {
      const auto s = ask(question, tally.stages);
      return s ? std::optional(enclosure_in_window(*s, piece.begin, piece.end)) : std::nullopt;
    }
    tally.stages.count(Stage::gmp);
    return meet_in_piece(question.pair, question.vertices(), lines_, Dim, piece.begin, piece.end);
  }

  const WorldLines& lines_;
  Span span_;
};

}  // namespace noli
