// SPDX-License-Identifier: Apache-2.0
#include "integrator/scene/shapes/place.h"

#include <cmath>

#include "integrator/scene/shapes/turn.h"
#include "trajectory/stop.h"

namespace noli::integrator {
namespace {

/// By its rows.
using Matrix = std::array<Position, 3>;

Position apply(const Matrix& m, const Position& x) {
  Position y{};
  for (std::size_t row = 0; row < 3; ++row) y[row] = m[row][0] * x[0] + m[row][1] * x[1] + m[row][2] * x[2];
  return y;
}

/// The rotation about an axis of length 1, by Rodrigues' formula.
Matrix about_axis(const Position& axis, const CosSin& a) {
  const auto [x, y, z] = axis;
  const double k = 1 - a.cos;
  return {{{a.cos + k * x * x, k * x * y - a.sin * z, k * x * z + a.sin * y},
           {k * x * y + a.sin * z, a.cos + k * y * y, k * y * z - a.sin * x},
           {k * x * z - a.sin * y, k * y * z + a.sin * x, a.cos + k * z * z}}};
}

template <std::size_t N>
std::array<double, N> normalised(std::array<double, N> x) {
  double largest = 0, sum = 0;
  for (const double part : x) largest = std::max(largest, std::abs(part));
  for (double& part : x) part /= largest;  // neither overflow nor underflow below
  for (const double part : x) sum += part * part;
  for (double& part : x) part /= std::sqrt(sum);
  return x;
}

Matrix matrix(std::monostate) { return {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}; }
Matrix matrix(const AxisTurn& turn) { return about_axis(normalised(turn.axis), of_degrees(turn.degrees)); }
Matrix matrix(const Quaternion& quaternion) {
  const auto [w, x, y, z] = normalised(quaternion.parts);
  return {{{1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)},
           {2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)},
           {2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)}}};
}

Position deformed(const Position& rest, const Deform& deform) {
  Position x{deform.stretch[0] * rest[0], deform.stretch[1] * rest[1], deform.stretch[2] * rest[2]};
  if (deform.twist == 0) return x;
  const CosSin a = of_degrees(deform.twist * rest[0]);
  return {x[0], a.cos * x[1] - a.sin * x[2], a.sin * x[1] + a.cos * x[2]};
}

/// The finaliser of SplitMix64 (Steele, Lea, Flood 2014) after one step.
std::uint64_t mix(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15u;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

/// A number drawn evenly from [-1, 1), a multiple of 2^-52.
double even(std::uint64_t bits) { return static_cast<double>(bits >> 11) * 0x1p-52 - 1; }

}  // namespace

std::pair<std::vector<Position>, std::vector<Position>> place(const Shape& shape, const Deform& deform,
                                                              const Transform& transform) {
  std::vector<Position> rest, start;
  const Matrix rotation = std::visit([](const auto& r) { return matrix(r); }, transform.rotate);
  const bool rotated = !std::holds_alternative<std::monostate>(transform.rotate);
  for (const Position& p : shape.positions) {
    end_if_stopped();
    rest.push_back({transform.scale * p[0], transform.scale * p[1], transform.scale * p[2]});
    const Position bent = deformed(rest.back(), deform), turned = rotated ? apply(rotation, bent) : bent;
    start.push_back(
        {turned[0] + transform.translate[0], turned[1] + transform.translate[1], turned[2] + transform.translate[2]});
  }
  return {std::move(rest), std::move(start)};
}

void perturb(std::vector<Position>& positions, double amplitude, std::uint64_t seed, std::size_t body, int dimension) {
  if (amplitude == 0) return;
  const std::uint64_t of_body = mix(mix(seed) ^ body);
  for (std::size_t i = 0; i < positions.size(); ++i) {
    end_if_stopped();
    for (std::size_t axis = 0; axis < static_cast<std::size_t>(dimension); ++axis) {
      positions[i][axis] += amplitude * even(mix(of_body ^ (3 * i + axis)));
    }
  }
}

}  // namespace noli::integrator
