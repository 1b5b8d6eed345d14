// SPDX-License-Identifier: Apache-2.0
#include "proofs/prover/windows/monotone.h"

#include "kernel/formula.h"

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

double inner_of_sizes(const Vector& a, const Vector& b) {
  return std::abs(a[0] * b[0]) + std::abs(a[1] * b[1]) + std::abs(a[2] * b[2]);
}

/// s a - t b, times k.
Vector combination(double s, const Vector& a, double t, const Vector& b, double k) {
  Vector c;
  for (std::size_t i = 0; i < 3; ++i) c[i] = (s * a[i] - t * b[i]) * k;
  return c;
}

/// p.f for f in a range, and a bound of its deviation, rounding included.
struct Product {
  double value, off;
};

Product product(const Vector& p, const Range& f) {
  return {formula::dot(p, f.middle), inner_of_sizes(p, f.reach) + 0x1p-45 * inner_of_sizes(p, f.middle) + 0x1p-1000};
}

}  // namespace

Functionals functionals_for(const TangentBox& box, int dimension) {
  const Vector u = range_of(box.low_u, box.high_u, dimension).middle;
  const Vector v = range_of(box.low_v, box.high_v, dimension).middle;
  const double uu = formula::dot(u, u), uv = formula::dot(u, v), vv = formula::dot(v, v),
               per_area = 1 / (uu * vv - uv * uv);
  return {combination(vv, u, uv, v, per_area), combination(uu, v, uv, u, per_area)};
}

Products products(const Functionals& functionals, const TangentBox& box, int dimension) {
  const Range u = range_of(box.low_u, box.high_u, dimension), v = range_of(box.low_v, box.high_v, dimension);
  const Product pu = product(functionals.p, u), pv = product(functionals.p, v);
  const Product qu = product(functionals.q, u), qv = product(functionals.q, v);
  constexpr double more = 1 + 0x1p-40;
  const double b = 0.5 * more * (std::abs(pv.value) + pv.off + std::abs(qu.value) + qu.off);
  // A NaN must not disappear in a comparison.
  if (!std::isfinite(b + pu.value + pu.off + qv.value + qv.off)) return {-1, -1, 0};
  return {pu.value - more * pu.off, qv.value - more * qv.off, b};
}

}  // namespace noli
