// SPDX-License-Identifier: Apache-2.0
#include "integrator/scene/shapes/generators.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <stdexcept>

#include "integrator/scene/shapes/connectivity.h"
#include "integrator/scene/shapes/curve.h"
#include "integrator/scene/shapes/turn.h"

namespace noli::integrator {
namespace {

/// FNV-1a over the bits of all positions and the indices of all cells.
std::uint64_t hash(const Shape& shape) {
  std::uint64_t h = 0xcbf29ce484222325u;
  const auto add = [&h](std::uint64_t word) {
    for (int byte = 0; byte < 8; ++byte) h = (h ^ ((word >> (8 * byte)) & 0xff)) * 0x100000001b3u;
  };
  for (const Position& x : shape.positions) {
    for (const double c : x) add(std::bit_cast<std::uint64_t>(c));
  }
  for (const auto& face : shape.mesh.faces) {
    for (const VertexId i : face) add(i);
  }
  for (const auto& edge : shape.mesh.edges) {
    for (const VertexId i : edge) add(i);
  }
  return h;
}

Vec3 at(const Shape& shape, VertexId i) { return to_vec(shape.positions[i]); }

Vec3 normal(const Shape& shape, const std::array<VertexId, 3>& f) {
  return cross(at(shape, f[1]) - at(shape, f[0]), at(shape, f[2]) - at(shape, f[0]));
}

double area(const Shape& shape) {
  double sum = 0;
  for (const auto& face : shape.mesh.faces) sum += std::sqrt(normal(shape, face).squaredNorm()) / 2;
  return sum;
}

double volume(const Shape& shape) {
  double sum = 0;
  for (const auto& face : shape.mesh.faces) sum += at(shape, face[0]).dot(normal(shape, face)) / 6;
  return sum;
}

/// Expects that every index refers to a vertex, every vertex is in a cell, and no two vertices coincide.
void expect_sound(const Shape& shape) {
  EXPECT_EQ(shape.positions.size(), shape.mesh.vertex_count);
  std::vector<bool> used(shape.mesh.vertex_count);
  const auto visit = [&](const auto& cells) {
    for (const auto& cell : cells) {
      for (const VertexId i : cell) used.at(i) = true;
    }
  };
  visit(shape.mesh.faces);
  visit(shape.mesh.edges);
  for (const VertexId i : shape.mesh.points) used.at(i) = true;
  EXPECT_EQ(std::count(used.begin(), used.end(), true), static_cast<std::ptrdiff_t>(shape.mesh.vertex_count));
  EXPECT_EQ(std::set<Position>(shape.positions.begin(), shape.positions.end()).size(), shape.positions.size());
  for (const auto& [name, ids] : shape.sets) {
    EXPECT_FALSE(ids.empty()) << name;
    EXPECT_LT(ids.back(), shape.mesh.vertex_count) << name;
    EXPECT_TRUE(std::is_sorted(ids.begin(), ids.end())) << name;
  }
}

/// Whether faces that share an edge traverse it in opposite directions.
bool oriented(const Mesh& mesh) {
  std::set<std::pair<VertexId, VertexId>> sides;
  for (const auto& f : mesh.faces) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (!sides.insert({f[k], f[(k + 1) % 3]}).second) return false;
    }
  }
  return true;
}

std::size_t border_edges(const Mesh& mesh) {
  const auto edges = face_edges(mesh);
  return static_cast<std::size_t>(
      std::count_if(edges.begin(), edges.end(), [](const FaceEdge& e) { return e.count == 1; }));
}

long euler_characteristic(const Mesh& mesh) {
  return static_cast<long>(mesh.vertex_count) - static_cast<long>(face_edges(mesh).size()) +
         static_cast<long>(mesh.faces.size());
}

void expect_closed_outward(const Shape& shape) {
  expect_sound(shape);
  EXPECT_TRUE(oriented(shape.mesh));
  EXPECT_EQ(border_edges(shape.mesh), 0u);
  EXPECT_EQ(euler_characteristic(shape.mesh), 2);
  EXPECT_GT(volume(shape), 0);
  for (const auto& face : shape.mesh.faces) {  // convex shapes around the origin
    EXPECT_GT(normal(shape, face).dot(at(shape, face[0]) + at(shape, face[1]) + at(shape, face[2])), 0);
  }
}

