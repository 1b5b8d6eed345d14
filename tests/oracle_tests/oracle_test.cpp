// SPDX-License-Identifier: Apache-2.0
//
// Runs the oracle on motions that a reader can check by hand.
#include "oracle/oracle.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace noli::oracle {
namespace {

struct Case {
  std::string name;
  Motion motion;
  Kind kind;
  double time;  ///< of the first contact; ignored when apart
};

constexpr Coordinates o = {0, 0, 0}, x1 = {1, 0, 0}, y1 = {0, 1, 0}, z1 = {0, 0, 1}, down = {0, 0, -1},
                      inner = {0.25, 0.25, 0};

Motion vertex_face(Coordinates v0, Coordinates v1, Coordinates f0 = o, Coordinates f1 = x1, Coordinates f2 = y1) {
  return {Pair::vertex_face, 3, {v0, f0, f1, f2}, {v1, f0, f1, f2}};
}

Motion edges(Coordinates a0, Coordinates a1, Coordinates b0, Coordinates b1, Coordinates move_a) {
  const auto moved = [&](Coordinates a) { return Coordinates{a[0] + move_a[0], a[1] + move_a[1], a[2] + move_a[2]}; };
  return {Pair::edge_edge, 3, {a0, a1, b0, b1}, {moved(a0), moved(a1), b0, b1}};
}

Motion vertex_edge(int dimension, Coordinates v0, Coordinates v1, Coordinates e0, Coordinates e1) {
  return {Pair::vertex_edge, dimension, {v0, e0, e1, o}, {v1, e0, e1, o}};
}

Motion vertices(int dimension, Coordinates v0, Coordinates v1, Coordinates w) {
  return {Pair::vertex_vertex, dimension, {v0, w, o, o}, {v1, w, o, o}};
}

/// A face turns over around the vertex while a corner sweeps past: the orientation is 4 (t - 1/2)^2.
Motion tangential() {
  return {Pair::vertex_face, 3, {inner, {-1, 0, -1}, {1, 0, 1}, {0, 1, 1}}, {inner, {1, 0, 1}, {1, 0, -1}, {0, 1, -1}}};
}

std::vector<Case> cases() {
  return {
      {"face_pierced_in_its_middle", vertex_face({.25, .25, 1}, {.25, .25, -1}), Kind::crossing, .5},
      {"face_hit_at_a_third", vertex_face({.25, .25, 1}, {.25, .25, -2}), Kind::crossing, 0x1.5555555555555p-2},
      {"face_missed", vertex_face({.75, .75, 1}, {.75, .75, -1}), Kind::apart, 0},
      {"face_hit_on_an_edge", vertex_face({.5, .5, 1}, {.5, .5, -1}), Kind::touching, .5},
      {"face_hit_on_a_corner", vertex_face({0, 0, 1}, {0, 0, -1}), Kind::touching, .5},
      {"face_reached_at_the_end", vertex_face({.25, .25, 1}, inner), Kind::touching, 1},
      {"face_left_at_the_beginning", vertex_face(inner, {.25, .25, 1}), Kind::touching, 0},
      {"face_not_reached", vertex_face({.25, .25, 1}, {.25, .25, 0x1p-1074}), Kind::apart, 0},
      {"vertex_rests_on_face", vertex_face(inner, inner), Kind::persistent, 0},
      {"vertex_rests_beside_face", vertex_face({2, 2, 0}, {2, 2, 0}), Kind::apart, 0},
      {"vertex_slides_into_face", vertex_face({-1, .25, 0}, {1, .25, 0}), Kind::persistent, .5},
      {"vertex_slides_past_a_corner", vertex_face({-1, 2, 0}, {1, 0, 0}, o, {-1, 1, 0}, {0, 1, 0}), Kind::touching, .5},
      {"face_is_a_segment_and_hit", vertex_face({.5, 0, 1}, {.5, 0, -1}, o, x1, x1), Kind::touching, .5},
      {"face_is_a_segment_and_missed", vertex_face({.5, .1, 1}, {.5, .1, -1}, o, x1, x1), Kind::apart, 0},
      {"face_is_a_point_and_hit", vertex_face(z1, down, o, o, o), Kind::touching, .5},
      {"face_is_a_point_and_missed", vertex_face({.1, 0, 1}, {.1, 0, -1}, o, o, o), Kind::apart, 0},
      {"tangential_contact", tangential(), Kind::touching, .5},
      {"edges_cross", edges({-1, 0, 1}, {1, 0, 1}, {0, -1, 0}, {0, 1, 0}, {0, 0, -2}), Kind::crossing, .5},
      {"edges_miss", edges({1, 0, 1}, {2, 0, 1}, {0, -1, 0}, {0, 1, 0}, {0, 0, -2}), Kind::apart, 0},
      {"end_of_an_edge_hits", edges({0, 0, 1}, {1, 0, 1}, {0, -1, 0}, {0, 1, 0}, {0, 0, -2}), Kind::touching, .5},
      {"ends_of_edges_hit", edges({0, 0, 1}, {1, 0, 1}, o, y1, {0, 0, -2}), Kind::touching, .5},
      {"parallel_edges_pass", edges({0, 0, 1}, {1, 0, 1}, {.5, 0, 0}, {2, 0, 0}, {0, 0, -2}), Kind::touching, .5},
      {"parallel_edges_pass_beside", edges({0, 0, 1}, {1, 0, 1}, {1.5, 0, 0}, {2, 0, 0}, {0, 0, -2}), Kind::apart, 0},
      {"collinear_edges_meet", edges({-3, 0, 0}, {-1, 0, 0}, o, x1, {2, 0, 0}), Kind::persistent, .5},
      {"edges_that_cross_all_the_time", edges({-1, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 1, 0}, o), Kind::persistent, 0},
      {"edge_is_a_point", edges(z1, z1, {-1, 0, 0}, x1, {0, 0, -2}), Kind::touching, .5},
      {"vertex_hits_edge_in_space", vertex_edge(3, z1, down, {-1, 0, 0}, x1), Kind::touching, .5},
      {"vertex_misses_edge_in_space", vertex_edge(3, {0, .1, 1}, {0, .1, -1}, {-1, 0, 0}, x1), Kind::apart, 0},
      {"vertex_slides_on_edge_in_space", vertex_edge(3, {-2, 0, 0}, {2, 0, 0}, {-1, 0, 0}, x1), Kind::persistent, .25},
      {"vertex_crosses_edge_in_the_plane", vertex_edge(2, {0, 1, 7}, {0, -1, 9}, {-1, 0, 3}, x1), Kind::crossing, .5},
      {"vertex_hits_end_in_the_plane", vertex_edge(2, {1, 1, 0}, {1, -1, 0}, {-1, 0, 0}, x1), Kind::touching, .5},
      {"vertex_misses_edge_in_the_plane", vertex_edge(2, {2, 1, 0}, {2, -1, 0}, {-1, 0, 0}, x1), Kind::apart, 0},
      {"vertex_reaches_edge_at_the_end", vertex_edge(2, y1, o, {-1, 0, 0}, x1), Kind::touching, 1},
      {"vertex_rests_on_edge_in_the_plane", vertex_edge(2, o, o, {-1, 0, 0}, x1), Kind::persistent, 0},
      {"vertices_meet", vertices(3, {1, 1, 1}, {-1, -1, -1}, o), Kind::touching, .5},
      {"vertices_miss", vertices(3, {1, 1, 1}, {-1, -1, -.5}, o), Kind::apart, 0},
      {"vertices_stay_together", vertices(3, x1, x1, x1), Kind::persistent, 0},
      {"vertices_meet_in_the_plane", vertices(2, {1, 1, 1}, {-1, -1, 1}, o), Kind::touching, .5},
      {"vertices_miss_in_the_plane", vertices(2, {1, 1, 0}, {-1, -.5, 0}, o), Kind::apart, 0},
      {"vertices_stay_together_in_the_plane", vertices(2, {1, 1, 5}, {1, 1, 6}, {1, 1, 7}), Kind::persistent, 0},
  };
}

Motion reversed(Motion motion) {
  std::swap(motion.x_t0, motion.x_t1);
  return motion;
}

Motion scaled(Motion motion, double by) {
  for (auto* points : {&motion.x_t0, &motion.x_t1}) {
    for (Coordinates& x : *points) {
      for (double& coordinate : x) coordinate *= by;
    }
  }
  return motion;
}

class ByHand : public testing::TestWithParam<Case> {};

TEST_P(ByHand, KindAndTime) {
  const Answer answer = first_contact(GetParam().motion);
  EXPECT_EQ(name(answer.kind), name(GetParam().kind));
  ASSERT_EQ(answer.time.has_value(), GetParam().kind != Kind::apart);
  if (answer.time) {
    EXPECT_EQ(answer.time->lower(), GetParam().time);
  }
}

TEST_P(ByHand, ContactDoesNotDependOnTheDirectionOfTimeOrOnScale) {
  const bool contact = GetParam().kind != Kind::apart;
  EXPECT_EQ(first_contact(reversed(GetParam().motion)).kind != Kind::apart, contact);
  EXPECT_EQ(first_contact(scaled(GetParam().motion, 0x1p900)).kind, GetParam().kind);
}

TEST_P(ByHand, WithinDistanceZeroIsContact) {
  const Answer answer = first_contact(GetParam().motion);
  const auto within = first_within(GetParam().motion, 0);
  ASSERT_EQ(within.has_value(), answer.time.has_value());
  if (within) {
    EXPECT_EQ(within->compare(*answer.time), 0);
  }
}

INSTANTIATE_TEST_SUITE_P(Oracle, ByHand, testing::ValuesIn(cases()), [](const auto& test) { return test.param.name; });

TEST(Within, ComesEarlierByTheDistance) {
  const Motion above_face = vertex_face({.25, .25, 1}, {.25, .25, -1}),
               above_edge = vertex_edge(3, z1, down, {-1, 0, 0}, x1);
  const Motion crossing = edges({-1, 0, 1}, {1, 0, 1}, {0, -1, 0}, {0, 1, 0}, {0, 0, -2}),
               to_point = vertices(3, z1, down, o);
  for (const Motion& motion : {above_face, above_edge, crossing, to_point}) {
    EXPECT_EQ(first_within(motion, .5).value().lower(), .25);
    EXPECT_EQ(first_within(motion, 2).value().lower(), 0);
  }
}

TEST(Within, ReachesJustAsFarAsTheDistance) {
  // A vertex passes the corner of a face, the middle of an edge and a vertex, at distance exactly 5 = |(3, 4)|.
  const Motion corner = vertex_face({-3, -4, 1}, {-3, -4, -1}),
               line = vertex_edge(3, {0, 5, 1}, {0, 5, -1}, {-1, 0, 0}, x1);
  const Motion point = vertices(3, {3, 4, 1}, {3, 4, -1}, o);
  for (const Motion& motion : {corner, line, point}) {
    EXPECT_EQ(first_within(motion, 5).value().lower(), .5);
    EXPECT_FALSE(first_within(motion, 0x1.3ffffffffffffp+2));
  }
}

TEST(AxisSeparates, OnlyWhenTheOrderIsKept) {
  EXPECT_TRUE(axis_separates(vertex_face({.25, .25, 1}, {.25, .25, 2})));
  EXPECT_FALSE(axis_separates(vertex_face({.25, .25, 1}, {.25, .25, -1})));
  EXPECT_FALSE(axis_separates(vertex_face({.25, .25, 1}, inner)));
}

}  // namespace
}  // namespace noli::oracle
