// SPDX-License-Identifier: Apache-2.0
#include "audit/fuzz/trajectories/delicate_motions.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "audit/fuzz/queries/recipes.h"
#include "trajectory/cells.h"

namespace noli::audit {

namespace {

constexpr double greatest = std::numeric_limits<double>::max();

using Frame = std::vector<Position>;

double sign(Random& random) { return random.one_in(2) ? 1 : -1; }

/// Uniform in [-1, 1), with all bits.
double anywhere(Random& random) { return 2 * random.unit() - 1; }

Position operator+(const Position& a, const Position& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
Position operator*(double s, const Position& a) { return {s * a[0], s * a[1], s * a[2]}; }

/// A few doubles further; from 0 to something tiny.
double nudged(double x, Random& random) {
  constexpr std::array<double, 6> tiny = {6e-17, 0x1p-53, 0x1p-54, 1e-300, 0x1p-1022, 0x1p-1074};
  const double towards = sign(random) * greatest;
  if (x == 0) return std::copysign(random.one_of(tiny), towards);
  for (std::uint64_t i = 1 + random.below(4); i > 0; --i) x = std::nextafter(x, towards);
  return x;
}

struct Corners {
  Feature p, q;  ///< the two cells
};

/// Axes exchanged and reflected, vertices renamed: what is exact for all doubles.
GeneratedMotion dressed(int dimension, const Corners& cells, const std::vector<Frame>& frames, Random& random) {
  const auto axes = static_cast<std::size_t>(dimension);
  const std::vector<VertexId> to = random_order(axes, random), name = random_order(frames[0].size(), random);
  Position flip = {1, 1, 1};
  for (std::size_t k = 0; k < axes; ++k) flip[k] = sign(random);
  GeneratedMotion made;
  made.motion.format = static_cast<FrameFormat>(random.below(3));
  made.motion.mesh.vertex_count = frames[0].size();
  const bool turned = random.one_in(2);
  for (const Feature* const cell : {turned ? &cells.q : &cells.p, turned ? &cells.p : &cells.q}) {
    Feature renamed;
    for (const VertexId v : *cell) renamed.push_back(name[v]);
    const auto by = static_cast<std::ptrdiff_t>(random.below(renamed.size()));
    std::rotate(renamed.begin(), renamed.begin() + by, renamed.end());
    add_polygon(made.motion.mesh, renamed);
  }
  drop_redundant_cells(made.motion.mesh);
  for (const Frame& frame : frames) {
    Frame& x = made.motion.frames.emplace_back(frame.size(), Position{});
    for (std::size_t v = 0; v < frame.size(); ++v) {
      for (std::size_t k = 0; k < axes; ++k) x[name[v]][to[k]] = flip[k] * frame[v][k] + 0.0;
    }
  }
  const bool flat = made.motion.frames.size() > 2 && made.motion.dimension() != dimension;
  if (flat) made.motion.frames.resize(2);  // by chance: no later frame may leave that plane
  return made;
}

/// P, then Q, so many vertices each.
Corners two_cells(std::size_t first, std::size_t second) {
  Corners cells;
  for (std::size_t v = 0; v < first + second; ++v) (v < first ? cells.p : cells.q).push_back(static_cast<VertexId>(v));
  return cells;
}

// --- last_ulp ---

/// What comes together in the floor at the end: the first `first` of them are of P.
struct InFloor {
  std::size_t first = 1;
  Frame begin, end;
};

InFloor meeting_in_floor(int axes, Random& random) {
  InFloor made;
  if (axes == 1) {
    made.begin = {{-static_cast<double>(random.between(1, 8)), 0, 0}, {random.one_in(2) ? 0. : 3., 0, 0}};
    made.end = {{}, {}};
    return made;
  }
  const auto directions = [](Random& r, int n) {
    return Directions{random_direction(r, n, 8), random_direction(r, n, 8)};
  };
  const Flavour flavour = {directions, 8, 8, any_time};
  const QueryType type{random.one_in(3) ? FeaturePair::vertex_vertex : FeaturePair::vertex_edge, 2};
  const Place place_of_meeting = random.one_of(meeting_places);
  const Ratios ratios = random_ratios(random);
  const Meeting met = meeting(type, place_of_meeting, ratios, directions(random, 1));
  const WholeQuery query = passing(type, met.x, approach(random, type, flavour), {1, 1});
  made.first = first_size(type.pair);
  for (std::size_t i = 0; i < query.size(); ++i) {
    const auto place = [&](const Whole& x) {
      return Position{static_cast<double>(x[0]), static_cast<double>(x[1]), 0};
    };
    made.begin.push_back(place(query.x_t0[i]));
    made.end.push_back(place(query.x_t1[i]));
  }
  return made;
}

/// A vertex that is off the floor, on that side, until it lands in it at the end.
void add_landing(Frame& begin, Frame& end, int axes, double side, Random& random) {
  Position x{}, y{};
  for (std::size_t k = 0; k < static_cast<std::size_t>(axes); ++k) {
    x[k] = static_cast<double>(random.between(-8, 8));
    y[k] = static_cast<double>(random.between(-8, 8));
  }
  x[static_cast<std::size_t>(axes)] = side * static_cast<double>(random.between(1, 8));
  begin.push_back(x);
  end.push_back(y);
}

// --- huge ---

/// A positive number of any size, or near the greatest one.
double size(bool mixed, Random& random) {
  constexpr std::array<int, 6> exponents = {1023, 997, 500, 0, -1000, -1074};
  const int exponent = exponents[random.below(mixed ? exponents.size() : 2)];
  const double mantissa = random.one_in(3) ? 1 : 1 + random.unit();
  return std::ldexp(exponent == -1074 ? std::ceil(8 * mantissa) : mantissa, exponent);
}

double size_of_any_sign(bool mixed, Random& random) {
  const double x = size(mixed, random);
  return random.one_in(2) ? x : -x;
}

/// Points in the floor whose hulls meet around the origin, mostly; heights are 0.
Frame around_origin(const QueryType& type, bool mixed, Random& random) {
  const auto far = [&] { return size(mixed, random); };
  const auto aside = [&] { return random.one_in(2) ? 0 : size_of_any_sign(mixed, random) / 4; };
  switch (type.pair) {
    case FeaturePair::vertex_face: return {{}, {far(), aside(), 0}, {-far(), far(), 0}, {-far(), -far(), 0}};
    case FeaturePair::edge_edge:
      return {{-far(), aside(), 0}, {far(), aside(), 0}, {aside(), -far(), 0}, {aside(), far(), 0}};
    case FeaturePair::vertex_edge: return {{}, {-far(), 0, 0}, {far(), 0, 0}};
    case FeaturePair::vertex_vertex: break;
  }
  return {{}, {}};
}

// --- landing ---

/// A point of the hull of some points, as a simulation would compute it.
Position mixture(const Frame& points, Random& random) {
  std::vector<double> weights;
  double total = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    weights.push_back(random.one_in(2) ? random.unit() : static_cast<double>(random.below(3)));
    total += weights.back();
  }
  if (total == 0) return points[0];
  Position x{};
  for (std::size_t i = 0; i < points.size(); ++i) x = x + (weights[i] / total) * points[i];
  return x;
}

/// What lies below: a point, an edge or a face, in general position or along an axis.
Frame ground(std::size_t vertices, int dimension, Random& random) {
  Frame x(vertices, Position{});
  const bool level = random.one_in(3);
  const double height = anywhere(random);
  for (Position& place : x) {
    for (std::size_t k = 0; k < static_cast<std::size_t>(dimension); ++k) place[k] = anywhere(random);
    if (level) place[static_cast<std::size_t>(dimension - 1)] = height;
  }
  if (dimension == 3 && vertices == 2 && level) x[1][1] = x[0][1];
  return x;
}

}  // namespace

GeneratedMotion last_ulp(Random& random) {
  const int dimension = random.one_in(3) ? 2 : 3, axes = dimension - 1;
  const InFloor met = meeting_in_floor(axes, random);
  const auto split = static_cast<std::ptrdiff_t>(met.first);
  Frame begin(met.begin.begin(), met.begin.begin() + split), end(met.end.begin(), met.end.begin() + split);
  const std::size_t more = random.below(4 - begin.size());
  for (std::size_t i = 0; i < more; ++i) add_landing(begin, end, axes, 1, random);
  const std::size_t first = begin.size();
  begin.insert(begin.end(), met.begin.begin() + split, met.begin.end());
  end.insert(end.end(), met.end.begin() + split, met.end.end());
  const bool alone = random.one_in(6);  // without anything that lands beside them
  const std::size_t least = more == 0 && !alone ? 1 : 0;
  const std::size_t others = std::max<std::size_t>(least, alone ? 0 : random.below(4 - (begin.size() - first)));
  for (std::size_t i = 0; i < others && begin.size() - first < 3; ++i) add_landing(begin, end, axes, -1, random);
  constexpr std::array<double, 5> units = {1, 0x1p-40, 0.1, 1.0 / 3, 1e9};
  const double unit = random.one_of(units);
  for (Frame* const frame : {&begin, &end}) {
    for (Position& x : *frame) x = unit * x;
  }
  for (Position& x : end) {
    for (double& coordinate : std::span(x).first(static_cast<std::size_t>(axes))) {
      if (random.one_in(2)) coordinate = nudged(coordinate, random);
    }
    double& height = x[static_cast<std::size_t>(axes)];
    if (random.one_in(8)) height = nudged(height, random);
  }
  std::vector<Frame> frames = {begin, end};
  if (random.one_in(2)) std::ranges::reverse(frames);
  if (random.one_in(4)) frames.push_back(frames[random.below(2)]);
  return dressed(dimension, two_cells(first, begin.size() - first), frames, random);
}

GeneratedMotion huge(Random& random) {
  const QueryType type = random.one_of(all_query_types);
  const bool mixed = random.one_in(64);  // proofs of such take seconds
  const auto height = static_cast<std::size_t>(type.dimension - 1);
  const Frame floor = around_origin(type, mixed, random);
  const Frame other = random.one_in(2) ? floor : around_origin(type, mixed, random);
  std::vector<Frame> frames = {floor, other};
  const double from = sign(random), to = mixed ? -from : random.one_in(6) ? 0 : random.one_in(4) ? from : -from;
  const bool lies = random.one_in(2);  // Q, in the floor
  for (std::size_t i = 0; i < floor.size(); ++i) {
    const bool above = i < first_size(type.pair);
    for (std::size_t k = 0; k < 2; ++k) {
      double& x = frames[k][i][height];
      x = 0;  // in 2D an edge has something there
      if (above) x = (k == 0 ? from : to) * size(mixed, random);
      if (!above && !lies) x = size_of_any_sign(mixed, random) / 2;
    }
  }
  if (type.pair == FeaturePair::vertex_vertex) {
    Position& x = frames[0][0];
    for (std::size_t k = 0; k < height; ++k) x[k] = size_of_any_sign(mixed, random);
    frames[1] = {random.one_in(2) ? Position{} : -1 * x, {}};
    frames[0][1] = {};
    if (random.one_in(4)) std::swap(frames[0], frames[1]);
  }
  if (random.one_in(4)) frames.push_back(frames[random.below(2)]);
  const std::size_t first = first_size(type.pair);
  return dressed(type.dimension, two_cells(first, floor.size() - first), frames, random);
}

GeneratedMotion landing(Random& random) {
  const QueryType type = random.one_of(all_query_types);
  const auto height = static_cast<std::size_t>(type.dimension - 1);
  const Frame below = ground(second_size(type.pair), type.dimension, random);
  Frame rest = {random.one_in(3) ? random.one_of(std::array{below.front(), below.back()}) : mixture(below, random)};
  if (type.pair == FeaturePair::edge_edge) {  // an edge through that point
    Position along{};
    for (std::size_t k = 0; k < 3; ++k) along[k] = anywhere(random);
    if (random.one_in(2)) along[height] = 0;
    rest = {rest[0] + -random.unit() * along, rest[0] + random.unit() * along};
  }
  const std::size_t touching = rest.size();
  for (std::uint64_t i = random.below(4 - touching); i > 0; --i) {  // the rest of the cell, above it
    Position x = rest[0];
    for (std::size_t k = 0; k < height; ++k) x[k] += anywhere(random);
    x[height] += random.unit() + 1;
    rest.push_back(x);
  }
  const double fall = random.unit() + 0x1p-20, drift = random.one_in(2) ? 0 : anywhere(random);
  Frame start = rest;
  for (Position& x : start) {
    x[height] += fall;
    x[0] += height > 0 ? drift : 0;
  }
  std::vector<Frame> frames = {start};
  for (std::uint64_t n = 1 + random.below(3); n > 0; --n) {
    Frame noisy = rest;
    for (std::size_t i = 0; i < touching; ++i) {
      for (double& coordinate : std::span(noisy[i]).first(height + 1)) {
        if (random.one_in(2)) coordinate = nudged(coordinate, random);
      }
    }
    frames.push_back(std::move(noisy));
  }
  for (Frame& frame : frames) frame.insert(frame.end(), below.begin(), below.end());
  constexpr std::array<double, 4> units = {1, 0x1p-40, 1e-3, 1e6};
  const double unit = random.one_of(units);
  for (Frame& frame : frames) {
    for (Position& x : frame) x = unit * x;
  }
  return dressed(type.dimension, two_cells(rest.size(), below.size()), frames, random);
}

}  // namespace noli::audit
