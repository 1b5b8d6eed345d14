// SPDX-License-Identifier: Apache-2.0
//
// Inclusion-based continuous collision detection: Wang, Ferguson, Schneider, Jiang, Attene and Panozzo 2021, "A
// large-scale benchmark and an inclusion-based algorithm for continuous collision detection", sections 4 and 5.
//
// Notation
//   F(t, u, v)   what lies between the two points of the features that have parameters u, v at time t; linear in each
//                of the three, so the box around its eight corner values encloses it on a box of parameters (the
//                inclusion function)
//   epsilon      a bound on the rounding error of a corner value
//   delta        the tolerance: a box of parameters whose values lie in a box no wider than this is a contact
// Boxes of parameters are bisected breadth first, level by level, within a level in the order of their first times.
// What encloses no zero is dropped. The answer is the first time of the first box that is small enough and before which
// no other is left; after `most_checks` boxes it is the first time at which any is left, which is safe.
//
// What was not done: minimum separation; the bound epsilon of the paper is replaced by one of ours, linear in the
// greatest coordinate; the direction to bisect is the one along which F changes most on the box, by the changes of F on
// the whole domain. With a tolerance of 0 boxes are bisected until epsilon, or the grid of doubles, ends it.
#include <vector>

#include "points.h"

namespace {

using namespace noli::plugins;

constexpr int most_checks = 1'000'000;
constexpr int deepest = 48;  ///< bisections of one parameter: its ends stay doubles, and so do sums of two

/// [low, low + width] of each of t, u, v.
struct Box {
  std::array<double, 3> low{0, 0, 0}, width{1, 1, 1};
};

/// The range of each coordinate.
struct Range {
  std::array<double, 3> low, high;

  explicit Range(const Vec& x) : low{x.x, x.y, x.z}, high(low) {}
  void add(const Vec& x) {
    const std::array<double, 3> c = {x.x, x.y, x.z};
    for (std::size_t i = 0; i < 3; ++i) {
      low[i] = std::min(low[i], c[i]);
      high[i] = std::max(high[i], c[i]);
    }
  }
  /// Whether it reaches into the cube of this half-width around 0.
  bool meets(double epsilon) const {
    return std::max({low[0], low[1], low[2]}) <= epsilon && std::min({high[0], high[1], high[2]}) >= -epsilon;
  }
  bool within(double epsilon) const {
    return std::min({low[0], low[1], low[2]}) >= -epsilon && std::max({high[0], high[1], high[2]}) <= epsilon;
  }
  double width() const { return std::max({high[0] - low[0], high[1] - low[1], high[2] - low[2]}); }
};

class Search {
 public:
  Search(int kind, const double x_t0[12], const double x_t1[12], double tolerance)
      : edges_(kind == NOLI_CCD_EDGE_EDGE), delta_(tolerance), x_(points(x_t0)), change_(change_of(x_, points(x_t1))) {
    double greatest = 0;
    for (int i = 0; i < 12; ++i) greatest = std::max({greatest, std::abs(x_t0[i]), std::abs(x_t1[i])});
    epsilon_ = std::ldexp(greatest, -46);  // some 70 roundings of at most this size
    find_slopes();
  }

  /// The time of impact; a negative number if there is none.
  double run() {
    std::vector<Box> level = {Box()}, next;
    double found = 2;  // the first time of those boxes that were small enough
    for (int checks = 0; !level.empty(); level.swap(next), next.clear()) {
      std::sort(level.begin(), level.end(), [](const Box& a, const Box& b) { return a.low[0] < b.low[0]; });
      double first = -1;  // the first time of what may enclose a zero at this level
      for (const Box& box : level) {
        if (box.low[0] >= found) break;
        const Range values = range(box);
        ++checks;
        if (!values.meets(epsilon_)) continue;
        const bool is_first = first < 0;
        if (is_first) first = box.low[0];
        if (checks > most_checks) return first;
        const int split = widest(box);
        if (values.width() > delta_ && !values.within(epsilon_) && split >= 0) {
          push_halves(box, static_cast<std::size_t>(split), next);
          continue;
        }
        found = box.low[0];
        if (is_first) return found;
      }
    }
    return found <= 1 ? found : -1;
  }

 private:
  using Corners = std::array<Vec, 4>;

  /// F at this time for u, v = 00, 10, 01, 11 of the box.
  Corners corners(double t, const Box& box) const {
    const Points x = moved(x_, change_, t);
    const double u0 = box.low[1], u1 = u0 + box.width[1], v0 = box.low[2], v1 = v0 + box.width[2];
    if (edges_) {
      const Vec a = x[1] - x[0], b = x[3] - x[2];
      const Vec a0 = x[0] + u0 * a, a1 = x[0] + u1 * a, b0 = x[2] + v0 * b, b1 = x[2] + v1 * b;
      return {a0 - b0, a1 - b0, a0 - b1, a1 - b1};
    }
    const Vec d = x[0] - x[1], f = x[2] - x[1], g = x[3] - x[1];
    const Vec d0 = d - u0 * f, d1 = d - u1 * f, g0 = v0 * g, g1 = v1 * g;
    return {d0 - g0, d1 - g0, d0 - g1, d1 - g1};
  }

  Range range(const Box& box) const {
    const Corners begin = corners(box.low[0], box), end = corners(box.low[0] + box.width[0], box);
    Range result(begin[0]);
    for (const Corners& four : {begin, end}) {
      for (const Vec& x : four) result.add(x);
    }
    return result;
  }

  static double greatest(const Vec& x) { return std::max({std::abs(x.x), std::abs(x.y), std::abs(x.z)}); }

  /// How much F changes at most along each parameter on the whole domain.
  void find_slopes() {
    const Corners begin = corners(0, {}), end = corners(1, {});
    for (std::size_t i = 0; i < 4; ++i) slope_[0] = std::max(slope_[0], greatest(end[i] - begin[i]));
    for (const Corners& c : {begin, end}) {
      slope_[1] = std::max({slope_[1], greatest(c[1] - c[0]), greatest(c[3] - c[2])});
      slope_[2] = std::max({slope_[2], greatest(c[2] - c[0]), greatest(c[3] - c[1])});
    }
  }

  /// The parameter to bisect; -1 if none can be.
  int widest(const Box& box) const {
    int best = -1;
    double most = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const double change = box.width[i] * slope_[i];
      if (change <= most || box.width[i] <= std::ldexp(1.0, -deepest)) continue;
      most = change;
      best = static_cast<int>(i);
    }
    return best;
  }

  void push_halves(Box box, std::size_t split, std::vector<Box>& boxes) const {
    box.width[split] *= 0.5;
    boxes.push_back(box);
    box.low[split] += box.width[split];
    if (edges_ || box.low[1] + box.low[2] <= 1) boxes.push_back(box);  // else outside the face
  }

  bool edges_;
  double delta_, epsilon_ = 0;
  Points x_, change_;
  std::array<double, 3> slope_{};
};

}  // namespace

extern "C" uint32_t noli_ccd_version() { return NOLI_CCD_VERSION; }

extern "C" int noli_ccd_query(int kind, const double x_t0[12], const double x_t1[12], double tolerance,
                              double* time_of_impact) try {
  const double time = Search(kind, x_t0, x_t1, tolerance).run();
  if (time < 0) return NOLI_CCD_NO_HIT;
  *time_of_impact = time;
  return NOLI_CCD_HIT;
} catch (...) {  // no memory
  return NOLI_CCD_FAILED;
}
