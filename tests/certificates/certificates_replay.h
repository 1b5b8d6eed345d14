// SPDX-License-Identifier: Apache-2.0
//
// Plays back recorded world lines and decides whether two features stay farther apart than a bound all the time.
//
// Notation
//   track   breakpoints of a vertex over a window, joined linearly, as recorded in a run
//   piece   a time in which no vertex of the pair has a breakpoint
//   n       a direction, |n| = 1 up to rounding; n . (a - b) is linear in time over a piece, so if it is greater than a
//           bound at both ends for all vertices a of A and b of B, the features are farther apart than that
//
// Such a direction settles most pieces in double precision, with an error bound. If none is found, the piece is halved.
// Pieces that stay open are decided exactly (certificates_exact.h).
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "certificates/closest.h"
#include "certificates_exact.h"

namespace noli::certificates::test {

template <int Dim>
struct Breakpoint {
  double t;
  Vector<Dim> x;
};

/// At least two breakpoints, times strictly ascending.
template <int Dim>
using Track = std::vector<Breakpoint<Dim>>;

struct ReplayCounts {
  std::uint64_t boxed = 0;                                 ///< stretches settled by boxes, without their breakpoints
  std::uint64_t pieces = 0;                                ///< examined one by one
  std::uint64_t near = 0;                                  ///< those of them with a gap below twice the bound
  std::uint64_t exact = 0;                                 ///< decided by integers
  double least = std::numeric_limits<double>::infinity();  ///< gap found, in units of the bound, less 1

  ReplayCounts& operator+=(const ReplayCounts& o) {
    boxed += o.boxed;
    pieces += o.pieces;
    near += o.near;
    exact += o.exact;
    least = std::min(least, o.least);
    return *this;
  }
};

template <int Dim>
class Replay {
 public:
  /// The tracks of a window must outlive this object.
  explicit Replay(const std::vector<Track<Dim>>& tracks) : tracks_(tracks) {
    double greatest = 0;
    for (const Track<Dim>& track : tracks) {
      Vector<Dim> low = track.front().x, high = low;
      for (const auto& b : track) {
        low = low.cwiseMin(b.x);
        high = high.cwiseMax(b.x);
      }
      greatest = std::max({greatest, low.cwiseAbs().maxCoeff(), high.cwiseAbs().maxCoeff()});
      low_.push_back(low);
      high_.push_back(high);
    }
    // n . (a - b) of positions from MotionSegment::at: below 60 units of 2^-53 of the greatest coordinate.
    error_ = 0x1p-46 * greatest;
  }

  /// Whether the pair is farther apart than eta at each time of [begin, end]. `n` is a direction to try first; it
  /// becomes the last one that held. Preconditions: the tracks cover [begin, end]; begin < end.
  bool stays_farther(const Stencil& s, double begin, double end, double eta, Vector<Dim>& n) {
    if (boxes_apart(s, eta)) {
      ++counts_.boxed;
      return true;
    }
    std::array<std::size_t, 4> at{};
    for (std::size_t k = 0; k < s.size(); ++k) at[k] = chord_after(tracks_[s.vertices[k]], begin);
    for (double t = begin; t < end;) {
      std::array<MotionSegment<Dim>, 4> chords;
      double next = end;
      for (std::size_t k = 0; k < s.size(); ++k) {
        chords[k] = chord(tracks_[s.vertices[k]], at[k]);
        next = std::min(next, chords[k].t1);
      }
      ++counts_.pieces;
      if (!piece_farther(s, {chords.data(), s.size()}, t, next, eta, n, most_cuts)) return false;
      for (std::size_t k = 0; k < s.size(); ++k) at[k] += chords[k].t1 == next ? 1 : 0;
      t = next;
    }
    return true;
  }

  const ReplayCounts& counts() const { return counts_; }

 private:
  static constexpr int most_cuts = 24;

  bool boxes_apart(const Stencil& s, double eta) const {
    Vector<Dim> low[2], high[2];
    for (std::size_t k = 0; k < s.size(); ++k) {
      const std::size_t side = k < s.first() ? 0 : 1;
      const VertexId v = s.vertices[k];
      const bool fresh = k == 0 || k == s.first();
      low[side] = fresh ? low_[v] : Vector<Dim>(low[side].cwiseMin(low_[v]));
      high[side] = fresh ? high_[v] : Vector<Dim>(high[side].cwiseMax(high_[v]));
    }
    const double need = (eta + error_) * (1 + 0x1p-40);
    return (low[0] - high[1]).maxCoeff() > need || (low[1] - high[0]).maxCoeff() > need;
  }

  /// The last chord that begins at or before t.
  static std::size_t chord_after(const Track<Dim>& track, double t) {
    const auto after =
        std::upper_bound(track.begin(), track.end(), t, [](double time, const auto& b) { return time < b.t; });
    return static_cast<std::size_t>(after - track.begin()) - 1;
  }

  static MotionSegment<Dim> chord(const Track<Dim>& track, std::size_t k) {
    return {track[k].t, track[k + 1].t, track[k].x, track[k + 1].x};
  }

  bool piece_farther(const Stencil& s, std::span<const MotionSegment<Dim>> chords, double begin, double end, double eta,
                     Vector<Dim>& n, int cuts) {
    const auto x0 = places(chords, begin), x1 = places(chords, end);
    const double need = (eta + error_) * (1 + 0x1p-40);
    if (take(std::min(gap(s, x0, n), gap(s, x1, n)), need, eta)) return true;
    const double middle = begin + 0.5 * (end - begin);
    for (const double t : {middle, begin, end}) {
      const auto x = places(chords, t);
      const Closest<Dim> c = closest<Dim>(s.kind, std::span<const Vector<Dim>>(x.data(), s.size()));
      if (!(c.distance() > 0)) break;
      n = c.r / c.distance();
      if (take(std::min(gap(s, x0, n), gap(s, x1, n)), need, eta)) return true;
    }
    if (cuts == 0 || !(begin < middle && middle < end)) {
      ++counts_.exact;
      return !comes_within<Dim>(s.kind, chords, begin, end, eta);
    }
    return piece_farther(s, chords, begin, middle, eta, n, cuts - 1) &&
           piece_farther(s, chords, middle, end, eta, n, cuts - 1);
  }

  bool take(double gap, double need, double eta) {
    if (!(gap > need)) return false;
    if (gap < 2 * eta) ++counts_.near;
    counts_.least = std::min(counts_.least, gap / eta - 1);
    return true;
  }

  static std::array<Vector<Dim>, 4> places(std::span<const MotionSegment<Dim>> chords, double t) {
    std::array<Vector<Dim>, 4> x;
    for (std::size_t k = 0; k < chords.size(); ++k) x[k] = chords[k].at(t);
    return x;
  }

  static double gap(const Stencil& s, const std::array<Vector<Dim>, 4>& x, const Vector<Dim>& n) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < s.first(); ++i) {
      for (std::size_t j = s.first(); j < s.size(); ++j) least = std::min(least, n.dot(x[i] - x[j]));
    }
    return least;
  }

  const std::vector<Track<Dim>>& tracks_;
  std::vector<Vector<Dim>> low_, high_;  ///< of each track
  double error_ = 0;
  ReplayCounts counts_;
};

}  // namespace noli::certificates::test
