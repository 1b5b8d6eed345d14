// SPDX-License-Identifier: Apache-2.0
#include "noli/proofs/prover/monotone.h"

namespace noli {

namespace {

using Vector = std::array<double, 3>;

/// All vectors within `reach` of `middle`, axis by axis.
struct Range {
  Vector middle{}, reach{};
};

Range range_of(const Lanes& low, const Lanes& high, int dimension) {
  Range range;
  for (int k = 0; k < dimension; ++k) {
    const auto i = static_cast<std::size_t>(k);
    const double a = low[k], b = high[k];
    range.middle[i] = 0.5 * (a + b);
    range.reach[i] = 0.5 * (b - a);
  }
  return range;
}

double inner(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

double inner_of_sizes(const Vector& a, const Vector& b) {
  return std::abs(a[0] * b[0]) + std::abs(a[1] * b[1]) + std::abs(a[2] * b[2]);
}

/// s a - t b, times k.
Vector combination(double s, const Vector& a, double t, const Vector& b, double k) {
  Vector c;
  for (std::size_t i = 0; i < 3; ++i) c[i] = (s * a[i] - t * b[i]) * k;
  return c;
}

/// p.f for f in a range, and by how much it may differ, rounding included.
struct Product {
  double value, off;
};

Product product(const Vector& p, const Range& f) {
  return {inner(p, f.middle), inner_of_sizes(p, f.reach) + 0x1p-45 * inner_of_sizes(p, f.middle) + 0x1p-1000};
}

}  // namespace

bool is_monotone(const TangentBox& box, int dimension) {
  const Range u = range_of(box.low_u, box.high_u, dimension), v = range_of(box.low_v, box.high_v, dimension);
  const double uu = inner(u.middle, u.middle), uv = inner(u.middle, v.middle), vv = inner(v.middle, v.middle);
  const double per_area = 1 / (uu * vv - uv * uv);
  const Vector p = combination(vv, u.middle, uv, v.middle, per_area);
  const Vector q = combination(uu, v.middle, uv, u.middle, per_area);
  const Product pu = product(p, u), pv = product(p, v), qu = product(q, u), qv = product(q, v);
  constexpr double more = 1 + 0x1p-40;
  const double a = pu.value - more * pu.off, c = qv.value - more * qv.off;
  const double b = 0.5 * more * (std::abs(pv.value) + pv.off + std::abs(qu.value) + qu.off);
  return a > 0 && c > 0 && a * c > more * (b * b) + 0x1p-1000;
}

}  // namespace noli
