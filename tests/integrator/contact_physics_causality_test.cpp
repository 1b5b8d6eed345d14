// SPDX-License-Identifier: Apache-2.0
//
// Tests causality (theory.md, T3): an impulse travels through a row of bodies in order. A layer does not act before the
// recorded motion comes within its thickness, and acts no later than its next time. The recorded motion is judged
// exactly.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "contact_models.h"
#include "kernel/thickness.h"
#include "running.h"

namespace noli::integrator {
namespace {

/// Bodies in a row along the first axis. The first flies at the others, which rest. Only contact acts.
template <int Dim>
struct Row {
  Model<double, Dim> model;
  std::vector<std::vector<VertexId>> bodies;
};

constexpr int bodies_in_row = 7;
constexpr double eta = 0.1;

template <int Dim>
void add_body(Row<Dim>& row, const std::vector<Vec<double, Dim>>& x) {
  Mesh& mesh = row.model.mesh;
  const auto first = static_cast<VertexId>(row.model.x.size());
  std::vector<VertexId> vertices;
  const double speed = row.bodies.empty() ? 3 : 0;
  for (const auto& place : x) {
    vertices.push_back(static_cast<VertexId>(row.model.x.size()));
    row.model.x.push_back(place);
    row.model.v.push_back(Vec<double, Dim>::Unit(0) * speed);
    row.model.mass.push_back(1.0 / static_cast<double>(x.size()));
  }
  if (x.size() == 1) mesh.points.push_back(first);
  if (x.size() == 2) mesh.edges.push_back({first, first + 1});
  if (x.size() == 3) mesh.faces.push_back({first, first + 1, first + 2});
  row.bodies.push_back(vertices);
  mesh.vertex_count = row.model.x.size();
}

/// Points, or alternating points and plates, which are edges in the plane and faces in space. Points meet plates in the
/// middle, so all vertices of a plate are pushed at the same time.
template <int Dim>
Row<Dim> row_of(bool plates) {
  Row<Dim> row;
  for (int j = 0; j < bodies_in_row; ++j) {
    Vec<double, Dim> at = Vec<double, Dim>::Zero();
    at[0] = 0.3 * j + 0.02 * test::noise(static_cast<std::uint64_t>(j));
    std::vector<Vec<double, Dim>> x{at};
    if (plates && j % 2 == 1) {
      x.assign(Dim, at);
      x[0][1] = -0.375;
      x[1][1] = 0.375;
      if (Dim == 3) {
        for (auto& corner : x) corner[Dim - 1] = -0.25;
        x[Dim - 1][Dim - 1] = 0.5;
      }
    }
    add_body<Dim>(row, x);
  }
  row.model.window_length = 1;
  row.model = test::with_contact(std::move(row.model), {eta, 1000, 0.05, 1, 0});
  return row;
}

/// The recorded motion of a vertex.
template <int Dim>
struct Path {
  std::vector<double> t;
  std::vector<Point<Dim>> x;
};

template <int Dim>
std::vector<Path<Dim>> paths_of(const Recording<double, Dim>& recording, std::size_t vertices) {
  std::vector<Path<Dim>> paths(vertices);
  for (const auto& b : recording.stream()) {
    Path<Dim>& path = paths[b.vertex];
    path.t.push_back(b.t);
    Point<Dim> x;
    for (int k = 0; k < Dim; ++k) x[static_cast<std::size_t>(k)] = b.x[k];
    path.x.push_back(x);
  }
  return paths;
}

/// The time of the first impulse on a body, whose vertices have breakpoints at the window's ends and at impulses.
template <int Dim>
double first_impulse(const std::vector<Path<Dim>>& paths, const std::vector<VertexId>& body) {
  double first = 1;
  for (const VertexId v : body) first = std::min(first, paths[v].t[1]);
  return first;
}

/// The first time at which the mover comes within `eta` of the resting body, rounded down to a double but otherwise
/// exact. Nullopt if it does not up to `until`, which is one of its breakpoints. All vertices of the mover must have
/// their breakpoints at the same times.
template <FeaturePair Pair, int Dim>
std::optional<double> time_within(const std::vector<Path<Dim>>& paths, const std::vector<VertexId>& mover,
                                  const std::vector<VertexId>& resting, double until) {
  const bool mover_first = mover.size() == first_size(Pair);
  const Path<Dim>& clock = paths[mover[0]];
  for (std::size_t k = 0; k + 1 < clock.t.size() && clock.t[k] < until; ++k) {
    Query<Pair, Dim> query;
    for (std::size_t i = 0; i < mover.size(); ++i) {
      const std::size_t slot = mover_first ? i : i + resting.size();
      EXPECT_EQ(paths[mover[i]].t[k], clock.t[k]);
      query.x_t0[slot] = paths[mover[i]].x[k];
      query.x_t1[slot] = paths[mover[i]].x[k + 1];
    }
    for (std::size_t i = 0; i < resting.size(); ++i) {
      const std::size_t slot = mover_first ? i + mover.size() : i;
      query.x_t0[slot] = query.x_t1[slot] = paths[resting[i]].x[0];
    }
    const auto within = first_within<Pair, Dim>(query, eta);
    if (within) return clock.t[k] + std::nextafter(within->lower() * (clock.t[k + 1] - clock.t[k]), 0.0);
  }
  return std::nullopt;
}

template <int Dim>
std::optional<double> time_within(const std::vector<Path<Dim>>& paths, const std::vector<VertexId>& mover,
                                  const std::vector<VertexId>& resting, double until) {
  if (mover.size() + resting.size() == 2) return time_within<FeaturePair::vertex_vertex>(paths, mover, resting, until);
  if constexpr (Dim == 2) return time_within<FeaturePair::vertex_edge>(paths, mover, resting, until);
  if constexpr (Dim == 3) return time_within<FeaturePair::vertex_face>(paths, mover, resting, until);
}

template <int Dim>
void expect_in_order(const Row<Dim>& row) {
  Simulation<double, Dim> simulation(row.model);
  Recording<double, Dim> recording;
  Books<double, Dim> books;
  simulation.run_window(recording, books);
  const auto paths = paths_of(recording, row.model.x.size());
  const double step = row.model.contact->materials[0].step;
  std::vector<double> first;
  for (const auto& body : row.bodies) first.push_back(first_impulse(paths, body));
  EXPECT_EQ(first[0], first[1]) << "who pushes is pushed";
  for (std::size_t j = 1; j < row.bodies.size(); ++j) {
    EXPECT_TRUE(j == 1 || first[j] > first[j - 1]);
    EXPECT_LT(first[j], 1);
    const auto within = time_within<Dim>(paths, row.bodies[j - 1], row.bodies[j], first[j]);
    ASSERT_TRUE(within) << "body " << j << " was pushed before its time";
    EXPECT_GE(first[j], *within);
    EXPECT_LE(first[j], *within + step) << "the first layer has been passed over";
    std::printf("body %d: within eta at %.6f, pushed at %.6f\n", static_cast<int>(j), *within, first[j]);
  }
  const auto s = simulation.snapshot();
  EXPECT_NEAR(s.v.back()[0], 3, 0.02) << "the last has it all";
}

TEST(Causality, PointsPassAnImpulseOnInOrder) { expect_in_order(row_of<2>(false)); }
TEST(Causality, PointsAndEdgesPassAnImpulseOnInOrder) { expect_in_order(row_of<2>(true)); }
TEST(Causality, PointsInSpacePassAnImpulseOnInOrder) { expect_in_order(row_of<3>(false)); }
TEST(Causality, PointsAndFacesPassAnImpulseOnInOrder) { expect_in_order(row_of<3>(true)); }

/// Shows that time_within() can answer no.
TEST(Causality, ARecordedMotionThatStopsShortIsNotWithin) {
  const auto judge = [](double stop) {
    const std::vector<Path<2>> paths{{{0, 1}, {{0, 0}, {stop, 0}}}, {{0, 1}, {{1, 0}, {1, 0}}}};
    return time_within<2>(paths, {0}, {1}, 1);
  };
  EXPECT_FALSE(judge(0.899));
  ASSERT_TRUE(judge(1.0));
  EXPECT_NEAR(*judge(1.0), 0.9, 1e-15);
}

}  // namespace
}  // namespace noli::integrator