/// Whether `map` leaves the set of positions unchanged, bit for bit up to the sign of zero.
template <class Map>
bool symmetric(const Shape& shape, Map&& map) {
  std::set<Position> before(shape.positions.begin(), shape.positions.end()), after;
  for (const Position& x : shape.positions) after.insert(map(x));
  return before == after;
}

Position mirror_x(const Position& p) { return {-p[0], p[1], p[2]}; }
Position mirror_y(const Position& p) { return {p[0], -p[1], p[2]}; }
Position mirror_z(const Position& p) { return {p[0], p[1], -p[2]}; }
Position swap_xy(const Position& p) { return {p[1], p[0], p[2]}; }

TEST(Turn, AgreesWithTheLibraryAndLiesOnTheCircle) {
  for (const std::uint64_t n : {1u, 2u, 3u, 7u, 12u, 64u, 360u, 1001u}) {
    for (std::uint64_t k = 0; k <= 2 * n; ++k) {
      const CosSin a = part_of_turn(k, n);
      const double angle = 2 * std::numbers::pi * static_cast<double>(k % n) / static_cast<double>(n);
      EXPECT_NEAR(a.cos, std::cos(angle), 1e-15) << k << "/" << n;
      EXPECT_NEAR(a.sin, std::sin(angle), 1e-15) << k << "/" << n;
      EXPECT_NEAR(a.cos * a.cos + a.sin * a.sin, 1, 5e-16) << k << "/" << n;
    }
  }
}

TEST(Turn, OctantsAreExact) {
  const double half = std::sqrt(0.5);
  const CosSin expected[] = {{1, 0},  {half, half},   {0, 1},  {-half, half},
                             {-1, 0}, {-half, -half}, {0, -1}, {half, -half}};
  for (unsigned k = 0; k < 16; ++k) {
    EXPECT_EQ(part_of_turn(k, 8), expected[k % 8]) << k;
    EXPECT_EQ(of_degrees(45.0 * k), expected[k % 8]) << k;
    EXPECT_EQ(of_degrees(-45.0 * k), expected[(16 - k) % 8]) << k;
  }
}

TEST(Turn, DegreesAreReducedExactly) {
  for (const double d :
       {0.1, 1.0, 29.999, 44.999999999999993, 45.000000000000007, 89.9, 135.5, 270.25, 359.99999999999994}) {
    EXPECT_NEAR(of_degrees(d).cos, std::cos(d * std::numbers::pi / 180), 1e-15) << d;
    EXPECT_NEAR(of_degrees(d).sin, std::sin(d * std::numbers::pi / 180), 1e-15) << d;
    EXPECT_EQ(of_degrees(-d), (CosSin{of_degrees(d).cos, -of_degrees(d).sin})) << d;
  }
  EXPECT_EQ(of_degrees(360e9 + 30), of_degrees(30));
  EXPECT_EQ(of_degrees(30), part_of_turn(1, 12));
}

TEST(Curve, EqualPartsOfABrokenLine) {
  const auto points = along_curve({{0, 0, 0}, {3, 0, 0}, {3, 4, 0}}, 7, {});
  ASSERT_EQ(points.size(), 8u);
  for (std::size_t k = 0; k < 8; ++k) {
    const double s = static_cast<double>(k);
    EXPECT_NEAR(points[k][0], std::min(s, 3.0), 1e-14) << k;
    EXPECT_NEAR(points[k][1], std::max(s - 3.0, 0.0), 1e-14) << k;
  }
  EXPECT_EQ(points.back(), Vec3(3, 4, 0));
}

TEST(Curve, SmoothGoesThroughItsPointsAtNearlyEqualDistances) {
  const std::vector<Position> given{{0, 0, 0}, {1, 1, 0}, {2, 0, 1}, {3, 0, 0}};
  const auto points = along_curve(given, 300, {.smooth = true});
  for (const Position& g : given) {
    double nearest = 1;
    for (const Vec3& p : points) nearest = std::min(nearest, std::sqrt((p - to_vec(g)).squaredNorm()));
    EXPECT_LT(nearest, 0.01);
  }
  double shortest = 1, longest = 0;
  for (std::size_t k = 1; k < points.size(); ++k) {
    const double l = std::sqrt((points[k] - points[k - 1]).squaredNorm());
    shortest = std::min(shortest, l);
    longest = std::max(longest, l);
  }
  EXPECT_LT(longest / shortest, 1.01);
}

