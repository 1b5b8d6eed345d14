// SPDX-License-Identifier: Apache-2.0
#include "certify/simulate/exact_gap.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include "certificates/closest.h"
#include "certify/queries/any_query.h"
#include "kernel/thickness.h"

namespace noli {
namespace {

constexpr double greatest = std::numeric_limits<double>::max();

template <FeaturePair Pair, int Dim>
class GapSearch {
 public:
  GapSearch(const WorldLines& lines, const std::array<VertexId, 4>& vertices) : lines_(lines), vertices_(vertices) {}

  ExactGap operator()() {
    std::vector<Piece> pieces = find_pieces();
    std::sort(pieces.begin(), pieces.end(), [](const Piece& a, const Piece& b) { return a.farther < b.farther; });
    ExactGap best{greatest, std::numeric_limits<double>::infinity(), 0};
    for (const Piece& piece : pieces) {
      if (piece.farther >= best.above) break;  // neither this nor any later piece is nearer
      improve(best, piece);
    }
    if (!std::isfinite(best.up_to)) throw std::range_error("exact_gap: the distance is not a double");
    return best;
  }

 private:
  static constexpr std::size_t n = point_count(Pair);
  using Motion = MotionQuery<Pair, Dim>;
  using Vector = certificates::Vector<Dim>;
  using Points = std::array<Vector, n>;

  /// `farther`: the features are farther apart than this, unless it is below 0.
  struct Piece {
    Motion motion;
    double farther;
  };

  std::vector<double> times() const {
    std::vector<double> all;
    for (std::size_t i = 0; i < n; ++i) {
      const auto of_vertex = lines_.times(vertices_[i]);
      all.insert(all.end(), of_vertex.begin(), of_vertex.end());
    }
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    return all;
  }

  std::vector<Piece> find_pieces() const {
    const std::vector<double> all = times();
    std::vector<Piece> pieces;
    for (std::size_t i = 1; i < all.size(); ++i) {
      Motion motion;
      motion.begin = all[i - 1];
      motion.end = all[i];
      for (std::size_t k = 0; k < n; ++k) motion.paths[k] = path(vertices_[k], motion.begin);
      pieces.push_back({motion, farther_than(motion)});
    }
    return pieces;
  }

  LinearPath<Dim> path(VertexId v, double begin) const {
    const std::size_t k = lines_.segment_at(v, begin);
    const auto times = lines_.times(v);
    const auto positions = lines_.positions(v);
    LinearPath<Dim> path{times[k], times[k + 1], {}, {}};
    for (std::size_t d = 0; d < Dim; ++d) {
      path.x_t0[d] = positions[k][d];
      path.x_t1[d] = positions[k + 1][d];
    }
    return path;
  }

  /// The points at a time, rounded.
  static Points points_at(const Motion& motion, double t) {
    Points x;
    for (std::size_t k = 0; k < n; ++k) {
      const auto& p = motion.paths[k];
      const double share = (t - p.t0) / (p.t1 - p.t0);
      for (std::size_t d = 0; d < Dim; ++d) x[k][static_cast<int>(d)] = p.x_t0[d] + share * (p.x_t1[d] - p.x_t0[d]);
    }
    return x;
  }

  /// A bound of all rounding of points and of their products with a direction of length 1. Coordinates here are at most
  /// `size` in magnitude; each takes at most four operations, each product six more.
  static double rounding(const Motion& motion) {
    double size = 0;
    for (const auto& p : motion.paths) {
      for (std::size_t d = 0; d < Dim; ++d) size = std::max({size, std::abs(p.x_t0[d]), std::abs(p.x_t1[d])});
    }
    return 0x1p-46 * size + 0x1p-1000;
  }

  static double farther_than(const Motion& motion) {
    const std::array<Points, 2> ends = {points_at(motion, motion.begin), points_at(motion, motion.end)};
    const Points middle = points_at(motion, motion.begin + 0.5 * (motion.end - motion.begin));
    double best = -1;
    for (const Points* x : {&ends[0], &ends[1], &middle}) {
      const Vector r = certificates::closest<Dim>(Pair, std::span<const Vector>(x->data(), n)).r;
      const double length = std::sqrt(r.squaredNorm());
      if (!(length > 0) || !std::isfinite(length)) continue;
      best = std::max(best, least_along(ends, Vector(r / length)) - rounding(motion));
    }
    return best * (1 - 0x1p-40);  // the direction's length is 1 up to rounding
  }

  static double least_along(const std::array<Points, 2>& ends, const Vector& direction) {
    double least = std::numeric_limits<double>::infinity();
    for (const Points& x : ends) {
      for (std::size_t i = 0; i < first_size(Pair); ++i) {
        for (std::size_t j = first_size(Pair); j < n; ++j) least = std::min(least, direction.dot(x[i] - x[j]));
      }
    }
    return least;
  }

  /// Replaces the gap by that of this piece if it is less.
  static void improve(ExactGap& best, const Piece& piece) {
    if (best.above < greatest && !first_within(piece.motion, best.above)) return;
    if (auto at = first_within(piece.motion, 0)) {
      best = {0, 0, time_of(piece.motion, *at)};
      return;
    }
    // Nonnegative doubles have the order of their bits.
    auto low = std::bit_cast<std::uint64_t>(std::max(piece.farther, 0.0));
    const double seen = distance_at_begin(piece.motion) * (1 + 0x1p-30);
    const double start = seen < best.above && first_within(piece.motion, seen) ? seen : best.above;
    auto high = std::bit_cast<std::uint64_t>(start);
    while (high - low > 1) {
      const std::uint64_t middle = low + (high - low) / 2;
      (first_within(piece.motion, std::bit_cast<double>(middle)) ? high : low) = middle;
    }
    const double up_to = std::bit_cast<double>(high);
    best = {std::bit_cast<double>(low), up_to, time_of(piece.motion, *first_within(piece.motion, up_to))};
  }

  /// The distance at the beginning of the piece, rounded.
  static double distance_at_begin(const Motion& motion) {
    const Points x = points_at(motion, motion.begin);
    return certificates::closest<Dim>(Pair, std::span<const Vector>(x.data(), n)).distance();
  }

  static double time_of(const Motion& motion, const TimeOfImpact& s) {
    return motion.begin + s.lower() * (motion.end - motion.begin);
  }

  const WorldLines& lines_;
  const std::array<VertexId, 4>& vertices_;
};

}  // namespace

ExactGap exact_gap(const WorldLines& lines, int dimension, FeaturePair pair, const std::array<VertexId, 4>& vertices) {
  return visit({pair, dimension, {}, {}}, [&]<FeaturePair Pair, int Dim>(const Query<Pair, Dim>&) {
    return GapSearch<Pair, Dim>(lines, vertices)();
  });
}

}  // namespace noli
