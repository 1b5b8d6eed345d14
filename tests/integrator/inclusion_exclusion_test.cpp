// SPDX-License-Identifier: Apache-2.0
//
// Tests inclusion-exclusion: adjacent faces count once, the sum has its defined value, and a flat mesh acts as a plane.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <numbers>
#include <set>
#include <vector>

#include "certificates/features.h"
#include "contact_models.h"
#include "integrator/layer_fire.h"
#include "integrator/scene/build_model.h"
#include "integrator/scene/read_scene.h"
#include "running.h"
#include "tests/kernel/random_numbers.h"

namespace noli::integrator {
namespace {

constexpr double first_layer = 0.01;

// --- The value of the sum --------------------------------------------------------------------------------------------

/// Vertex 0 and faces near it.
struct Neighbourhood {
  std::vector<Vec<double, 3>> x;
  std::vector<std::array<VertexId, 3>> faces;

  std::vector<certificates::Stencil> pairs() const {
    std::vector<certificates::Stencil> result;
    for (std::size_t f = 0; f < faces.size(); ++f) {
      const auto [a, b, c] = faces[f];
      result.push_back({FeaturePair::vertex_face, {0, a, b, c}, f});
    }
    return result;
  }
  double distance(FeaturePair kind, const std::array<VertexId, 4>& vertices) const {
    return closest_of<double, 3>({kind, vertices, 0}, [this](VertexId v) { return x[v]; }).distance();
  }
};

/// A fan of n faces around vertex 1, closed or not, with outer vertices at `outer(k)`, and a vertex at x.
template <class Outer>
Neighbourhood fan(int n, bool closed, const Vec<double, 3>& x, const Outer& outer) {
  Neighbourhood result{{x, Vec<double, 3>::Zero()}, {}};
  const int rim = closed ? n : n + 1;
  for (int k = 0; k < rim; ++k) result.x.push_back(outer(k));
  const auto number = [rim](int k) { return static_cast<VertexId>(2 + k % rim); };
  for (int k = 0; k < n; ++k) result.faces.push_back({1, number(k), number(k + 1)});
  return result;
}

/// A fan on a cone whose sides rise by `rise`.
Neighbourhood cone(int n, double rise, const Vec<double, 3>& x) {
  return fan(n, true, x, [&](int k) {
    const double angle = 2 * std::numbers::pi * (k + 0.3) / n;
    return Vec<double, 3>(0.1 * std::cos(angle), 0.1 * std::sin(angle), 0.1 * rise);
  });
}

struct Sum {
  double potential = 0;
  Vec<double, 3> force{0, 0, 0};  ///< on vertex 0
  std::size_t sites = 0;
};

/// The integrator's sum for a layer of stiffness 1, with pairs in the order `order`.
Sum joined(const Neighbourhood& n, double eta, const std::vector<std::size_t>& order) {
  InclusionExclusion<double, 3> joined;
  const auto position = [&n](VertexId v) { return n.x[v]; };
  const auto pairs = n.pairs();
  for (const std::size_t i : order) {
    Approach<double, 3> approach;
    find_approach_of<double, 3>(pairs[i], position, approach);
    if (approach.distance < eta) joined.add(pairs[i], approach);
  }
  Sum sum;
  if (joined.empty()) return sum;
  std::vector<SiteOfContact<double, 3>> sites;
  joined.take(eta, position, sites);
  for (const SiteOfContact<double, 3>& site : sites) {
    const double g = site.approach.distance - eta;
    sum.potential += site.weight * 0.5 * g * g;
    sum.force -= site.weight * g / site.approach.distance * site.approach.closest.r;
    ++sum.sites;
  }
  return sum;
}
Sum joined(const Neighbourhood& n, double eta) {
  std::vector<std::size_t> order(n.faces.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  return joined(n, eta, order);
}

/// Faces - interior edges + interior vertices, computed from the whole mesh.
double potential_by_definition(const Neighbourhood& n, double eta) {
  const auto layer = [eta](double d) { return d < eta ? 0.5 * (d - eta) * (d - eta) : 0.0; };
  std::map<std::set<VertexId>, int> of_edge;
  std::map<VertexId, int> of_vertex;
  double sum = 0;
  for (const auto& [a, b, c] : n.faces) {
    sum += layer(n.distance(FeaturePair::vertex_face, {0, a, b, c}));
    for (const auto& edge : {std::set{a, b}, std::set{b, c}, std::set{a, c}}) ++of_edge[edge];
    for (const VertexId v : {a, b, c}) ++of_vertex[v];
  }
  std::map<VertexId, int> border;
  for (const auto& [edge, faces] : of_edge) {
    const VertexId a = *edge.begin(), b = *edge.rbegin();
    if (faces == 1) ++border[a], ++border[b];
    if (faces == 2) sum -= layer(n.distance(FeaturePair::vertex_edge, {0, a, b, 0}));
  }
  for (const auto& [v, faces] : of_vertex) {
    if (border[v] == 0) sum += layer(n.distance(FeaturePair::vertex_vertex, {0, v, 0, 0}));
  }
  return sum;
}

TEST(InclusionExclusion, AboveAFlatFanThereIsOneSite) {
  noli::test::Random random(1);
  for (int i = 0; i < 1000; ++i) {
    const Vec<double, 3> x(0.02 * (random.unit() - 0.5), 0.02 * (random.unit() - 0.5), 0.001 + 0.008 * random.unit());
    const Neighbourhood flat = cone(3 + static_cast<int>(random.below(6)), 0, x);
    const Sum sum = joined(flat, first_layer);
    EXPECT_EQ(sum.sites, 1U);
    EXPECT_NEAR(sum.potential, 0.5 * (x[2] - first_layer) * (x[2] - first_layer), 1e-15);
    EXPECT_LT(std::hypot(sum.force[0], sum.force[1]), 1e-12 * sum.force[2]);
  }
}

TEST(InclusionExclusion, TheTipOfAConeCountsOnce) {
  const Sum tip = joined(cone(7, -1, {0, 0, 0.004}), first_layer);
  EXPECT_EQ(tip.sites, 1U);
  EXPECT_NEAR(tip.potential, 0.5 * 0.006 * 0.006, 1e-15);
  // Inside the cone each face is a wall, and edges and the tip are subtracted or added.
  EXPECT_GT(joined(cone(7, 1, {0, 0, 0.004}), first_layer).sites, 7U);
}

TEST(InclusionExclusion, IsFacesLessInteriorEdgesAndInteriorVertices) {
  noli::test::Random random(2);
  int several = 0;
  for (int i = 0; i < 3000; ++i) {
    const auto bumpy = [&](int k) {
      const double angle = 0.9 * k;
      return Vec<double, 3>(0.1 * std::cos(angle), 0.1 * std::sin(angle), 0.15 * (random.unit() - 0.5));
    };
    const Vec<double, 3> x(0.02 * (random.unit() - 0.5), 0.02 * (random.unit() - 0.5), 0.01 * random.unit());
    const bool closed = random.below(2) == 0;
    const Neighbourhood some = fan(closed ? 7 : 1 + static_cast<int>(random.below(5)), closed, x, bumpy);
    const Sum sum = joined(some, first_layer);
    EXPECT_NEAR(sum.potential, potential_by_definition(some, first_layer), 1e-16);
    if (sum.sites > 1) ++several;
  }
  EXPECT_GT(several, 300);
}

TEST(InclusionExclusion, ForcesAreTheGradient) {
  noli::test::Random random(3);
  constexpr double step = 1e-7;
  for (int i = 0; i < 300; ++i) {
    const double rise = 2 * (random.unit() - 0.5);
    Neighbourhood n =
        cone(6, rise, {0.01 * (random.unit() - 0.5), 0.01 * (random.unit() - 0.5), 0.003 + 0.003 * random.unit()});
    const Sum here = joined(n, first_layer);
    for (int d = 0; d < 3; ++d) {
      Neighbourhood ahead = n, behind = n;
      ahead.x[0][d] += step;
      behind.x[0][d] -= step;
      const double slope = (joined(ahead, first_layer).potential - joined(behind, first_layer).potential) / (2 * step);
      EXPECT_NEAR(here.force[d], -slope, 2e-8) << rise;
    }
  }
}

TEST(InclusionExclusion, OrderOfCellsMakesNoDifference) {
  noli::test::Random random(4);
  const Neighbourhood n = cone(6, 0.4, {0.001, 0.002, 0.005});
  std::vector<std::size_t> order{0, 1, 2, 3, 4, 5};
  const Sum sorted = joined(n, first_layer, order);
  EXPECT_GT(sorted.sites, 2U);
  for (int i = 0; i < 20; ++i) {
    std::swap(order[random.below(6)], order[random.below(6)]);
    const Sum other = joined(n, first_layer, order);
    EXPECT_EQ(other.sites, sorted.sites);
    EXPECT_EQ(other.potential, sorted.potential);
    EXPECT_EQ(other.force, sorted.force);
  }
}

// --- Two sheets ------------------------------------------------------------------------------------------------------

/// Two patches of 3 by 3 vertices each, one above the other and rotated; `bumps`: their unevenness [m].
struct Patches {
  Mesh mesh;
  std::vector<Vec<double, 3>> x;

  Patches(noli::test::Random& random, double bumps, double gap, double side = 0.03) {
    mesh.vertex_count = 18;
    for (const double sheet : {0.0, 1.0}) {
      const double turn = sheet * random.unit(), dx = 0.02 * (random.unit() - 0.5), dy = 0.02 * (random.unit() - 0.5);
      for (int i = 0; i < 9; ++i) {
        const int column = i % 3, row = i / 3;
        const double u = side * (column - 1), v = side * (row - 1);
        x.emplace_back(u * std::cos(turn) - v * std::sin(turn) + sheet * dx,
                       u * std::sin(turn) + v * std::cos(turn) + sheet * dy,
                       sheet * gap + bumps * (random.unit() - 0.5));
      }
      const auto first = static_cast<VertexId>(9 * sheet);
      for (const VertexId k : {0U, 1U, 3U, 4U}) {
        mesh.faces.push_back({first + k, first + k + 1, first + k + 3});
        mesh.faces.push_back({first + k + 1, first + k + 4, first + k + 3});
      }
    }
  }

  /// All pairs of features of the two patches, sorted by key.
  std::vector<certificates::Stencil> pairs() const {
    const certificates::Features features(mesh, 3);
    std::vector<certificates::Stencil> all;
    for (std::uint32_t a = 0; a < 8; ++a) {
      for (std::uint32_t b = 8; b < 16; ++b) {
        features.for_each_pair(a, b, [&](const certificates::Stencil& pair) { all.push_back(pair); });
      }
    }
    std::ranges::sort(all, {}, &certificates::Stencil::key);
    return all;
  }
};

struct LayerSum {
  double potential = 0;
  std::vector<Vec<double, 3>> forces;
  int edges = 0;  ///< sites of two edges
};

/// The sum over a layer of stiffness 1.
LayerSum layer_of(const Patches& patches, const std::vector<certificates::Stencil>& pairs, bool joins) {
  const LayerFire<double, 3> layer(joins);
  LayerSum sum{0, std::vector<Vec<double, 3>>(patches.x.size(), Vec<double, 3>::Zero()), 0};
  layer.for_each_acting(
      pairs, {first_layer, 1}, [&](VertexId v) { return patches.x[v]; },
      [&](const certificates::Stencil& pair, const auto& closest, double g, double weight) {
        sum.potential += weight * 0.5 * g * g;
        if (pair.kind == FeaturePair::edge_edge) ++sum.edges;
        for (std::size_t i = 0; i < pair.size(); ++i) {
          sum.forces[pair.vertices[i]] -= weight * g * closest.weights[i] / closest.distance() * closest.r;
        }
      });
  return sum;
}

/// A flat patch lies above a flat one ten times as large, across an edge and away from its vertices. However the patch
/// is tilted, it is pushed straight up.
TEST(EdgeExcess, AFlatFloorPushesStraightUp) {
  noli::test::Random random(5);
  int tilted = 0;
  for (int i = 0; i < 300; ++i) {
    Patches flat(random, 0, 0);
    const Vec<double, 2> tilt(0.1 * (random.unit() - 0.5), 0.1 * (random.unit() - 0.5));
    for (std::size_t k = 0; k < 9; ++k) flat.x[k] *= 10;
    for (std::size_t k = 9; k < 18; ++k) {
      flat.x[k][2] = 0.006 + tilt.dot(flat.x[k].head<2>());
      flat.x[k] += Vec<double, 3>(0.15, 0.15, 0);
    }
    const auto pairs = flat.pairs();
    const LayerSum once = layer_of(flat, pairs, true), each = layer_of(flat, pairs, false);
    Vec<double, 3> force = Vec<double, 3>::Zero(), before = Vec<double, 3>::Zero();
    for (std::size_t k = 9; k < 18; ++k) {
      force += once.forces[k];
      before += each.forces[k];
    }
    EXPECT_LT(std::hypot(force[0], force[1]), 1e-12 * force[2]) << i;
    if (std::hypot(before[0], before[1]) > 0.1 * before[2]) ++tilted;
  }
  EXPECT_GT(tilted, 50);
}

TEST(EdgeExcess, ForcesAreTheGradient) {
  noli::test::Random random(6);
  constexpr double step = 1e-7;
  int edges = 0;
  for (int i = 0; i < 100; ++i) {
    const Patches here(random, 0.01, 0.008);
    const auto pairs = here.pairs();
    const LayerSum sum = layer_of(here, pairs, true);
    edges += sum.edges;
    Vec<double, 3> all = Vec<double, 3>::Zero(), moment = Vec<double, 3>::Zero();
    for (std::size_t k = 0; k < 18; ++k) {
      all += sum.forces[k];
      moment += here.x[k].cross(sum.forces[k]);
      for (int d = 0; d < 3; ++d) {
        Patches ahead = here, behind = here;
        ahead.x[k][d] += step;
        behind.x[k][d] -= step;
        const double slope =
            (layer_of(ahead, pairs, true).potential - layer_of(behind, pairs, true).potential) / (2 * step);
        EXPECT_NEAR(sum.forces[k][d], -slope, 1e-7) << i;
      }
    }
    EXPECT_LT(all.norm(), 1e-15);
    EXPECT_LT(moment.norm(), 1e-16);
  }
  EXPECT_GT(edges, 50);
}

/// Two ridges cross far from their ends, and their edges push as if nothing else were there.
TEST(EdgeExcess, RidgesThatCrossPush) {
  Patches ridges = [] {
    noli::test::Random random(7);
    return Patches(random, 0, 0.004);
  }();
  ridges.mesh.faces = {{0, 1, 2}, {0, 1, 3}, {9, 10, 11}, {9, 10, 12}};
  for (auto& x : ridges.x) x = {5, 5, 5};
  ridges.x[0] = {-0.1, 0, 0}, ridges.x[1] = {0.1, 0, 0}, ridges.x[2] = {0, 0.1, -0.1}, ridges.x[3] = {0, -0.1, -0.1};
  ridges.x[9] = {0, -0.1, 0.004}, ridges.x[10] = {0, 0.1, 0.004}, ridges.x[11] = {0.1, 0, 0.104},
  ridges.x[12] = {-0.1, 0, 0.104};
  const certificates::Features features(ridges.mesh, 3);
  std::vector<certificates::Stencil> pairs;
  for (const std::uint32_t a : {0U, 1U}) {
    for (const std::uint32_t b : {2U, 3U})
      features.for_each_pair(a, b, [&](const auto& pair) { pairs.push_back(pair); });
  }
  std::ranges::sort(pairs, {}, &certificates::Stencil::key);
  EXPECT_NEAR(layer_of(ridges, pairs, true).potential, 0.5 * 0.006 * 0.006, 1e-15);
  // A ridge beside the end of the other one is pushed only by that end.
  for (const VertexId k : {9U, 10U, 11U, 12U}) ridges.x[k][0] -= 0.105;
  const LayerSum beside = layer_of(ridges, pairs, true);
  EXPECT_EQ(beside.edges, 0);
  EXPECT_GT(beside.potential, 0);
}

// --- A flat mesh acts as a plane -------------------------------------------------------------------------------------

/// Two pinned triangles form a square from (-1, -1) to (1, 1) with one diagonal. Points above it fall at 1 m/s, at
/// distances `from_edge` from the diagonal.
Model<double, 3> points_above_a_floor(const std::vector<double>& from_edge) {
  std::vector<Vec<double, 3>> x;
  for (std::size_t k = 0; k < from_edge.size(); ++k) {
    const double along = 0.1 * static_cast<double>(k) - 0.3, off = from_edge[k] / std::numbers::sqrt2;
    x.emplace_back(along + off, along - off, 0.02);
  }
  Model<double, 3> floor;
  floor.mesh.vertex_count = 4;
  floor.mesh.faces = {{0, 1, 2}, {0, 2, 3}};
  floor.x = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
  floor.v.assign(4, Vec<double, 3>::Zero());
  floor.mass.assign(4, 1);
  return test::both(test::moved(test::points<3>(std::move(x), 1), {0, 0, 0}, {0, 0, -1}), test::held(std::move(floor)));
}

/// The state after the bounce of bodies that fall from 2 cm at 1 m/s.
template <int Dim>
Snapshot<double, Dim> after_the_bounce(Model<double, Dim> model, bool inclusion_exclusion) {
  model = test::with_contact(std::move(model), {first_layer, 1000});
  model.contact->inclusion_exclusion = inclusion_exclusion;
  Simulation<double, Dim> simulation(model);
  test::run(simulation, 8);
  return simulation.snapshot();
}

/// The greatest angle to the vertical at which a point leaves, in degrees.
double greatest_angle(const Model<double, 3>& model, std::size_t points, bool inclusion_exclusion) {
  const auto s = after_the_bounce(model, inclusion_exclusion);
  double greatest = 0;
  for (std::size_t i = 0; i < points; ++i) {
    EXPECT_GT(s.v[i][2], 0.9);
    EXPECT_GT(s.x[i][2], first_layer);
    greatest = std::max(greatest, std::atan2(std::hypot(s.v[i][0], s.v[i][1]), s.v[i][2]));
  }
  return greatest * 180 / std::numbers::pi;
}

TEST(InclusionExclusion, APointLeavesAFlatFloorAsItCame) {
  const std::vector<double> from_edge{3e-3, 1e-4, -1e-3, 6e-3, -9e-3, 0, 5e-2};
  const auto model = points_above_a_floor(from_edge);
  const double once = greatest_angle(model, from_edge.size(), true),
               each = greatest_angle(model, from_edge.size(), false);
  std::printf("a point leaves %.3g degrees off the vertical; where each face pushes for itself, %.3g\n", once, each);
  EXPECT_LT(once, 1e-6);
  EXPECT_GT(each, 5);
}

/// A box of 10 cm lands flat on a floor of squares of 25 cm with a diagonal each: across some edges, or with a side
/// 3 mm beside one. Returns the angle of its momentum to the vertical after the bounce, in degrees.
double lean_of_a_box(double x, double turn, bool inclusion_exclusion) {
  const Json json = {
      {"noli_scene", 1},
      {"duration", 0.12},
      {"window", 0.01},
      {"bodies",
       {{{"name", "box"},
         {"mesh", {{"box", {{"size", {0.1, 0.1, 0.05}}, {"cells", {1, 1, 1}}}}}},
         {"transform", {{"rotate", {{"axis", {0, 0, 1}}, {"degrees", turn}}}, {"translate", {x, 0.07, 0.045}}}},
         {"velocity", {0, 0, -0.5}},
         {"material", {{"young", 1e6}, {"poisson", 0.3}, {"density", 500}, {"thickness", 0.01}}}},
        {{"name", "floor"},
         {"mesh", {{"grid", {{"size", {2, 2}}, {"cells", {8, 8}}}}}},
         {"material", {{"edge_stiffness", 0}, {"mass_per_area", 1}}},
         {"pin", {"all"}}}}},
      {"contact", {{"thickness", 0.01}, {"stiffness", 2000}, {"inclusion_exclusion", inclusion_exclusion}}}};
  const auto built = build_model<3>(parse_scene(json.dump(), "box", Form::full));
  Simulation<double, 3> simulation(built.model);
  test::run(simulation, 12);
  const Vec<double, 3> p = simulation.state().momentum;
  EXPECT_GT(p[2], 0);
  return std::atan2(std::hypot(p[0], p[1]), p[2]) * 180 / std::numbers::pi;
}

TEST(FlatFloor, ABoxLeavesAsItCame) {
  const std::vector<std::array<double, 2>> places{{0.053, 0}, {0.02, 7}, {0.1, 30}, {0.068, 3}};
  double once = 0, each = 0;
  for (const auto& [x, turn] : places) {
    once = std::max(once, lean_of_a_box(x, turn, true));
    each = std::max(each, lean_of_a_box(x, turn, false));
  }
  std::printf("a box leaves %.3g degrees off the vertical; where each pair pushes for itself, %.3g\n", once, each);
  EXPECT_LT(once, 1e-6);
  EXPECT_GT(each, 5);
}

// --- Creases ---------------------------------------------------------------------------------------------------------

struct Groove {
  double slope = 0.1, restitution = 1, friction = 0;
  Vec<double, 3> v{0, 0, 0}, gravity{0, 0, 0};
  int windows = 0;
};

/// The final velocity of a point of 1 kg that starts 15 mm above the bottom of a groove of two wide faces along y.
Vec<double, 3> velocity_in(const Groove& o, bool inclusion_exclusion) {
  Model<double, 3> groove;
  groove.mesh.vertex_count = 4;
  groove.mesh.faces = {{0, 1, 2}, {1, 0, 3}};
  groove.x = {{0, -8, 0}, {0, 8, 0}, {3, 0, 3 * o.slope}, {-3, 0, 3 * o.slope}};
  groove.v.assign(4, Vec<double, 3>::Zero());
  groove.mass.assign(4, 1);
  auto model =
      test::both(test::moved(test::points<3>({{0, 0, 0.015}}, 1), {0, 0, 0}, o.v), test::held(std::move(groove)));
  model.gravity = Gravity<double, 3>{o.gravity, 1e-4};
  model = test::with_contact(std::move(model), {first_layer, 1000, 0.02, o.restitution, o.friction});
  model.contact->inclusion_exclusion = inclusion_exclusion;
  Simulation<double, 3> simulation(model);
  test::run(simulation, static_cast<std::uint64_t>(o.windows));
  return simulation.snapshot().v[0];
}

/// Restitution must reduce pulling terms like pushing ones, or the point would never leave.
TEST(Crease, ReturnsItsShareOfTheEnergy) {
  for (const double restitution : {1.0, 0.25, 0.01}) {
    const Groove down{.restitution = restitution, .v = {0, 0, -0.5}, .windows = restitution < 0.1 ? 60 : 20};
    for (const bool once : {false, true}) {
      const double speed = velocity_in(down, once)[2];
      EXPECT_NEAR(speed, 0.5 * std::sqrt(restitution), 0.02 * std::sqrt(restitution)) << once;
    }
  }
}

/// The friction of both walls follows their total push: along the groove, the point slides as on a plane.
TEST(Crease, RubsByItsPushAsAWhole) {
  const Groove along{.restitution = 0.25, .friction = 0.4, .gravity = {0, 6, -10}, .windows = 60};
  const double before = velocity_in(along, true)[1];
  Groove longer = along;
  longer.windows = 110;
  const double gained = velocity_in(longer, true)[1] - before;
  EXPECT_NEAR(gained, 0.5 * (6 - 0.4 * 10), 0.03);
  Groove steeper = longer;
  steeper.friction = 0.7;
  EXPECT_NEAR(velocity_in(steeper, true)[1], 0, 1e-3);
}

// --- Part of the motion ----------------------------------------------------------------------------------------------

Model<double, 3> sheets_that_collide() {
  Model<double, 3> model = test::with_contact(test::colliding_sheets(3, 2), {0.03, 200, 0.05, 0.5, 0.4});
  model.contact->inclusion_exclusion = true;
  return model;
}

TEST(InclusionExclusion, LayersActivatedInTimeEqualLayersThatAlwaysAre) {
  Model<double, 3> model = sheets_that_collide();
  Simulation<double, 3> lazy(model);
  model.contact->least_layers = 8;
  Simulation<double, 3> eager(model);
  model.contact->inclusion_exclusion = false;
  Simulation<double, 3> each(model);
  const auto books = test::run(lazy, 12);
  test::run(eager, 12);
  test::run(each, 12);
  EXPECT_GT(books.of(ForceKind::contact).events, 1000U);
  test::expect_same(lazy.snapshot(), eager.snapshot());
  EXPECT_NE(lazy.snapshot().x, each.snapshot().x);
}

TEST(InclusionExclusion, GoesOnFromASnapshotAsIfNothingHadHappened) {
  const Model<double, 3> model = sheets_that_collide();
  Simulation<double, 3> simulation(model);
  test::run(simulation, 6);
  const auto half = simulation.snapshot();
  EXPECT_FALSE(half.anchors.empty());
  test::run(simulation, 6);
  Simulation<double, 3> other(model, half);
  test::run(other, 6);
  test::expect_same(other.snapshot(), simulation.snapshot());
}

TEST(InclusionExclusion, KeepsMomentaAndItsBooks) {
  const Model<double, 3> model = sheets_that_collide();
  Simulation<double, 3> simulation(model);
  const auto before = simulation.state();
  const auto books = test::run(simulation, 12);
  const auto after = simulation.state();
  EXPECT_LT((after.momentum - before.momentum).norm(), 1e-13 * before.speeds);
  EXPECT_LT((after.angular_momentum - before.angular_momentum).norm(), 1e-12 * before.moments);
  double work = 0;
  for (const auto& account : books.accounts) work += account.work + account.damping_work + account.restitution_work;
  EXPECT_NEAR(after.kinetic - before.kinetic, work, 1e-10 * before.kinetic);
}

/// The same in the plane, near the ends of four edges in a row.
TEST(InclusionExclusion, InThePlaneToo) {
  Model<double, 2> floor = test::held(test::chain<2>({{-1, 0}, {0, 0}, {0.5, 0}, {1, 0}, {2, 0}}, false, 1, 1));
  std::vector<Vec<double, 2>> x{{0.003, 0.02}, {0.499, 0.02}, {1, 0.02}, {0.25, 0.02}, {0.98, 0.02}};
  const auto model = test::both(test::moved(test::points<2>(x, 1), {0, 0}, {0, -1}), floor);
  for (const bool once : {true, false}) {
    const auto s = after_the_bounce(model, once);
    double greatest = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
      EXPECT_GT(s.v[i][1], 0.9);
      greatest = std::max(greatest, std::abs(s.v[i][0]));
    }
    EXPECT_EQ(greatest < 1e-9, once) << greatest;
  }
}

}  // namespace
}  // namespace noli::integrator
