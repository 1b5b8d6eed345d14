// SPDX-License-Identifier: Apache-2.0
//
// The times at which four points that move linearly are coplanar, in double precision: the roots of a cubic in [0, 1].
// Provot 1997, "Collision and self-collision handling in cloth model dedicated to design garments", section 3.
//
// Notation
//   p, q, r    three differences of the query's points that are linearly dependent when the four points are coplanar;
//              p(t) = p + t dp, ...
//   c          det(p(t), q(t), r(t)) = c[0] + c[1] t + c[2] t^2 + c[3] t^3
// The paper solves the cubic in closed form. Here it is cut at its critical points, and on each monotone piece that
// changes sign Newton's iteration, safeguarded by bisection, finds the root.
//
// What this does not do: find a root where the cubic does not change its sign (four points that are coplanar throughout
// have no roots here but at 0 or 1), or bound the error of a root.
#pragma once

#include "points.h"

namespace noli::plugins {

/// A difference of two points, and how it changes from the beginning of the step to its end.
struct Difference {
  Vec at_t0, change;
  Vec at(double t) const { return at_t0 + t * change; }
};

inline Difference difference(const Points& x_t0, const Points& x_t1, std::size_t to, std::size_t from) {
  const Vec at_t0 = x_t0[to] - x_t0[from], at_t1 = x_t1[to] - x_t1[from];
  return {at_t0, at_t1 - at_t0};
}

struct Cubic {
  std::array<double, 4> c;
  double at(double t) const { return ((c[3] * t + c[2]) * t + c[1]) * t + c[0]; }
  double slope(double t) const { return (3 * c[3] * t + 2 * c[2]) * t + c[1]; }
};

/// p, q, r of a query: the vertex seen from f0 and the face's edges there; or two edges and what lies between them.
struct Differences {
  Difference p, q, r;

  Differences(int kind, const Points& x_t0, const Points& x_t1)
      : p(difference(x_t0, x_t1, 1, 0)),
        q(kind == NOLI_CCD_EDGE_EDGE ? difference(x_t0, x_t1, 3, 2) : difference(x_t0, x_t1, 2, 0)),
        r(kind == NOLI_CCD_EDGE_EDGE ? difference(x_t0, x_t1, 2, 0) : difference(x_t0, x_t1, 3, 0)) {}

  Cubic coplanarity() const {
    const Vec n0 = cross(q.at_t0, r.at_t0), n2 = cross(q.change, r.change);
    const Vec n1 = cross(q.at_t0, r.change) + cross(q.change, r.at_t0);
    return {{dot(p.at_t0, n0), dot(p.change, n0) + dot(p.at_t0, n1), dot(p.change, n1) + dot(p.at_t0, n2),
             dot(p.change, n2)}};
  }
};

/// At most four times in ascending order.
class Times {
 public:
  void add(double t) { t_[count_++] = t; }
  std::size_t count() const { return count_; }
  double operator[](std::size_t i) const { return t_[i]; }

 private:
  std::array<double, 4> t_{};
  std::size_t count_ = 0;
};

/// 0, the zeros of the slope inside (0, 1), and 1.
inline Times monotone_pieces(const Cubic& f) {
  Times ends;
  ends.add(0);
  const double a = 3 * f.c[3], b = 2 * f.c[2], c = f.c[1];
  const double discriminant = b * b - 4 * a * c;
  if (a != 0 && discriminant > 0) {
    const double q = -0.5 * (b + std::copysign(std::sqrt(discriminant), b));
    double low = q / a, high = q != 0 ? c / q : low;
    if (low > high) std::swap(low, high);
    if (low > 0 && low < 1) ends.add(low);
    if (high > 0 && high < 1 && high != low) ends.add(high);
  } else if (a == 0 && b != 0) {
    const double x = -c / b;
    if (x > 0 && x < 1) ends.add(x);
  }
  ends.add(1);
  return ends;
}

/// The root of f on [low, high], where it is monotone and its signs at the ends differ: Newton, and bisection where
/// Newton leaves.
inline double bracketed_root(const Cubic& f, double low, double high, bool rising) {
  double x = 0.5 * (low + high);
  for (int step = 0; step < 100 && high - low > 1e-16; ++step) {
    const double value = f.at(x);
    if (value == 0) break;
    ((value < 0) == rising ? low : high) = x;
    double next = x - value / f.slope(x);
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    if (next == x) break;
    x = next;
  }
  return x;
}

/// Calls inside(t) at the roots of f in [0, 1] in ascending order until one of them says yes, which is returned; a
/// negative number if none does. Of a piece on which f is zero at both ends it takes the left one.
template <class Inside>
inline double first_root(const Cubic& f, Inside&& inside) {
  const Times ends = monotone_pieces(f);
  double value = f.at(0);
  for (std::size_t i = 0; i + 1 < ends.count(); ++i) {
    const bool last = i + 2 == ends.count();
    const double next = f.at(ends[i + 1]);
    double root = -1;
    if (value == 0) {
      root = ends[i];
    } else if (next == 0) {
      if (last) root = ends[i + 1];
    } else if ((value < 0) != (next < 0)) {
      root = bracketed_root(f, ends[i], ends[i + 1], value < 0);
    }
    if (root >= 0 && inside(root)) return root;
    value = next;
  }
  return -1;
}

}  // namespace noli::plugins
