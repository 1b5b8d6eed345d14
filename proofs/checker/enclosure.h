// SPDX-License-Identifier: Apache-2.0
//
// Two quick tests whether a direction separates two groups. The first, in integers of 64 bits, compares boxes around
// each vertex at both ends of a piece, which enclose its motion in between. If boxes overlap, as when cells tremble by
// more than their distance, the second compares in binary64 at each breakpoint. Close cases are left to separation.h.
//
// Notation, and why boxes are right
//   unit    a power of two of which all positions and the least distance are less than 2^46
//   x'      a position in units, truncated to an integer: its error is less than 1
//   t'      a time from T0 on, truncated to an integer, the step being 2^49 to 2^50 long. The difference from T0 is
//           rounded too, so the error of t' is below 2, and that of an end of a piece, k/d of the step's, below 3
//   s, e    breakpoints around the piece: the first and last of all, or ones that are `blur` away from it
//   chord   the line C(t) = x'(s) + way (t - t'(s)) / span; way = x'(e) - x'(s), span = t'(e) - t'(s), at least 16.
//           It is evaluated up to 5 beyond s and e, so within 1.4 |way| of x'(s). Its differences are exact in
//           binary64; a quotient and a product are rounded and then truncated: its error is less than 2
//   stray   of a breakpoint between s and e, x' less the chord. Those of s and e are 0; if span was raised to 16, e may
//           be 18 |way| / span away, including the error of its time
//   slack   of a breakpoint 1 for x', 2 for the chord, and 18 |way| / span for its time; of an end of the piece 2 and
//           3 |way| / span: less than 6 + 32 |way| / span. Chord and motion are linear between breakpoints. So a vertex
//           stays between the least and the greatest stray (0 is one) from the chord, up to the slack
//   box     the chord at an end of the piece, with stray and slack: below 2^50. So n.x is below 2^61 if components of n
//           are at most 512, and below 2^92 if they are below 2^40
//   gap     the least n.u less the greatest n.w of the boxes, linear from end to end: a lower bound for condition S.
//           S holds if 2^20 gap > (units of the least distance, rounded up) root, with root >= 2^20 |n|
//
// Why the test at breakpoints is right, with u = 2^-53, M the greatest coordinate or the least distance, and N = |nx| +
// |ny| + |nz|. As M is from 2^-900 to 2^900, nothing overflows, and underflow is far below u M
//   time    of a breakpoint exact. An end of a piece has an error below 8 u of the greatest time, and is moved outward
//           by 16 u of that, but not out of the step: being apart for longer is enough. Gaps are concave between
//           breakpoints, so those at breakpoints and at both ends are enough for any interval
//   value   n.u = f + (g - f) r between two breakpoints, n.x being f and g there. Errors: f and g less than 4 u N M,
//           their difference 10 u N M, r less than 4 u; r is from 0 to 1, as rounding keeps order. So the error of a
//           value is less than 32 u N M
//   margin  128 u N M: for two values, their difference, and the rounding of the distance and of the margin itself
#pragma once

#include "separation.h"

namespace noli::checker {

static_assert(FLT_EVAL_METHOD == 0, "binary64 has to be computed as binary64");

class Enclosures {
  using Point = std::array<std::int64_t, 3>;
  using Box = std::array<std::array<Point, 2>, 2>;  ///< [end of the piece][least, greatest]

 public:
  using Vertices = std::span<const std::uint32_t>;

  Enclosures(const Motion& motion, double eta)
      : motion_(motion), known_(std::min(4 * motion.begin.size(), most_known)) {
    const double duration = motion.t1 - motion.t0;
    double most = std::max(eta, 0x1p-900);
    for (const auto& x : motion.x) most = std::max({most, std::abs(x[0]), std::abs(x[1]), std::abs(x[2])});
    usable_ = most <= 0x1p900 && 0x1p-900 <= duration && duration <= 0x1p900;
    if (!usable_) return;
    most_ = most;
    least_ = eta;
    late_ = 0x1p-49 * std::max(std::abs(motion.t0), std::abs(motion.t1));
    unit_ = std::ldexp(1, 45 - std::ilogb(most));
    time_unit_ = std::ldexp(1, 49 - std::ilogb(duration));
    duration_ = time(motion.t1);
    eta_ = eta > 0 ? static_cast<std::int64_t>(eta * unit_) + 1 : 0;
    whole_step_.resize(motion.begin.size() - 1);
    for (std::size_t v = 0; v < whole_step_.size(); ++v) whole_step_[v] = box(v, {});
  }

