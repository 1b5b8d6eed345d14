// SPDX-License-Identifier: Apache-2.0
//
// A quick way to see that a direction separates two groups: bounds of where vertices are, in integers of 50 bits. If the
// bounds are apart, so are the vertices; if not, nothing is known, and separation.h decides.
//
// Notation
//   unit       a power of two with which all positions of the step are below 2^50 units
//   A, B, x'   first, last, and any position in units, rounded down, and so less than 1 too low (or, where that
//              underflows, at most 1 too high); way = B - A
//   c          2^30 (t - T0) / (T1 - T0), rounded down, from times that are rounded down in the same way: with at least
//              2^33 of their units from T0 to T1, c is at most 2 too low and 1 too high
//   stray      at a breakpoint x is A + way c / 2^30 and (x' - A) - way c / 2^30 more, but for 4 units of rounding and 2
//              |way| / 2^30; the least and the greatest of these, with that slack. Between breakpoints x is linear, so
//              that x(t) is within the stray of the straight way from A to B throughout
//   n          with components below 2^10: n.x is below 2^62, and times 2^30 below 2^92
#pragma once

#include "scene.h"

namespace noli::checker {

class Enclosures {
 public:
  explicit Enclosures(const Motion& motion) {
    double most = 0, latest = 0;
    for (const auto& x : motion.x) most = std::max({most, std::abs(x[0]), std::abs(x[1]), std::abs(x[2])});
    for (const double t : motion.times) latest = std::max(latest, std::abs(t));
    scale_ = 50 - std::ilogb(std::max(most, 0x1p-900)) - 1;
    time_scale_ = 60 - std::ilogb(std::max(latest, 0x1p-900)) - 1;
    const std::int64_t first = whole(motion.t0, time_scale_), duration = whole(motion.t1, time_scale_) - first;
    if (most > 0x1p900 || latest > 0x1p900 || duration < std::int64_t{1} << 33) return;
    for (std::size_t v = 0; v + 1 < motion.begin.size(); ++v)
      bounds_.push_back(bound(motion, motion.begin[v], motion.begin[v + 1], first, duration));
  }

  /// One vertex after another, all of a group; `above` says which group.
  class Gap {
   public:
    Gap(const Enclosures& all, const std::array<long, 3>& n, std::int64_t k, int halvings)
        : all_(all), n_(n), k_(k), halvings_(halvings) {}
    void add(std::uint32_t v, bool above) {
      const Bound& b = all_.bounds_[v];
      std::int64_t first = 0, last = 0, away = 0;
      for (std::size_t i = 0; i < 3; ++i) {
        first += n_[i] * b.first[i];
        last += n_[i] * b.last[i];
        away += n_[i] * b.stray[i][(n_[i] < 0) == above ? 1 : 0];
      }
      for (int e = 0; e < 2; ++e) {
        const Wide at = k_ + e, all = Wide{1} << halvings_,
                   value = first * (all - at) + last * at + (Wide{away} << halvings_);
        if (above) low_[e] = std::min(low_[e], value);
        if (!above) high_[e] = std::max(high_[e], value);
      }
    }
    bool open() const { return high_[0] < low_[0] && high_[1] < low_[1]; }

   private:
    const Enclosures& all_;
    std::array<long, 3> n_;
    std::int64_t k_;
    int halvings_;
    std::array<Wide, 2> low_{Wide{1} << 120, Wide{1} << 120}, high_{-(Wide{1} << 120), -(Wide{1} << 120)};
  };

  /// Whether a direction of these components can be looked at over the interval number k of 2^halvings.
  bool usable(const std::array<long, 3>& n, unsigned long halvings) const {
    return !bounds_.empty() && halvings <= 30 && std::ranges::all_of(n, [](long c) { return -1024 < c && c < 1024; });
  }

 private:
  struct Bound {
    std::array<std::int64_t, 3> first{}, last{};
    std::array<std::array<std::int64_t, 2>, 3> stray{};
  };

  static std::int64_t whole(double x, int scale) { return static_cast<std::int64_t>(std::floor(std::ldexp(x, scale))); }

  Bound bound(const Motion& motion, std::uint64_t begin, std::uint64_t end, std::int64_t t0,
              std::int64_t duration) const {
    Bound b;
    for (std::size_t k = 0; k < 3; ++k) {
      b.first[k] = whole(motion.x[begin][k], scale_);
      b.last[k] = whole(motion.x[end - 1][k], scale_);
    }
    for (std::uint64_t i = begin + 1; i + 1 < end; ++i) {
      const auto c =
          static_cast<std::int64_t>((static_cast<Wide>(whole(motion.times[i], time_scale_) - t0) << 30) / duration);
      for (std::size_t k = 0; k < 3; ++k) {
        const std::int64_t straight =
            b.first[k] + static_cast<std::int64_t>(static_cast<Wide>(b.last[k] - b.first[k]) * c >> 30);
        const std::int64_t away = whole(motion.x[i][k], scale_) - straight;
        b.stray[k] = {std::min(b.stray[k][0], away), std::max(b.stray[k][1], away)};
      }
    }
    for (std::size_t k = 0; k < 3; ++k) {
      const std::int64_t slack = end - begin == 2 ? 1 : 5 + (std::abs(b.last[k] - b.first[k]) >> 29);
      b.stray[k][0] -= slack;
      b.stray[k][1] += slack;
    }
    return b;
  }

  int scale_ = 0, time_scale_ = 0;
  std::vector<Bound> bounds_;
};

}  // namespace noli::checker