TEST(Curve, OfNoLengthIsRefused) {
  EXPECT_THROW(along_curve({{1, 2, 3}, {1, 2, 3}}, 4, {}), std::invalid_argument);
  EXPECT_THROW(along_curve({{1, 2, 3}, {1, 2, 3}}, 4, {.smooth = true}), std::invalid_argument);
}

TEST(Generators, Chain) {
  const Shape shape = make_shape(Chain{{{-1, 0, 0}, {1, 0, 0}}, 8, false});
  expect_sound(shape);
  EXPECT_EQ(shape.mesh.edges.size(), 8u);
  EXPECT_TRUE(shape.mesh.faces.empty());
  EXPECT_EQ(shape.sets.at("first"), std::vector<VertexId>{0});
  EXPECT_EQ(shape.sets.at("last"), std::vector<VertexId>{8});
  EXPECT_EQ(shape.positions[4], (Position{0, 0, 0}));
  EXPECT_EQ(hash(shape), 0xa56d2bd0e74422ddu);
}

TEST(Generators, LoosePoints) {
  const Shape shape = make_shape(LoosePoints{{{1, 2, 3}, {4, 5, 6}}});
  expect_sound(shape);
  EXPECT_EQ(shape.mesh.points, (std::vector<VertexId>{0, 1}));
  EXPECT_EQ(shape.positions[1], (Position{4, 5, 6}));
}

TEST(Generators, ClosedChain) {
  const std::vector<Position> square{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
  const Shape shape = make_shape(Chain{square, 16, false, true});
  expect_sound(shape);
  EXPECT_EQ(shape.mesh.vertex_count, 16u);
  EXPECT_EQ(shape.mesh.edges.size(), 16u);
  EXPECT_EQ(joints(shape.mesh).joints.size(), 16u);
  for (const auto& e : shape.mesh.edges) EXPECT_EQ((at(shape, e[1]) - at(shape, e[0])).squaredNorm(), 0.25);
  for (const Position& corner : square) {
    EXPECT_EQ(std::count(shape.positions.begin(), shape.positions.end(), corner), 1) << corner[0] << " " << corner[1];
  }
  const Shape smooth = make_shape(Chain{square, 400, true, true});
  EXPECT_NEAR(std::abs(at(smooth, 50)[0]), 0, 0.01) << "half way along a side";
  EXPECT_NEAR(at(smooth, 50)[1], -1.25, 0.01) << "Catmull and Rom's bulge: an eighth of the next side's length";
  EXPECT_TRUE(smooth.sets.empty());
}

TEST(Generators, Ring) {
  const Shape shape = make_shape(Ring{0.5, 64});
  expect_sound(shape);
  EXPECT_EQ(shape.mesh.edges.size(), 64u);
  EXPECT_EQ(joints(shape.mesh).joints.size(), 64u);
  double length = 0;
  for (const auto& e : shape.mesh.edges) length += std::sqrt((at(shape, e[1]) - at(shape, e[0])).squaredNorm());
  EXPECT_NEAR(length, 64 * std::sin(std::numbers::pi / 64), 1e-14);
  EXPECT_TRUE(symmetric(shape, mirror_x));
  EXPECT_TRUE(symmetric(shape, mirror_y));
  EXPECT_TRUE(symmetric(shape, swap_xy));
  EXPECT_EQ(hash(shape), 0x37fe7fe02c7e73c5u);
}

TEST(Generators, Grid) {
  for (const Diagonals diagonals : {Diagonals::alternating, Diagonals::parallel}) {
    const Shape shape = make_shape(Grid{{0.3, 0.7}, {6, 4}, diagonals, {}});
    expect_sound(shape);
    EXPECT_EQ(shape.mesh.vertex_count, 35u);
    EXPECT_EQ(shape.mesh.faces.size(), 48u);
    EXPECT_TRUE(oriented(shape.mesh));
    EXPECT_EQ(border_edges(shape.mesh), 20u);
    EXPECT_EQ(euler_characteristic(shape.mesh), 1);
    EXPECT_NEAR(area(shape), 0.21, 1e-15);
    for (const auto& face : shape.mesh.faces) EXPECT_GT(normal(shape, face)[2], 0);
    EXPECT_TRUE(symmetric(shape, mirror_x));
    EXPECT_TRUE(symmetric(shape, mirror_y));
    EXPECT_EQ(hash(shape), diagonals == Diagonals::alternating ? 0xd96ba4a7f8f31f45u : 0x5ac3dd63ba41881du);
  }
}

double longest_edge(const Shape& shape, const std::array<VertexId, 3>& f) {
  double longest = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    longest = std::max(longest, std::sqrt((at(shape, f[k]) - at(shape, f[(k + 1) % 3])).squaredNorm()));
  }
  return longest;
}

