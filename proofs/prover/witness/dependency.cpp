// SPDX-License-Identifier: Apache-2.0
#include "proofs/prover/witness/dependency.h"

namespace noli::witness {

namespace {

using Matrix = std::vector<std::vector<Polynomial>>;  ///< by row

/// The matrix without row 0 and one column.
Matrix minor_of(const Matrix& matrix, std::size_t column) {
  Matrix smaller(matrix.begin() + 1, matrix.end());
  for (auto& row : smaller) row.erase(row.begin() + static_cast<std::ptrdiff_t>(column));
  return smaller;
}

Polynomial determinant(const Matrix& matrix) {
  if (matrix.empty()) return distance::constant(Integer(1));
  Polynomial all;
  for (std::size_t c = 0; c < matrix.size(); ++c) {
    const Polynomial term = matrix[0][c] * determinant(minor_of(matrix, c));
    c % 2 == 0 ? all += term : all -= term;
  }
  return all;
}

/// Numbers, one per point, that add up to 0, and still do so when multiplied by any of these coordinates of the points.
std::vector<Polynomial> affine_dependency(const std::vector<PolynomialPosition>& points,
                                          const std::vector<std::size_t>& coordinates) {
  Matrix rows = {
      {}, std::vector<Polynomial>(points.size(), distance::constant(Integer(1)))};  // row 0 is left out of each minor
  for (const std::size_t k : coordinates) {
    auto& row = rows.emplace_back();
    for (const PolynomialPosition& x : points) row.push_back(x[k]);
  }
  std::vector<Polynomial> numbers;
  for (std::size_t c = 0; c < points.size(); ++c) {
    const Polynomial minor = determinant(minor_of(rows, c));
    numbers.push_back(c % 2 == 0 ? minor : Polynomial() - minor);
  }
  return numbers;
}

/// A polynomial that vanishes when the dependency holds in the other coordinates too.
Polynomial condition_of(const std::vector<PolynomialPosition>& points, const std::vector<std::size_t>& coordinates,
                        const std::vector<Polynomial>& numbers) {
  Polynomial common;
  for (std::size_t k = 0; k < 3; ++k) {
    if (std::ranges::find(coordinates, k) != coordinates.end()) continue;
    Polynomial off;
    for (std::size_t i = 0; i < points.size(); ++i) off += numbers[i] * points[i][k];
    common = gcd(common, off);
  }
  return common;
}

/// All choices of `count` of the three coordinates; `count` is at most two.
std::vector<std::vector<std::size_t>> choices(std::size_t count) {
  if (count == 0) return {{}};
  if (count == 1) return {{0}, {1}, {2}};
  return {{0, 1}, {0, 2}, {1, 2}};
}

}  // namespace

std::vector<FeatureSides> parts_of(const FeatureSides& features, std::size_t most) {
  std::vector<FeatureSides> parts;
  for (unsigned m = 1; m < 1U << features.p.size(); ++m) {
    for (unsigned n = 1; n < 1U << features.q.size(); ++n) {
      FeatureSides part{chosen(features.p, m), chosen(features.q, n)};
      const bool disjoint = std::ranges::find_first_of(part.p, part.q) == part.p.end();
      if (disjoint && part.p.size() + part.q.size() <= most) parts.push_back(std::move(part));
    }
  }
  std::ranges::stable_sort(parts, std::greater{}, [](const FeatureSides& s) { return s.p.size() + s.q.size(); });
  return parts;
}

bool any_dependency(const FeatureSides& features, const std::function<PolynomialPosition(VertexId)>& position,
                    const std::function<bool(Dependency)>& take) {
  for (const FeatureSides& sides : parts_of(features, 4)) {
    std::vector<PolynomialPosition> points;
    for (const VertexId v : sides.both()) points.push_back(position(v));
    for (const auto& coordinates : choices(points.size() - 2)) {
      Dependency d{sides, affine_dependency(points, coordinates), {}};
      d.condition = condition_of(points, coordinates, d.weights);
      for (std::size_t i = sides.p.size(); i < points.size(); ++i) d.weights[i] = Polynomial() - d.weights[i];
      if (take(std::move(d))) return true;
    }
  }
  return false;
}

}  // namespace noli::witness
