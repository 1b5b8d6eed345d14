// SPDX-License-Identifier: Apache-2.0
#include "audit/fuzz/queries/meeting.h"

#include <algorithm>

namespace noli::audit {

namespace {

/// A least step in the floor from the line along `line` to the side on which `to` lies; zero if there is no such side.
Whole least_step(const Whole& line, const Whole& to) {
  const int side = floor_cross(line, to);
  for (const Whole& step : {Whole{1, 0, 0}, Whole{0, 1, 0}, Whole{-1, 0, 0}, Whole{0, -1, 0}}) {
    if (side != 0 && floor_cross(line, step) == side) return step;
  }
  return {};
}

Meeting vertex_face_meeting(Place place, const Ratios& r, const Directions& d) {
  const auto& [p, q] = d;
  switch (place) {
    case Place::inside: {
      const std::int64_t sum = r[0] + r[1] + r[2];
      return {{Whole{}, r[2] * p, r[2] * q, (-r[0]) * p - r[1] * q}, {sum, -r[0], -r[1], -r[2]}};
    }
    case Place::border: return {{Whole{}, (-r[1]) * p, r[0] * p, q}, {r[0] + r[1], -r[0], -r[1], 0}};
    case Place::corner: return {{Whole{}, Whole{}, p, q}, {1, -1, 0, 0}};
    case Place::missed: {
      const Whole step = least_step(p, q);
      if (step == Whole{}) return vertex_face_meeting(Place::outside, r, d);
      return {{Whole{}, step - r[1] * p, step + r[0] * p, step + q}, {}};
    }
    case Place::outside: break;
  }
  if (parallel(p, q)) return {{Whole{}, p, 2 * p, 3 * p}, {}};
  return {{Whole{}, p, p + q, 2 * p + q}, {}};
}

/// Ends of an edge along p that the origin divides as r : s; at its first end for r = 0.
std::array<Whole, 2> edge(std::int64_t r, std::int64_t s, const Whole& p) { return {(-r) * p, s * p}; }

Meeting edges(std::int64_t i, std::int64_t j, std::int64_t k, std::int64_t l, const Directions& d) {
  const auto [a0, a1] = edge(i, j, d.p);
  const auto [b0, b1] = edge(k, l, d.q);
  return {{a0, a1, b0, b1}, {j * (k + l), i * (k + l), -l * (i + j), -k * (i + j)}};
}

Meeting edge_edge_meeting(Place place, const Ratios& r, const Directions& d) {
  const auto& [p, q] = d;
  switch (place) {
    case Place::inside: return edges(r[0], r[1], r[2], r[3], d);
    case Place::border: return edges(0, r[1], r[2], r[3], d);
    case Place::corner: return edges(0, r[1], 0, r[3], d);
    case Place::missed: {
      const Whole step = least_step(q, p);
      if (step == Whole{}) return edge_edge_meeting(Place::outside, r, d);
      const Meeting border = edges(0, r[1], r[2], r[3], d);
      return {{border.x[0] + step, border.x[1] + step, border.x[2], border.x[3]}, {}};
    }
    case Place::outside: break;
  }
  if (parallel(p, q)) return {{p, 2 * p, Whole{}, (-r[3]) * p}, {}};
  return {{r[0] * p, (r[0] + r[1]) * p, (-r[2]) * q, r[3] * q}, {}};
}

Meeting vertex_edge(Place place, const Ratios& r, const Whole& p) {
  const std::int64_t before = place == Place::inside ? r[0] : 0;
  if (place == Place::outside) return {{Whole{}, r[0] * p, (r[0] + r[1]) * p, Whole{}}, {}};
  if (place == Place::missed) {
    const Whole step{p[0] > 0 ? 1 : p[0] < 0 ? -1 : 0, p[1] > 0 ? 1 : p[1] < 0 ? -1 : 0, 0};
    if (step == Whole{}) return vertex_edge(Place::outside, r, p);
    return {{Whole{}, step, r[1] * p + step, Whole{}}, {}};
  }
  const auto [e0, e1] = edge(before, r[1], p);
  return {{Whole{}, e0, e1, Whole{}}, {before + r[1], -r[1], -before, 0}};
}

Meeting vertex_vertex(Place place, const Whole& p) {
  if (place == Place::outside) return {{Whole{}, p, Whole{}, Whole{}}, {}};
  if (place == Place::missed) return {{Whole{}, Whole{1, 0, 0}, Whole{}, Whole{}}, {}};
  return {{}, {1, -1, 0, 0}};
}

}  // namespace

Ratios random_ratios(Random& random) {
  Ratios ratios{};
  for (std::int64_t& ratio : ratios) ratio = random.between(1, 4);
  return ratios;
}

Meeting meeting(const QueryType& type, Place place, const Ratios& ratios, const Directions& directions) {
  switch (type.pair) {
    case FeaturePair::vertex_face: return vertex_face_meeting(place, ratios, directions);
    case FeaturePair::edge_edge: return edge_edge_meeting(place, ratios, directions);
    case FeaturePair::vertex_edge: return vertex_edge(place, ratios, directions.p);
    case FeaturePair::vertex_vertex: break;
  }
  return vertex_vertex(place, directions.p);
}

}  // namespace noli::audit