class FineGrid : public testing::TestWithParam<FinePlace> {};

INSTANTIATE_TEST_SUITE_P(Generators, FineGrid,
                         testing::Values(FinePlace{{0.11, -0.07}, 50, 0}, FinePlace{{0, 0}, 8, 0},
                                         FinePlace{{0.5, 0.5}, 20, 0}, FinePlace{{-0.5, 0.2}, 10, 0.05}));

TEST_P(FineGrid, IsFineThereAndSoundEverywhere) {
  const FinePlace place = GetParam();
  const double diagonal = std::sqrt(2.0) / 10, fine = diagonal / place.factor;
  for (const Diagonals diagonals : {Diagonals::alternating, Diagonals::parallel}) {
    const Shape shape = make_shape(Grid{{1, 1}, {10, 10}, diagonals, place});
    expect_sound(shape);
    EXPECT_TRUE(oriented(shape.mesh));
    EXPECT_EQ(euler_characteristic(shape.mesh), 1) << "no vertex inside an edge";
    EXPECT_NEAR(area(shape), 1, 1e-14);
    double longest = 0, shortest = 1;
    for (const auto& f : shape.mesh.faces) {
      EXPECT_NEAR(normal(shape, f)[2] / (longest_edge(shape, f) * longest_edge(shape, f)), 0.5, 1e-9) << "its shape";
      longest = std::max(longest, longest_edge(shape, f));
      shortest = std::min(shortest, longest_edge(shape, f));
    }
    EXPECT_NEAR(longest, diagonal, 1e-15);
    EXPECT_LE(shortest, fine * (1 + 1e-12));
    EXPECT_GT(shortest, 0.49 * fine);
    EXPECT_LT(shape.mesh.faces.size(), 200 + 400u + (place.radius > 0 ? 1000 : 0));
  }
}

TEST(Generators, AFineGridsSetsHaveTheVerticesOfItsRim) {
  const Shape shape = make_shape(Grid{{2, 1}, {4, 2}, Diagonals::alternating, FinePlace{{1, 0.1}, 10, 0}});
  EXPECT_GT(shape.sets.at("right").size(), 6u);
  for (const VertexId i : shape.sets.at("right")) EXPECT_EQ(shape.positions[i][0], 1);
  const auto right = static_cast<std::size_t>(
      std::count_if(shape.positions.begin(), shape.positions.end(), [](const Position& x) { return x[0] == 1; }));
  EXPECT_EQ(shape.sets.at("right").size(), right);
  EXPECT_EQ(shape.sets.at("left").size(), 3u);
}

TEST(Generators, SetsOfAGridAreWhereTheirNamesSay) {
  const Shape shape = make_shape(Grid{{2, 1}, {4, 2}, Diagonals::alternating, {}});
  const auto all = [&shape](const char* set, std::size_t count, auto holds) {
    const auto& ids = shape.sets.at(set);
    EXPECT_EQ(ids.size(), count) << set;
    EXPECT_TRUE(std::all_of(ids.begin(), ids.end(), [&](VertexId i) { return holds(shape.positions[i]); })) << set;
  };
  all("left", 3, [](const Position& x) { return x[0] == -1; });
  all("right", 3, [](const Position& x) { return x[0] == 1; });
  all("bottom", 5, [](const Position& x) { return x[1] == -0.5; });
  all("top", 5, [](const Position& x) { return x[1] == 0.5; });
  all("left_bottom", 1, [](const Position& x) { return x == Position{-1, -0.5, 0}; });
  all("right_bottom", 1, [](const Position& x) { return x == Position{1, -0.5, 0}; });
  all("left_top", 1, [](const Position& x) { return x == Position{-1, 0.5, 0}; });
  all("right_top", 1, [](const Position& x) { return x == Position{1, 0.5, 0}; });
}