  /// Whether a direction surely separates two nonempty groups; if `distance`, by more than the least distance.
  bool apart(const Point& n, const Piece& piece, Vertices x, Vertices y, bool distance) {
    const std::int64_t most = std::max({std::abs(n[0]), std::abs(n[1]), std::abs(n[2])});
    const bool usable = usable_ && piece.halvings <= 30 && most < limit;
    if (!usable) return false;
    const bool boxes =
        most <= 512 ? boxes_apart<std::int64_t>(n, piece, x, y, distance) : boxes_apart<Wide>(n, piece, x, y, distance);
    return boxes || breakpoints_apart(n, piece, x, y, distance);
  }

  static constexpr std::int64_t limit = std::int64_t{1} << 40;

 private:
  struct Known {
    std::uint64_t piece = 0;
    std::uint32_t v = 0;
    Box box{};
  };

  template <class Number>
  bool boxes_apart(const Point& n, const Piece& piece, Vertices x, Vertices y, bool distance) {
    const auto low = least<Number>(n, piece, x), back = least<Number>({-n[0], -n[1], -n[2]}, piece, y);
    const auto square = [&](std::size_t i) { return static_cast<double>(n[i]) * static_cast<double>(n[i]); };
    const double root = distance ? std::ceil(0x1p20 * (1 + 0x1p-40) * std::sqrt(square(0) + square(1) + square(2))) : 0;
    const Wide asked = eta_ * static_cast<Wide>(root), room = 1 << 20;
    const bool apart = room * (Wide{low[0]} + back[0]) > asked && room * (Wide{low[1]} + back[1]) > asked;
    return apart;
  }
  /// The least n.u at both ends of the piece.
  template <class Number>
  std::array<Number, 2> least(const Point& n, const Piece& piece, Vertices vertices) {
    std::array<Number, 2> least;
    least.fill(Number{1} << (8 * sizeof(Number) - 3));
    const std::array<bool, 3> side = {n[0] < 0, n[1] < 0, n[2] < 0};
    for (const std::uint32_t v : vertices) {
      const Box& box = piece.halvings == 0 ? whole_step_[v] : known(v, piece);
      for (std::size_t i = 0; i < 2; ++i) {
        const auto part = [&](std::size_t k) { return Number{n[k]} * box[i][side[k] ? 1 : 0][k]; };
        least[i] = std::min(least[i], part(0) + part(1) + part(2));
      }
    }
    return least;
  }

  bool breakpoints_apart(const Point& n, const Piece& piece, Vertices x, Vertices y, bool distance) {
    const Position m = {static_cast<double>(n[0]), static_cast<double>(n[1]), static_cast<double>(n[2])};
    const double margin = 0x1p-46 * most_ * (std::abs(m[0]) + std::abs(m[1]) + std::abs(m[2])),
                 asked = (distance ? least_ * std::sqrt(dot(m, m)) * (1 + 0x1p-40) : 0) + margin;
    const double from = std::max(motion_.t0, instant(piece.k, piece.halvings) - late_),
                 until = std::min(motion_.t1, instant(piece.k + 1, piece.halvings) + late_);
    times_ = {from, until};
    segments_.clear();
    for (const Vertices& group : {x, y}) {
      for (const std::uint32_t v : group) {
        std::uint64_t e = motion_.segment_end(v, [&](std::uint64_t i) { return motion_.times[i] <= from; });
        segments_.push_back(e);
        for (; motion_.times[e] < until; ++e) times_.push_back(motion_.times[e]);
      }
    }
    std::ranges::sort(times_);
    times_.erase(std::unique(times_.begin(), times_.end()), times_.end());
    return std::ranges::all_of(times_, [&](double c) { return gap(m, c, x.size()) > asked; });
  }
  /// The gap at c, which must not be before that of the last call. Moves segments_ on to c; those of x come first.
  double gap(const Position& m, double c, std::size_t of_x) {
    double low = INFINITY, high = -INFINITY;
    for (std::size_t j = 0; j < segments_.size(); ++j) {
      std::uint64_t& e = segments_[j];
      while (motion_.times[e] < c) ++e;
      const double f = dot(m, motion_.x[e - 1]), g = dot(m, motion_.x[e]), begin = motion_.times[e - 1];
      const double value = f + (g - f) * ((c - begin) / (motion_.times[e] - begin));
      if (j < of_x) low = std::min(low, value);
      if (j >= of_x) high = std::max(high, value);
    }
    return low - high;
  }
  double instant(std::uint64_t k, std::uint64_t halvings) const {
    return motion_.t0 + (motion_.t1 - motion_.t0) * std::ldexp(static_cast<double>(k), -static_cast<int>(halvings));
  }
  static double dot(const Position& m, const Position& x) { return m[0] * x[0] + m[1] * x[1] + m[2] * x[2]; }

