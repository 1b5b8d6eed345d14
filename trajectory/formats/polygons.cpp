// SPDX-License-Identifier: Apache-2.0
#include "trajectory/formats/polygons.h"

#include <fmt/format.h>
#include <gmpxx.h>

#include <array>
#include <cmath>
#include <limits>

namespace noli {
namespace {

/// The plane through a, b and c, and a corner d.
struct Height {
  const Position &a, &b, &c, &d;
};

bool in_plane_of_axes(const Height& h) {
  for (std::size_t k = 0; k < 3; ++k) {
    if (h.a[k] == h.b[k] && h.b[k] == h.c[k] && h.c[k] == h.d[k]) return true;
  }
  return false;
}

/// Whether floating-point arithmetic can prove that the height is at most `limit`. The determinant is within 2^-50 of
/// the size of its terms, the square of the normal within 2^-48; underflow adds less than 2^-600 in this range.
bool surely_at_most(const Height& h, double limit) {
  Position u{}, v{}, w{};
  for (std::size_t k = 0; k < 3; ++k) {
    u[k] = h.b[k] - h.a[k];
    v[k] = h.c[k] - h.a[k];
    w[k] = h.d[k] - h.a[k];
  }
  double det = 0, size = 0, normal = 0, normal_size = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
    const double n = u[i] * v[j] - u[j] * v[i], n_size = std::fabs(u[i] * v[j]) + std::fabs(u[j] * v[i]);
    det += n * w[k];
    size += n_size * std::fabs(w[k]);
    normal += n * n;
    normal_size += n_size * n_size;
  }
  const double reach = std::fabs(w[0]) + std::fabs(w[1]) + std::fabs(w[2]);
  const bool in_range = limit > 0x1p-200 && reach < 0x1p400 && normal_size < 0x1p400 && normal_size > 0x1p-400;
  if (!in_range) return false;
  const double least_normal = normal - 0x1p-44 * normal_size;
  const double most = std::fabs(det) + 0x1p-48 * size + 0x1p-600;
  return least_normal > 0 && most < 0.999 * limit * std::sqrt(least_normal);
}

/// sqrt(numerator / denominator), rounded up. Precondition: both are positive.
double root_rounded_up(const mpq_class& square) {
  mpf_class approximation(square, 256);
  approximation = sqrt(approximation);
  if (approximation > std::numeric_limits<double>::max()) return std::numeric_limits<double>::infinity();
  const auto too_small = [&](double x) { return mpq_class(x) * mpq_class(x) < square; };
  double x = approximation.get_d();  // truncated
  while (std::isfinite(x) && too_small(x)) x = std::nextafter(x, std::numeric_limits<double>::infinity());
  while (x > 0 && !too_small(std::nextafter(x, 0))) x = std::nextafter(x, 0);
  return x;
}

double exact_height(const Height& h) {
  std::array<mpq_class, 3> u, v, w, n;
  for (std::size_t k = 0; k < 3; ++k) {
    const mpq_class a(h.a[k]);
    u[k] = mpq_class(h.b[k]) - a;
    v[k] = mpq_class(h.c[k]) - a;
    w[k] = mpq_class(h.d[k]) - a;
  }
  mpq_class det, normal;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
    n[k] = u[i] * v[j] - u[j] * v[i];
    det += n[k] * w[k];
    normal += n[k] * n[k];
  }
  if (det == 0) return 0;
  return root_rounded_up(det * det / normal);
}

double larger_height(const Height& h, double at_least) {
  if (in_plane_of_axes(h) || surely_at_most(h, at_least)) return at_least;
  return std::fmax(at_least, exact_height(h));
}

// --- Areas -----------------------------------------------------------------------------------------------------------

/// Whether floating-point arithmetic can prove that u v - w x is not zero. Precondition: u, v, w, x are differences of
/// doubles, rounded once. Each product is then within 4 units of 2^-53 of the exact one. So a result larger than 2^-40
/// of the products' sizes has the right sign, if nothing underflowed.
bool surely_not_zero(double u, double v, double w, double x) {
  const double size = std::fabs(u * v) + std::fabs(w * x);
  return size > 0x1p-900 && size < 0x1p1000 && std::fabs(u * v - w * x) > 0x1p-40 * size;
}

/// One component of (b - a) x (c - a), the one without coordinate 3 - i - j.
bool component_is_zero(const Position& a, const Position& b, const Position& c, std::size_t i, std::size_t j) {
  if (surely_not_zero(b[i] - a[i], c[j] - a[j], b[j] - a[j], c[i] - a[i])) return false;
  const mpq_class ai(a[i]), aj(a[j]);
  const mpq_class left = (mpq_class(b[i]) - ai) * (mpq_class(c[j]) - aj);
  const mpq_class right = (mpq_class(b[j]) - aj) * (mpq_class(c[i]) - ai);
  return left == right;
}

}  // namespace

std::string polygons_note(std::size_t count, const std::string& where, double non_planarity) {
  return fmt::format(
      "{} polygon{} of more than three corners {} cut into fans of triangles; largest non-planarity in {}: {}", count,
      count == 1 ? "" : "s", count == 1 ? "is" : "are", where, non_planarity);
}

std::string refused_polygon(std::size_t corners) {
  return fmt::format(
      "a face of {} corners; expected triangles (--polygons refuse): cut it into triangles, in all frames alike, or "
      "pass "
      "--polygons fan",
      corners);
}

double largest_non_planarity(const Mesh& mesh, std::span<const Fan> fans, std::span<const Position> positions,
                             double at_least) {
  const auto x = [&](VertexId v) -> const Position& { return positions[v]; };
  for (const Fan& fan : fans) {
    const auto triangles = std::span(mesh.faces).subspan(fan.first, fan.count);
    std::size_t base = 0;
    while (base < fan.count && has_zero_area(x(triangles[base][0]), x(triangles[base][1]), x(triangles[base][2]))) {
      ++base;
    }
    if (base == fan.count) continue;  // there is no plane
    const auto& [a, b, c] = triangles[base];
    // Corners before the base may be outside its plane too, if others coincide.
    for (std::size_t i = 0; i < fan.count; ++i) {
      if (i != base) at_least = larger_height({x(a), x(b), x(c), x(triangles[i][2])}, at_least);
      if (i == 0 && base != 0) at_least = larger_height({x(a), x(b), x(c), x(triangles[i][1])}, at_least);
    }
  }
  return at_least;
}

bool has_zero_area(const Position& a, const Position& b, const Position& c) {
  return component_is_zero(a, b, c, 0, 1) && component_is_zero(a, b, c, 1, 2) && component_is_zero(a, b, c, 2, 0);
}

}  // namespace noli
