// SPDX-License-Identifier: Apache-2.0
#include "hulls.h"

#include <gmpxx.h>

#include <algorithm>
#include <array>

namespace noli::testing {

namespace {

using Vector = std::array<mpq_class, 3>;

Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

mpq_class dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

bool is_zero(const Vector& a) { return a[0] == 0 && a[1] == 0 && a[2] == 0; }

Vector difference(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

bool on_segment(const Vector& a, const Vector& b) { return is_zero(cross(a, b)) && dot(a, b) <= 0; }

/// Whether the origin is in a triangle that is not degenerate.
bool on_triangle(const Vector& a, const Vector& b, const Vector& c) {
  const Vector n = cross(difference(b, a), difference(c, a));
  if (is_zero(n) || dot(n, a) != 0) return false;
  return dot(n, cross(a, b)) >= 0 && dot(n, cross(b, c)) >= 0 && dot(n, cross(c, a)) >= 0;
}

int side(const Vector& a, const Vector& b, const Vector& c) { return sgn(dot(a, cross(b, c))); }

/// Whether the origin is in the interior of a tetrahedron.
bool in_tetrahedron(const Vector& a, const Vector& b, const Vector& c, const Vector& d) {
  const int s = side(a, b, c);
  return s != 0 && side(a, c, d) == s && side(a, d, b) == s && side(b, d, c) == s;
}

bool origin_in_hull(const std::vector<Vector>& d) {
  for (std::size_t i = 0; i < d.size(); ++i) {
    if (is_zero(d[i])) return true;
    for (std::size_t j = 0; j < i; ++j) {
      if (on_segment(d[i], d[j])) return true;
      for (std::size_t k = 0; k < j; ++k) {
        if (on_triangle(d[i], d[j], d[k])) return true;
        for (std::size_t l = 0; l < k; ++l) {
          if (in_tetrahedron(d[i], d[j], d[k], d[l])) return true;
        }
      }
    }
  }
  return false;
}

/// Whether all of p are above all of q along some axis.
bool above_on_an_axis(const std::vector<Position>& p, const std::vector<Position>& q) {
  for (std::size_t k = 0; k < 3; ++k) {
    const auto less = [k](const Position& a, const Position& b) { return a[k] < b[k]; };
    if ((*std::min_element(p.begin(), p.end(), less))[k] > (*std::max_element(q.begin(), q.end(), less))[k])
      return true;
  }
  return false;
}

}  // namespace

bool hulls_meet(const std::vector<Position>& p, const std::vector<Position>& q) {
  if (p.empty() || q.empty() || above_on_an_axis(p, q) || above_on_an_axis(q, p)) return false;
  std::vector<Vector> differences;
  for (const Position& a : p) {
    for (const Position& b : q) {
      differences.push_back({mpq_class(a[0]) - b[0], mpq_class(a[1]) - b[1], mpq_class(a[2]) - b[2]});
    }
  }
  return origin_in_hull(differences);
}

}  // namespace noli::testing