TEST(Generators, RibbonKeepsItsWidthAndTurnsLittle) {
  const Ribbon ribbon{{{0, 0, 0}, {1, 0, 0}, {2, 1, 0}, {2, 2, 1}}, 0.2, 60, 2, {0, 0, 1}};
  const Shape shape = make_shape(ribbon);
  expect_sound(shape);
  EXPECT_EQ(shape.mesh.vertex_count, 61u * 3);
  EXPECT_EQ(shape.mesh.faces.size(), 60u * 2 * 2);
  EXPECT_TRUE(oriented(shape.mesh));
  EXPECT_EQ(euler_characteristic(shape.mesh), 1);
  for (VertexId k = 0; k <= 60; ++k) {
    EXPECT_NEAR(std::sqrt((at(shape, 3 * k + 2) - at(shape, 3 * k)).squaredNorm()), 0.2, 1e-15);
    if (k > 0) {
      const Vec3 side = at(shape, 3 * k + 2) - at(shape, 3 * k), before = at(shape, 3 * k - 1) - at(shape, 3 * k - 3);
      EXPECT_GT(side.dot(before), 0.039) << k;
    }
  }
  EXPECT_LT(normal(shape, shape.mesh.faces[0])[1], 0) << "x cross side";
  EXPECT_EQ(shape.sets.at("left").size(), 61u);
  EXPECT_EQ(shape.sets.at("last"), (std::vector<VertexId>{180, 181, 182}));
  EXPECT_EQ(hash(shape), 0xa14da9be4cf325adu);
}

TEST(Generators, RibbonWhoseSideIsAlongTheCurveIsRefused) {
  EXPECT_THROW(make_shape(Ribbon{{{0, 0, 0}, {0, 0, 1}}, 0.1, 4, 1, {0, 0, 1}}), std::invalid_argument);
  EXPECT_THROW(make_shape(Ribbon{{{0, 0, 0}, {1, 0, 0}, {0, 0, 0}}, 0.1, 2, 1, {0, 0, 1}}), std::invalid_argument);
}

TEST(Generators, Disc) {
  const Shape shape = make_shape(Disc{0.35, 8});
  expect_sound(shape);
  EXPECT_EQ(shape.mesh.vertex_count, 1u + 3 * 8 * 9);
  EXPECT_EQ(shape.mesh.faces.size(), 6u * 64);
  EXPECT_TRUE(oriented(shape.mesh));
  EXPECT_EQ(border_edges(shape.mesh), 48u);
  EXPECT_EQ(euler_characteristic(shape.mesh), 1);
  EXPECT_NEAR(area(shape), 0.35 * 0.35 * 24 * std::sin(2 * std::numbers::pi / 48), 1e-15);
  for (const auto& face : shape.mesh.faces) EXPECT_GT(normal(shape, face)[2], 0);
  EXPECT_TRUE(symmetric(shape, mirror_y));
  EXPECT_TRUE(symmetric(shape, mirror_x));
  EXPECT_EQ(shape.sets.at("rim").size(), 48u);
  EXPECT_EQ(hash(shape), 0x2dc34a3804b5b09du);
}

TEST(Generators, Rod) {
  const Shape shape = make_shape(Rod{1, 0.05, 20, 12});
  expect_closed_outward(shape);
  EXPECT_EQ(shape.mesh.vertex_count, 21u * 12 + 2);
  const double cap = 0.05 * 0.05 * 6 * std::sin(2 * std::numbers::pi / 12);
  EXPECT_NEAR(volume(shape), cap, 1e-15);
  EXPECT_NEAR(area(shape), 2 * cap + 24 * 0.05 * std::sin(std::numbers::pi / 12), 1e-14);
  EXPECT_EQ(shape.sets.at("first").size(), 13u);
  for (const VertexId i : shape.sets.at("first")) EXPECT_EQ(shape.positions[i][0], -0.5);
  for (const VertexId i : shape.sets.at("last")) EXPECT_EQ(shape.positions[i][0], 0.5);
  EXPECT_TRUE(symmetric(shape, mirror_x));
  EXPECT_TRUE(symmetric(shape, mirror_y));
  EXPECT_TRUE(symmetric(shape, mirror_z));
  EXPECT_EQ(hash(shape), 0x88193fb28207fe7du);
}

