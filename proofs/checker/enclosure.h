// SPDX-License-Identifier: Apache-2.0
//
// A quick way to see that a direction separates two groups: bounds of where vertices are, in integers of 50 bits. If the
// bounds are apart, so are the vertices; if not, nothing is known, and separation.h decides.
//
// Notation
//   unit       a power of two with which all positions of the step are below 2^50 units
//   x', t'     a position, a time in units (of time, 2^60), rounded down: less than 1 too low (or, where that underflows,
//              at most 1 too high)
//   [s, e]     two breakpoints around the interval; where an end of it is no breakpoint, t' is off by less than `blur`
//   chord      from x'(s) at t'(s) to x'(e) at t'(e); way = x'(e) - x'(s), span = t'(e) - t'(s)
//   stray      of a breakpoint: x' less the chord. The vertex is within the least and the greatest of these and 0 from the
//              chord, with a slack for what is rounded: 1 for x', 1 for the ends of the chord, 1 for its value and |way| /
//              2^40 for its slope, blur |way| / span for each of the two times at which it is taken
//   n          with components below 2^40: n.x is below 2^92
#pragma once

#include "scene.h"

namespace noli::checker {

class Enclosures {
 public:
  explicit Enclosures(const Motion& motion) : motion_(motion) {
    double most = 0, latest = 0;
    for (const auto& x : motion.x) most = std::max({most, std::abs(x[0]), std::abs(x[1]), std::abs(x[2])});
    for (const double t : motion.times) latest = std::max(latest, std::abs(t));
    if (most > 0x1p900 || latest > 0x1p900) return;
    scale_ = 49 - std::ilogb(std::max(most, 0x1p-900));
    time_scale_ = 59 - std::ilogb(std::max(latest, 0x1p-900));
    t0_ = whole(motion.t0, time_scale_);
    duration_ = whole(motion.t1, time_scale_) - t0_;
    usable_ = true;
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
    bool open() const { return high_[0] < low_[0] && high_[1] < low_[1]; }

   private:
    friend class Enclosures;
    struct Bound {
      std::array<std::array<std::int64_t, 3>, 2> ends{};   ///< of the chord, at both ends of the interval
      std::array<std::array<std::int64_t, 2>, 3> stray{};  ///< with slack
    };

    void add(const Bound& b, bool above) {
      Wide away = 0;
      for (std::size_t i = 0; i < 3; ++i) away += n_[i] * Wide{b.stray[i][(n_[i] < 0) == above ? 1 : 0]};
      for (std::size_t e = 0; e < 2; ++e) {
        const auto& x = b.ends[e];
        const Wide value = Wide{n_[0]} * x[0] + Wide{n_[1]} * x[1] + Wide{n_[2]} * x[2];
        if (above) low_[e] = std::min(low_[e], value + away);
        if (!above) high_[e] = std::max(high_[e], value + away);
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
    return usable_ && halvings <= 30 && std::ranges::all_of(n, [](long c) { return -limit < c && c < limit; });
  }

 private:
  using Bound = Gap::Bound;

  static std::int64_t whole(double x, int scale) { return static_cast<std::int64_t>(std::floor(std::ldexp(x, scale))); }
  std::int64_t time(std::uint64_t i) const { return whole(motion_.times[i], time_scale_); }

  Bound bound(std::size_t v, std::int64_t k, int halvings) const {
    const std::uint64_t first = motion_.begin[v], last = motion_.begin[v + 1] - 1;
    Bound b;
    if (last - first == 1) return straight(first, k, halvings);
    const std::int64_t from = t0_ + static_cast<std::int64_t>(Wide{k} * duration_ >> halvings);
    const std::int64_t to = t0_ + static_cast<std::int64_t>(Wide{k + 1} * duration_ >> halvings);
    std::uint64_t s = first, e = last;
    for (std::uint64_t high = last; high - s > 1;) {
      const std::uint64_t middle = (s + high) / 2;
      (time(middle) + blur <= from ? s : high) = middle;
    }
    for (std::uint64_t low = s; e - low > 1;) {
      const std::uint64_t middle = (low + e) / 2;
      (time(middle) - blur >= to ? e : low) = middle;
    }
    const std::int64_t begin = time(s), span = std::max<std::int64_t>(time(e) - begin, 1);
    std::array<std::int64_t, 3> start, way;
    for (std::size_t i = 0; i < 3; ++i) {
      start[i] = whole(motion_.x[s][i], scale_);
      way[i] = whole(motion_.x[e][i], scale_) - start[i];
    }
    const auto chord = [&](std::int64_t t, std::size_t i) {
      return start[i] + static_cast<std::int64_t>(way[i] * ((Wide{t - begin} << 40) / span) >> 40);
    };
    for (std::uint64_t j = s + 1; j < e; ++j) {
      const Wide slope = (Wide{time(j) - begin} << 40) / span;
      for (std::size_t i = 0; i < 3; ++i) {
        const std::int64_t away =
            whole(motion_.x[j][i], scale_) - start[i] - static_cast<std::int64_t>(way[i] * slope >> 40);
        b.stray[i] = {std::min(b.stray[i][0], away), std::max(b.stray[i][1], away)};
      }
    }
    for (std::size_t i = 0; i < 3; ++i) {
      b.ends[0][i] = chord(from, i);
      b.ends[1][i] = chord(to, i);
      const std::int64_t size = std::abs(way[i]),
                         slack = 6 + (size >> 38) + static_cast<std::int64_t>(Wide{4} * blur * size / span);
      b.stray[i][0] -= slack;
      b.stray[i][1] += slack;
    }
    return b;
  }

  /// A vertex without breakpoints between the ends of the step.
  Bound straight(std::uint64_t first, std::int64_t k, int halvings) const {
    Bound b;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::int64_t start = whole(motion_.x[first][i], scale_),
                         way = whole(motion_.x[first + 1][i], scale_) - start;
      for (std::size_t e = 0; e < 2; ++e)
        b.ends[e][i] = start + static_cast<std::int64_t>((Wide{way} * (k + static_cast<int>(e))) >> halvings);
      b.stray[i] = {-2, 2};
    }
    return b;
  }

  static constexpr std::int64_t blur = 4;

  const Motion& motion_;
  bool usable_ = false;
  int scale_ = 0, time_scale_ = 0;
  std::int64_t t0_ = 0, duration_ = 1;
  std::vector<Bound> whole_step_;  ///< by vertex
};

}  // namespace noli::checker