  /// The box of a vertex over a piece. Some boxes are cached.
  const Box& known(std::uint32_t v, const Piece& piece) {
    Known& known = known_[(v + 40503 * piece.id) % known_.size()];
    if (known.piece != piece.id || known.v != v) known = {piece.id, v, box(v, piece)};
    return known.box;
  }
  Box box(std::size_t v, const Piece& piece) const {
    const std::array<std::int64_t, 2> ends = {end(piece.k, piece.halvings), end(piece.k + 1, piece.halvings)};
    const auto time_of = [&](std::uint64_t i) { return time(motion_.times[i]); };
    const std::uint64_t s = motion_.segment_end(v, [&](std::uint64_t i) { return time_of(i) + blur <= ends[0]; }) - 1,
                        e = motion_.segment_end(v, [&](std::uint64_t i) { return time_of(i) - blur < ends[1]; });
    const Point start = place(s), way = difference(place(e), start);
    const std::int64_t begin = time(motion_.times[s]),
                       span = std::max<std::int64_t>(time(motion_.times[e]) - begin, 16);
    const auto chord = [&](std::int64_t t) {
      const double over = static_cast<double>(t - begin) / static_cast<double>(span);
      const auto at = [&](std::size_t k) {
        return start[k] + static_cast<std::int64_t>(static_cast<double>(way[k]) * over);
      };
      return Point{at(0), at(1), at(2)};
    };
    std::array<Point, 2> stray{};
    for (std::uint64_t i = s + 1; i < e; ++i) {
      const Point away = difference(place(i), chord(time(motion_.times[i])));
      for (std::size_t k = 0; k < 3; ++k) {
        stray[0][k] = std::min(stray[0][k], away[k]);
        stray[1][k] = std::max(stray[1][k], away[k]);
      }
    }
    Box box;
    for (std::size_t i = 0; i < 2; ++i) {
      box[i].fill(chord(ends[i]));
      for (std::size_t k = 0; k < 3; ++k) {
        const std::int64_t slack = 6 + 32 * std::abs(way[k]) / span;
        box[i][0][k] += stray[0][k] - slack;
        box[i][1][k] += stray[1][k] + slack;
      }
    }
    return box;
  }
  std::int64_t end(std::uint64_t k, std::uint64_t halvings) const {
    return static_cast<std::int64_t>(Wide{duration_} * static_cast<Wide>(k) >> halvings);
  }
  std::int64_t time(double t) const { return static_cast<std::int64_t>((t - motion_.t0) * time_unit_); }
  Point place(std::uint64_t i) const {
    const auto at = [&](std::size_t k) { return static_cast<std::int64_t>(motion_.x[i][k] * unit_); };
    return {at(0), at(1), at(2)};
  }
  static Point difference(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

  static constexpr std::size_t most_known = 1 << 15;
  static constexpr std::int64_t blur = 5;

  const Motion& motion_;
  bool usable_ = false;
  double unit_ = 1, time_unit_ = 1, most_ = 1, least_ = 0, late_ = 0;
  std::int64_t duration_ = 1, eta_ = 0;
  std::vector<Box> whole_step_;  ///< by vertex
  std::vector<Known> known_;
  std::vector<double> times_;            ///< of the last call
  std::vector<std::uint64_t> segments_;  ///< of the last call: for each vertex the end of its current segment
};

}  // namespace noli::checker
