// SPDX-License-Identifier: Apache-2.0
#include "trajectory/sample.h"

#include <algorithm>
#include <cmath>

namespace noli {
namespace {

/// Where t lies between a (0) and b (1). Precondition: a <= t <= b, a < b.
double fraction(double a, double b, double t) {
  if (std::isfinite(b - a)) return (t - a) / (b - a);
  return (t / 2 - a / 2) / (b / 2 - a / 2);
}

/// Always between a and b, despite rounding.
double between(double a, double b, double s) { return std::clamp(std::lerp(a, b, s), std::min(a, b), std::max(a, b)); }

}  // namespace

Position sample_between(const Position& a, const Position& b, double s) {
  return {between(a[0], b[0], s), between(a[1], b[1], s), between(a[2], b[2], s)};
}

Position sample(const WorldLines& lines, VertexId v, double t) {
  const std::size_t k = lines.segment_at(v, t);
  const auto times = lines.times(v);
  const Position &a = lines.positions(v)[k], &b = lines.positions(v)[k + 1];
  if (t == times[k]) return a;
  if (t == times[k + 1]) return b;
  return sample_between(a, b, fraction(times[k], times[k + 1], t));
}

std::vector<Position> sample(const WorldLines& lines, double t) {
  std::vector<Position> positions(lines.vertex_count());
  for (VertexId v = 0; v < positions.size(); ++v) positions[v] = sample(lines, v, t);
  return positions;
}

}  // namespace noli
