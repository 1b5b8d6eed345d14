// SPDX-License-Identifier: Apache-2.0
//
// Decides by brute force whether two simplices with small integer coordinates meet. They do iff 0 is in the hull of all
// differences of their corners. Then 0 is a convex combination of at most four affinely independent ones
// (Caratheodory). Coordinates above 1000 overflow.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace noli::test {

using Vector = std::array<std::int64_t, 3>;

inline Vector minus(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
inline Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline std::int64_t dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline bool is_zero(const Vector& a) { return a == Vector{}; }

inline bool spanned(const Vector& a, const Vector& b) { return is_zero(cross(a, b)) && dot(a, b) <= 0; }

inline bool spanned(const Vector& a, const Vector& b, const Vector& c) {
  const Vector n = cross(minus(b, a), minus(c, a));
  if (is_zero(n) || dot(n, a) != 0) return false;
  return dot(n, cross(a, b)) >= 0 && dot(n, cross(b, c)) >= 0 && dot(n, cross(c, a)) >= 0;
}

inline bool spanned(const Vector& a, const Vector& b, const Vector& c, const Vector& d) {
  const std::int64_t whole = dot(minus(b, a), cross(minus(c, a), minus(d, a)));
  const std::array<std::int64_t, 4> parts = {dot(b, cross(c, d)), -dot(a, cross(c, d)), dot(a, cross(b, d)),
                                             -dot(a, cross(b, c))};
  if (whole == 0) return false;
  for (const std::int64_t part : parts) {
    if ((whole > 0 && part < 0) || (whole < 0 && part > 0)) return false;
  }
  return true;
}

inline bool zero_in_hull(const std::vector<Vector>& p) {
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (is_zero(p[i])) return true;
    for (std::size_t j = 0; j < i; ++j) {
      if (spanned(p[i], p[j])) return true;
      for (std::size_t k = 0; k < j; ++k) {
        if (spanned(p[i], p[j], p[k])) return true;
        for (std::size_t l = 0; l < k; ++l) {
          if (spanned(p[i], p[j], p[k], p[l])) return true;
        }
      }
    }
  }
  return false;
}

inline bool hulls_meet(const std::vector<Vector>& a, const std::vector<Vector>& b) {
  std::vector<Vector> differences;
  for (const Vector& x : a) {
    for (const Vector& y : b) differences.push_back(minus(x, y));
  }
  return zero_in_hull(differences);
}

}  // namespace noli::test
