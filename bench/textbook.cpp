// SPDX-License-Identifier: Apache-2.0
#include "noli/bench/textbook.h"

#include <array>
#include <cmath>
#include <utility>

namespace noli::bench {
namespace {

struct Vec {
  double x, y, z;
};

inline Vec operator+(const Vec& a, const Vec& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vec operator-(const Vec& a, const Vec& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vec operator*(double s, const Vec& a) { return {s * a.x, s * a.y, s * a.z}; }
inline double dot(const Vec& a, const Vec& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vec cross(const Vec& a, const Vec& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// A difference of two points of the query, and how it changes from the beginning of the step to its end.
struct Difference {
  Vec at_t0, change;
  Vec at(double t) const { return at_t0 + t * change; }
};

inline Vec vec(const Point3& a) { return {a[0], a[1], a[2]}; }

template <class Query>
inline Difference difference(const Query& query, std::size_t to, std::size_t from) {
  const Vec at_t0 = vec(query.x_t0[to]) - vec(query.x_t0[from]);
  const Vec at_t1 = vec(query.x_t1[to]) - vec(query.x_t1[from]);
  return {at_t0, at_t1 - at_t0};
}

struct Cubic {
  std::array<double, 4> c;
  double at(double t) const { return ((c[3] * t + c[2]) * t + c[1]) * t + c[0]; }
  double slope(double t) const { return (3 * c[3] * t + 2 * c[2]) * t + c[1]; }
};

inline Cubic coplanarity(const Difference& p, const Difference& q, const Difference& r) {
  const Vec n0 = cross(q.at_t0, r.at_t0), n2 = cross(q.change, r.change);
  const Vec n1 = cross(q.at_t0, r.change) + cross(q.change, r.at_t0);
  return {{dot(p.at_t0, n0), dot(p.change, n0) + dot(p.at_t0, n1), dot(p.change, n1) + dot(p.at_t0, n2),
           dot(p.change, n2)}};
}

/// At most four ends of monotone pieces, or at most as many roots.
struct Times {
  std::array<double, 4> t;
  int count = 0;
  void add(double x) { t[static_cast<std::size_t>(count++)] = x; }
  double operator[](int i) const { return t[static_cast<std::size_t>(i)]; }
};

/// 0, the zeros of the slope inside (0, 1) in ascending order, and 1.
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

/// Calls inside(t) at the roots of f in [0, 1] in ascending order until one of them says yes. Of a piece on which f is
/// zero at both ends it takes the left one.
template <class Inside>
inline bool any_root(const Cubic& f, Inside&& inside) {
  const Times ends = monotone_pieces(f);
  double value = f.at(0);
  for (int i = 0; i + 1 < ends.count; ++i) {
    const bool last = i + 2 == ends.count;
    const double next = f.at(ends[i + 1]);
    if (value == 0) {
      if (inside(ends[i])) return true;
    } else if (next == 0) {
      if (last && inside(ends[i + 1])) return true;
    } else if ((value < 0) != (next < 0)) {
      if (inside(bracketed_root(f, ends[i], ends[i + 1], value < 0))) return true;
    }
    value = next;
  }
  return false;
}

/// d in the directions a and b, in the least-squares sense: d ~ u a + w b. Not numbers when a and b are parallel.
struct Weights {
  double u, w;
};

inline Weights weights(const Vec& a, const Vec& b, const Vec& d) {
  const double aa = dot(a, a), ab = dot(a, b), bb = dot(b, b), ad = dot(a, d), bd = dot(b, d);
  const double determinant = aa * bb - ab * ab;
  return {(ad * bb - ab * bd) / determinant, (bd * aa - ab * ad) / determinant};
}

}  // namespace

bool textbook_meet(const VertexFace3& query) {
  const Difference p = difference(query, 1, 0), q = difference(query, 2, 0), r = difference(query, 3, 0);
  return any_root(coplanarity(p, q, r), [&](double t) {
    const Vec corner = p.at(t);
    const auto [u, w] = weights(q.at(t) - corner, r.at(t) - corner, -1.0 * corner);
    return u >= 0 && w >= 0 && u + w <= 1;
  });
}

bool textbook_meet(const EdgeEdge3& query) {
  const Difference p = difference(query, 1, 0), q = difference(query, 3, 2), r = difference(query, 2, 0);
  return any_root(coplanarity(p, q, r), [&](double t) {
    const auto [u, w] = weights(p.at(t), q.at(t), r.at(t));
    return u >= 0 && u <= 1 && w <= 0 && w >= -1;
  });
}

}  // namespace noli::bench
