// SPDX-License-Identifier: Apache-2.0
//
// A quick way to see that a direction separates two groups: bounds of where vertices are, in integers of 50 bits. If
// the bounds are apart, so are the vertices; if not, nothing is known, and separation.h decides.
//
// Notation
//   unit       a power of two with which all positions of the step are below 2^50 units
//   x', t'     a position, a time in units (of time, 2^60), rounded down: less than 1 too low, or, where it underflows,
//              less than 1 too high
//   from, to   the ends of the interval in units of time: less than 2 too low, or less than 1 too high
//   [s, e]     two breakpoints around the interval: the first and last of all, or at least `blur` away from it
//   chord      from x'(s) at t'(s) to x'(e) at t'(e); way = x'(e) - x'(s), span = t'(e) - t'(s), taken for 1 if it is 0
//   stray      of a breakpoint between s and e: x' less the chord. The vertex is within the least and the greatest of
//              these and 0 from the chord, with a slack for what is rounded, for a breakpoint and for an end of the
//              interval: 1 for x', 1 for the chord and |way| / 2^40 for its slope, 2 |way| / span for the time. If
//              span was 0, the vertex is within the least and the greatest of these, 0 and way from x'(s)
//   n          with components below 2^40: n.x is below 2^99
#pragma once

#include "scene.h"

namespace noli::checker {

class Enclosures {
  using Point = std::array<std::int64_t, 3>;
  struct Bound {
    std::array<Point, 2> ends{};                         ///< of the chord, at both ends of the interval
    std::array<std::array<std::int64_t, 2>, 3> stray{};  ///< with slack
  };

 public:
  explicit Enclosures(const Motion& motion) : motion_(motion) {
    double most = 0x1p-900, latest = 0x1p-900;
    for (const auto& x : motion.x) most = std::max({most, std::abs(x[0]), std::abs(x[1]), std::abs(x[2])});
    for (const double t : motion.times) latest = std::max(latest, std::abs(t));
    usable_ = most <= 0x1p900 && latest <= 0x1p900;
    if (!usable_) return;
    scale_ = 49 - std::ilogb(most);
    time_scale_ = 59 - std::ilogb(latest);
    t0_ = whole(motion.t0, time_scale_);
    duration_ = whole(motion.t1, time_scale_) - t0_;
    for (std::size_t v = 0; v + 1 < motion.begin.size(); ++v) whole_step_.push_back(bound(v, 0, 0));
  }

  /// Whether a direction n separates, over the interval number k of 2^halvings: the vertices of both groups are added
  /// one by one, then it is open() or not known.
  class Gap {
   public:
    Gap(const Enclosures& all, const std::array<long, 3>& n, std::int64_t k, int halvings)
        : all_(all), n_(n), k_(k), halvings_(halvings) {}
    void add(std::uint32_t v, bool above) {
      halvings_ == 0 ? add(all_.whole_step_[v], above) : add(all_.bound(v, k_, halvings_), above);
    }
    bool open() const {
      const bool apart = high_[0] < low_[0] && high_[1] < low_[1];
      return apart;
    }

   private:
    void add(const Bound& b, bool above) {
      Wide away = 0;
      for (std::size_t i = 0; i < 3; ++i) away += n_[i] * Wide{b.stray[i][(n_[i] < 0) == above ? 1 : 0]};
      for (std::size_t e = 0; e < 2; ++e) {
        const auto& x = b.ends[e];
        const Wide value = Wide{n_[0]} * x[0] + Wide{n_[1]} * x[1] + Wide{n_[2]} * x[2] + away;
        above ? low_[e] = std::min(low_[e], value) : high_[e] = std::max(high_[e], value);
      }
    }

    const Enclosures& all_;
    std::array<long, 3> n_;
    std::int64_t k_;
    int halvings_;
    std::array<Wide, 2> low_{Wide{1} << 100, Wide{1} << 100}, high_{-(Wide{1} << 100), -(Wide{1} << 100)};
  };

  static constexpr long limit = 1L << 40;
  bool usable(const std::array<long, 3>& n, unsigned long halvings) const {
    const bool usable =
        usable_ && halvings <= 30 && std::ranges::all_of(n, [](long c) { return -limit < c && c < limit; });
    return usable;
  }

 private:
  static std::int64_t whole(double x, int scale) { return static_cast<std::int64_t>(std::floor(std::ldexp(x, scale))); }
  std::int64_t time(std::uint64_t i) const { return whole(motion_.times[i], time_scale_); }

  Bound bound(std::size_t v, std::int64_t k, int halvings) const {
    const std::uint64_t first = motion_.begin[v], last = motion_.begin[v + 1] - 1;
    const std::array<Wide, 2> ends = {t0_ + (Wide{k} * duration_ >> halvings),
                                      t0_ + (Wide{k + 1} * duration_ >> halvings)};
    std::uint64_t s = first, e = last;
    for (std::uint64_t high = last; high - s > 1;) {
      const std::uint64_t middle = (s + high) / 2;
      (time(middle) + blur <= ends[0] ? s : high) = middle;
    }
    for (std::uint64_t low = s; e - low > 1;) {
      const std::uint64_t middle = (low + e) / 2;
      (time(middle) - blur >= ends[1] ? e : low) = middle;
    }
    const bool straight = last - first == 1;  // its times are those of the step, so nothing is blurred
    const std::int64_t begin = straight ? 0 : time(s), span = straight ? 1 : std::max<std::int64_t>(time(e) - begin, 1);
    const auto slope = [&](Wide t) { return static_cast<std::int64_t>(((t - begin) << 40) / span); };
    Point start, way;
    Bound b;
    for (std::size_t i = 0; i < 3; ++i) {
      start[i] = whole(motion_.x[s][i], scale_);
      way[i] = whole(motion_.x[e][i], scale_) - start[i];
    }
    for (int i = 0; i < 2; ++i) b.ends[i] = at(start, way, straight ? (k + i) << (40 - halvings) : slope(ends[i]));
    for (std::uint64_t j = s + 1; j < e; ++j) {
      const Point chord = at(start, way, slope(time(j)));
      for (std::size_t i = 0; i < 3; ++i) {
        const std::int64_t away = whole(motion_.x[j][i], scale_) - chord[i];
        b.stray[i] = {std::min(b.stray[i][0], away), std::max(b.stray[i][1], away)};
      }
    }
    for (std::size_t i = 0; i < 3; ++i) {
      const std::int64_t size = std::abs(way[i]),
                         slack = 6 + (size >> 38) +
                                 (straight ? 0 : static_cast<std::int64_t>(Wide{4 * blur} * size / span));
      b.stray[i][0] -= slack;
      b.stray[i][1] += slack;
    }
    return b;
  }
  /// The chord where the part f / 2^40 of its time is over.
  static Point at(const Point& start, const Point& way, std::int64_t f) {
    const auto on = [&](std::size_t i) { return start[i] + static_cast<std::int64_t>(Wide{way[i]} * f >> 40); };
    return {on(0), on(1), on(2)};
  }

  static constexpr std::int64_t blur = 4;

  const Motion& motion_;
  bool usable_ = false;
  int scale_ = 0, time_scale_ = 0;
  std::int64_t t0_ = 0, duration_ = 1;
  std::vector<Bound> whole_step_;  ///< by vertex
};

}  // namespace noli::checker
