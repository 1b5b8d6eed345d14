// SPDX-License-Identifier: Apache-2.0
//
// Root parity: Brochu, Edwards and Bridson 2012, "Efficient geometrically exact continuous collision detection",
// sections 3 and 4, in floating point.
//
// Notation
//   F         maps times and weights to what lies between the two points of the features; a contact is a zero of F. Its
//             domain is a prism (vertex-face) or a cube (edge-edge), whose boundary F maps to flat pieces (t = 0 and
//             t = 1) and bilinear patches
//   parity    a ray from 0 crosses the image of the boundary as often, modulo 2, as F has zeros
//   lambda    barycentric coordinates of 0 in the tetrahedron of a patch's corners, up to a common factor
//   phi       lambda00 lambda11 - lambda10 lambda01; its sign tells on which side of the patch 0 is. On the way out of
//             the tetrahedron on the other side, a ray crosses the patch as often as the two faces there
//
// What was not done: the exact arithmetic (intervals, then expansions); here a sign is that of a double. A patch that
// lies in a plane with 0 has an equation of its own here, which rounding can make wrong too.
//
// What this does not do: find an even number of contacts, which is its nature (a feature that passes through and comes
// back), or contacts throughout the step; nor does it know times. A ray that meets an edge is replaced by another one;
// when that happens too often, the query fails.
#include "points.h"

namespace {

using namespace noli::plugins;

enum class Crossing { no, yes, on, unclear };

int sign(double x) { return (x > 0) - (x < 0); }

bool equal(const Vec& a, const Vec& b) { return a.x == b.x && a.y == b.y && a.z == b.z; }

/// The determinant, which rounding makes of two equal vectors something else than 0 now and then. Points that do not
/// move make many of these.
double volume(const Vec& a, const Vec& b, const Vec& c) {
  return equal(a, b) || equal(b, c) || equal(c, a) ? 0 : determinant(a, b, c);
}

/// Whether 0 is on the line through a and b, or a or b is 0.
bool parallel(const Vec& a, const Vec& b) {
  const Vec n = cross(a, b);
  return n.x == 0 && n.y == 0 && n.z == 0;
}

/// The ray from 0 in direction `ray`, and a triangle; `side` is the sign of determinant(a, b, c).
Crossing crossing(const Vec& ray, const Vec& a, const Vec& b, const Vec& c, int side) {
  const std::array<std::array<Vec, 2>, 3> edges = {{{a, b}, {b, c}, {c, a}}};
  int sum = 0;
  bool zero = false;
  for (const auto& [from, to] : edges) {
    if (parallel(from, to)) return dot(from, to) <= 0 ? Crossing::on : Crossing::no;
    const int s = sign(determinant(ray, from, to));
    sum += s;
    zero = zero || s == 0;
  }
  if (zero) return std::abs(sum) == 2 || sum == 0 ? Crossing::unclear : Crossing::no;
  if (std::abs(sum) != 3) return Crossing::no;
  if (side == 0) return Crossing::on;
  return side * sum > 0 ? Crossing::yes : Crossing::no;
}

// --- patches in a plane with 0 ---------------------------------------------------------------------------------------

struct Plane {
  double x, y;
};

double wedge(const Plane& a, const Plane& b) { return a.x * b.y - a.y * b.x; }
double inner(const Plane& a, const Plane& b) { return a.x * b.x + a.y * b.y; }
Plane along(const Plane& a, const Plane& b, double v) { return {a.x + v * b.x, a.y + v * b.y}; }

/// Whether a + u e is 0 for some u in [0, 1].
bool segment_has_zero(const Plane& a, const Plane& e) {
  const double length2 = inner(e, e), u = -inner(a, e);
  return length2 > 0 ? u >= 0 && u <= length2 : a.x == 0 && a.y == 0;
}

/// Whether a + u e + v f + u v g is 0 for some u, v in [0, 1].
bool quad_has_zero(const Plane& a, const Plane& e, const Plane& f, const Plane& g) {
  const double c0 = wedge(a, e), c1 = wedge(a, g) + wedge(f, e), c2 = wedge(f, g);
  const auto at = [&](double v) { return v >= 0 && v <= 1 && segment_has_zero(along(a, f, v), along(e, g, v)); };
  if (c2 == 0 && c1 == 0) {
    if (c0 != 0) return false;
    // All in a line with 0: on either side of it, or on one.
    const Plane corners[] = {a, along(a, e, 1), along(a, f, 1), along(along(along(a, e, 1), f, 1), g, 1)};
    for (const Plane& p : corners) {
      for (const Plane& q : corners) {
        if (wedge(p, q) == 0 && inner(p, q) <= 0) return true;
      }
    }
    return false;
  }
  if (c2 == 0) return at(-c0 / c1);
  const double discriminant = c1 * c1 - 4 * c2 * c0;
  if (discriminant < 0) return false;
  const double q = -0.5 * (c1 + std::copysign(std::sqrt(discriminant), c1));
  return at(q / c2) || (q != 0 && at(c0 / q));
}

/// Whether a patch that lies in a plane with 0 contains it: without the coordinate along which the plane is steepest.
bool flat_patch_has_zero(const Vec& p00, const Vec& p10, const Vec& p11, const Vec& p01) {
  Vec n = cross(p11 - p00, p01 - p10);
  for (const auto& [a, b] : {std::array{p00, p10}, std::array{p10, p11}, std::array{p11, p01}, std::array{p01, p00}}) {
    const Vec other = cross(a, b);
    if (dot(other, other) > dot(n, n)) n = other;
  }
  const double x = std::abs(n.x), y = std::abs(n.y), z = std::abs(n.z);
  const auto plane = [&](const Vec& p) -> Plane {
    if (z >= x && z >= y) return {p.x, p.y};
    return y >= x ? Plane{p.z, p.x} : Plane{p.y, p.z};
  };
  return quad_has_zero(plane(p00), plane(p10 - p00), plane(p01 - p00), plane((p00 - p10) + (p11 - p01)));
}

// --- parity ----------------------------------------------------------------------------------------------------------

/// Parity of crossings so far, or why there is none.
class Parity {
 public:
  explicit Parity(const Vec& ray) : ray_(ray) {}