TEST(Generators, SphereConvergesToASphere) {
  double error = 0;
  for (std::uint32_t level = 0; level <= 4; ++level) {
    const Shape shape = make_shape(Sphere{0.125, level});
    expect_closed_outward(shape);
    EXPECT_EQ(shape.mesh.vertex_count, 10u * (1u << (2 * level)) + 2);
    for (const Position& x : shape.positions) EXPECT_NEAR(std::sqrt(to_vec(x).squaredNorm()), 0.125, 5e-17);
    EXPECT_TRUE(symmetric(shape, mirror_x) && symmetric(shape, mirror_y) && symmetric(shape, mirror_z));
    const double next_error = 4 * std::numbers::pi * 0.125 * 0.125 - area(shape);
    if (level > 1) {
      EXPECT_NEAR(error / next_error, 4, 0.5) << level;
    }
    error = next_error;
  }
  EXPECT_EQ(hash(make_shape(Sphere{0.125, 3})), 0x917c3edea4af68b9u);
}

TEST(Generators, Box) {
  const Shape shape = make_shape(SurfaceOfBox{{1, 2, 3}, {2, 3, 4}});
  expect_closed_outward(shape);
  EXPECT_EQ(shape.mesh.faces.size(), 4u * (6 + 12 + 8));
  EXPECT_NEAR(volume(shape), 6, 1e-14);
  EXPECT_NEAR(area(shape), 22, 1e-13);
  EXPECT_TRUE(symmetric(shape, mirror_x) && symmetric(shape, mirror_y) && symmetric(shape, mirror_z));
  EXPECT_EQ(hash(shape), 0xc68c0b57f3d5bf45u);
}

TEST(Generators, Torus) {
  const Shape shape = make_shape(Torus{0.5, 0.125, 24, 12});
  expect_sound(shape);
  EXPECT_TRUE(oriented(shape.mesh));
  EXPECT_EQ(border_edges(shape.mesh), 0u);
  EXPECT_EQ(euler_characteristic(shape.mesh), 0);
  EXPECT_EQ(shape.mesh.vertex_count, 24u * 12);
  const double pi = std::numbers::pi;
  EXPECT_NEAR(volume(shape) / (2 * pi * pi * 0.5 * 0.125 * 0.125), 1, 0.07) << "less by the corners; positive: outward";
  for (const Position& x : shape.positions) {
    const double out = std::sqrt(x[0] * x[0] + x[1] * x[1]) - 0.5;
    EXPECT_NEAR(std::sqrt(out * out + x[2] * x[2]), 0.125, 1e-15);
  }
  EXPECT_TRUE(symmetric(shape, mirror_x) && symmetric(shape, mirror_y) && symmetric(shape, mirror_z));
}

TEST(Generators, Pyramid) {
  const Shape shape = make_shape(Pyramid{2, 3, 4});
  expect_sound(shape);
  EXPECT_TRUE(oriented(shape.mesh));
  EXPECT_EQ(border_edges(shape.mesh), 4u);
  EXPECT_NEAR(volume(shape), 8, 1e-14) << "the base, through the origin, adds nothing";
  EXPECT_EQ(shape.positions[shape.sets.at("tip")[0]], (Position{0, 0, 3}));
  EXPECT_EQ(shape.sets.at("base").size(), 4u);
}

TEST(Connectivity, EdgesAndTheirFaces) {
  Mesh mesh;
  mesh.vertex_count = 5;
  mesh.faces = {{0, 1, 2}, {2, 1, 3}, {1, 2, 4}};
  const auto edges = face_edges(mesh);
  ASSERT_EQ(edges.size(), 7u);
  EXPECT_EQ(edges[0].ends, (std::array<VertexId, 2>{0, 1}));
  EXPECT_EQ(edges[0].count, 1u);
  EXPECT_EQ(edges[1].ends, (std::array<VertexId, 2>{1, 2}));
  EXPECT_EQ(edges[1].count, 3u);
  EXPECT_EQ(edges[1].opposite, (std::array<VertexId, 2>{0, 3}));
  EXPECT_EQ(edges[1].faces, (std::array<std::uint32_t, 2>{0, 1}));
}

TEST(Connectivity, JointsAndBranchings) {
  Mesh mesh;
  mesh.vertex_count = 6;
  mesh.edges = {{0, 1}, {2, 1}, {2, 3}, {2, 4}};
  const Joints found = joints(mesh);
  EXPECT_EQ(found.branchings, 1u);
  ASSERT_EQ(found.joints.size(), 1u);
  EXPECT_EQ(found.joints[0].vertices, (std::array<VertexId, 3>{0, 1, 2}));
  EXPECT_EQ(found.joints[0].edges, (std::array<std::uint32_t, 2>{0, 1}));
}

}  // namespace
}  // namespace noli::integrator