  void triangle(const Vec& a, const Vec& b, const Vec& c) { triangle(a, b, c, sign(volume(a, b, c))); }

  /// The corners in their order around the patch.
  void patch(const Vec& p00, const Vec& p10, const Vec& p11, const Vec& p01) {
    const double l00 = volume(p10, p11, p01), l10 = -volume(p00, p11, p01);
    const double l11 = volume(p00, p10, p01), l01 = -volume(p00, p10, p11);
    if (l00 == 0 && l10 == 0 && l11 == 0 && l01 == 0) {
      on_ = on_ || flat_patch_has_zero(p00, p10, p11, p01);
      return;
    }
    const double least = std::min({l00, l10, l11, l01}), greatest = std::max({l00, l10, l11, l01});
    const bool inside = least >= 0 || greatest <= 0;
    const int side = inside ? sign(l00 * l11 - l10 * l01) : -1;
    if (side == 0) on_ = true;
    if (side > 0) {
      triangle(p10, p11, p01, sign(l00));
      triangle(p00, p10, p01, sign(l11));
    } else {
      triangle(p00, p11, p01, -sign(l10));
      triangle(p00, p10, p11, -sign(l01));
    }
  }

  bool odd() const { return odd_; }
  bool on() const { return on_; }
  bool unclear() const { return unclear_; }

 private:
  void triangle(const Vec& a, const Vec& b, const Vec& c, int side) {
    switch (crossing(ray_, a, b, c, side)) {
      case Crossing::no: break;
      case Crossing::yes: odd_ = !odd_; break;
      case Crossing::on: on_ = true; break;
      case Crossing::unclear: unclear_ = true; break;
    }
  }

  Vec ray_;
  bool odd_ = false, on_ = false, unclear_ = false;
};

void vertex_face(const Points& x, const Points& y, Parity& parity) {
  const std::array<Vec, 3> a = {x[0] - x[1], x[0] - x[2], x[0] - x[3]}, b = {y[0] - y[1], y[0] - y[2], y[0] - y[3]};
  parity.triangle(a[0], a[1], a[2]);
  parity.triangle(b[0], b[1], b[2]);
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t k = (i + 1) % 3;
    parity.patch(a[i], a[k], b[k], b[i]);
  }
}

/// The values of F for weights 00, 10, 11, 01 at one time.
std::array<Vec, 4> corners(const Points& x) { return {x[0] - x[2], x[1] - x[2], x[1] - x[3], x[0] - x[3]}; }

void edge_edge(const Points& x, const Points& y, Parity& parity) {
  const std::array<Vec, 4> a = corners(x), b = corners(y);
  for (const auto& c : {a, b}) {
    parity.triangle(c[0], c[1], c[2]);
    parity.triangle(c[0], c[2], c[3]);
  }
  for (std::size_t i = 0; i < 4; ++i) {
    const std::size_t k = (i + 1) % 4;
    parity.patch(a[i], a[k], b[k], b[i]);
  }
}

/// Some direction, another one for each number.
Vec direction(int number) {
  const double a = 0.37 + 2.39996 * number, z = std::fmod(0.213 + 0.61803 * number, 2.0) - 1, r = std::sqrt(1 - z * z);
  return {r * std::cos(a), r * std::sin(a), z};
}

}  // namespace

extern "C" uint32_t noli_ccd_version() { return NOLI_CCD_VERSION; }

extern "C" int noli_ccd_query(int kind, const double x_t0[12], const double x_t1[12], double /*tolerance*/,
                              double* /*time_of_impact*/) {
  const Points x = points(x_t0), y = points(x_t1);
  for (int number = 0; number < 32; ++number) {
    Parity parity(direction(number));
    kind == NOLI_CCD_EDGE_EDGE ? edge_edge(x, y, parity) : vertex_face(x, y, parity);
    if (parity.on()) return NOLI_CCD_HIT;
    if (!parity.unclear()) return parity.odd() ? NOLI_CCD_HIT : NOLI_CCD_NO_HIT;
  }
  return NOLI_CCD_FAILED;
}
