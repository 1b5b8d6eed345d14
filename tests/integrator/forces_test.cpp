// SPDX-License-Identifier: Apache-2.0
//
// Compares each force with closed forms, and tests it at rest and in degenerate shapes without a direction.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "integrator/model.h"
#include "tests/integrator/shapes.h"

namespace noli {
namespace {

using integrator::Angle;
using integrator::Hinge;
using integrator::Membrane;
using integrator::Turning;
using integrator::Vec;
using integrator::VertexVectors;
using test::greatest;
using test::Random;

/// A rotation by 36.87... degrees (cosine 0.8, sine 0.6) and a translation.
Vec<double, 3> moved(const Vec<double, 3>& x) {
  return {0.8 * x[0] - 0.6 * x[1] + 3, 0.6 * x[0] + 0.8 * x[1] - 2, x[2] + 1};
}
Vec<double, 2> moved(const Vec<double, 2>& x) { return {0.8 * x[0] - 0.6 * x[1] + 3, 0.6 * x[0] + 0.8 * x[1] - 2}; }

template <class F>
void expect_no_force_at_rest(const F& force, VertexVectors<double, F::dimension, F::size> rest, double scale) {
  for (const bool move : {false, true}) {
    if (move) {
      for (auto& point : rest) point = moved(point);
    }
    EXPECT_LE(greatest(force.gradient(rest)), 1e-12 * scale);
    EXPECT_LE(force.energy(rest), 1e-24 * scale);
  }
}

TEST(RestTest, NoForceWhereTheForceWasMade) {
  Random random(5);
  for (int i = 0; i < test::shape_count; ++i) {
    // A perturbed, scaled unit shape, so that it is not a sliver.
    const auto r = test::random_stencil<4, 3>(random, 0.2);
    const Vec<double, 3>& x0 = r[0];
    const Vec<double, 3> x1 = r[1] + Vec<double, 3>(1, 0, 0), x2 = r[2] + Vec<double, 3>(0, 1, 0),
                         x3 = r[3] + Vec<double, 3>(0.5, -1, 0.5);
    expect_no_force_at_rest(Membrane<double>::from_rest({0, 1, 2}, {x0, x1, x2}, {1, 0.3, 1}), {x0, x1, x2}, 10);
    expect_no_force_at_rest(Hinge<double>::from_rest({0, 1, 2, 3}, {x0, x1, x2, x3}, 1), {x0, x1, x2, x3}, 10);
    const VertexVectors<double, 2, 3> row = {x0.head<2>(), x1.head<2>(), x2.head<2>()};
    expect_no_force_at_rest(Turning<double>::from_rest({0, 1, 2}, row, 1), row, 10);
  }
}

TEST(MembraneTest, EnergyOfAStretchedTriangle) {
  const double E = 7, nu = 0.25, th = 0.5;
  const VertexVectors<double, 3, 3> rest = {Vec<double, 3>(0, 0, 0), {2, 0, 0}, {0.5, 1, 0}};
  const auto membrane = Membrane<double>::from_rest({0, 1, 2}, rest, {E, nu, th});
  const auto stretched = [&](double p, double q, double shear) {
    VertexVectors<double, 3, 3> x;
    for (std::size_t i = 0; i < 3; ++i) x[i] = {p * rest[i][0] + shear * rest[i][1], 1, q * rest[i][1]};
    return x;
  };
  const double area = 1, mu = E / (2 * (1 + nu)), lambda = E * nu / (1 - nu * nu);
  for (const double p : {0.5, 1.0, 1.5}) {
    for (const double q : {0.0, 1.0, 1.25}) {
      for (const double g : {-0.5, 0.0, 0.25}) {
        const double e11 = (p * p - 1) / 2, e22 = (g * g + q * q - 1) / 2, e12 = p * g / 2;
        const double expected =
            th * area * (mu * (e11 * e11 + e22 * e22 + 2 * e12 * e12) + lambda / 2 * (e11 + e22) * (e11 + e22));
        EXPECT_NEAR(membrane.energy(stretched(p, q, g)), expected, 1e-14);
      }
    }
  }
}

/// Stretched along one axis and free across it, a small strain e has the energy E/2 e^2 per volume: nu drops out.
TEST(MembraneTest, UniaxialStressMeasuresYoungsModulus) {
  const double E = 7, nu = 0.25, e = 1e-5;
  const VertexVectors<double, 3, 3> rest = {Vec<double, 3>(0, 0, 0), {2, 0, 0}, {0.5, 1, 0}};
  auto x = rest;
  for (auto& point : x) point = {(1 + e) * point[0], (1 - nu * e) * point[1], 0};
  EXPECT_NEAR(Membrane<double>::from_rest({0, 1, 2}, rest, {E, nu, 0.5}).energy(x) / (E / 2 * e * e * 0.5), 1, 1e-4);
}

/// The edge is along y; side 1 points to -x, side 2 is rotated up from +x by theta.
VertexVectors<double, 3, 4> folded(double theta) {
  return {Vec<double, 3>(0, 0, 0), {0, 2, 0}, {-1, 0.5, 0}, {1.5 * std::cos(theta), 1, 1.5 * std::sin(theta)}};
}

/// Two segments with a turn by phi.
VertexVectors<double, 2, 3> turned(double phi) {
  return {Vec<double, 2>(-2, 0), {0, 0}, {1.5 * std::cos(phi), 1.5 * std::sin(phi)}};
}

using std::numbers::pi;

TEST(HingeTest, EnergyOfAFoldedHinge) {
  const double rigidity = 3, K = rigidity * 4 / 2.5;  // L0 = 2; areas 1 and 1.5
  for (const double theta0 : {-2.5, -0.5, 0.0, 1.0, 3.0}) {
    const auto hinge = Hinge<double>::from_rest({0, 1, 2, 3}, folded(theta0), rigidity);
    EXPECT_NEAR(hinge.constant, K, 1e-14);
    for (const double theta : {-3.0, -1.0, -0.1, 0.0, 0.2, 1.5, 2.9}) {
      EXPECT_NEAR(hinge.energy(folded(theta)), K * (1 - std::cos(theta - theta0)), 1e-13);
    }
  }
}

/// Folding towards the normals is a negative angle.
TEST(HingeTest, SignOfTheAngle) {
  const auto up = Hinge<double>::from_rest({0, 1, 2, 3}, folded(0.5), 1);
  const auto flat = Hinge<double>::from_rest({0, 1, 2, 3}, folded(0), 1);
  const auto down = Hinge<double>::from_rest({0, 1, 2, 3}, folded(-0.5), 1);
  EXPECT_NEAR(up.rest.sine, -std::sin(0.5), 1e-15);
  EXPECT_NEAR(down.rest.sine, std::sin(0.5), 1e-15);
  EXPECT_NEAR(up.rest.cosine, std::cos(0.5), 1e-15);
  EXPECT_GT(flat.gradient(folded(0.5))[3][2], 0);   // energy rises upward
  EXPECT_LT(flat.gradient(folded(-0.5))[3][2], 0);  // and downward
  EXPECT_LT(up.gradient(folded(0))[3][2], 0);
  EXPECT_GT(down.gradient(folded(0))[3][2], 0);
}

TEST(HingeTest, SmallAnglesKeepTheirDigits) {
  const auto hinge = Hinge<double>::from_rest({0, 1, 2, 3}, folded(0), 1);
  EXPECT_NEAR(hinge.energy(folded(1e-9)) / (hinge.constant / 2 * 1e-18), 1, 1e-12);
}

/// A regular mesh on a cylinder has rigidity/2 times the squared curvature per area.
TEST(HingeTest, ABentStripHasTheEnergyOfAPlate) {
  const double rigidity = 3, curvature = 0.01;
  // The three edges of a rectangle of 1 x 0.7 (diagonal, upright, level); its pattern tiles the plane.
  const auto at = [&](double x, double y) { return Vec<double, 3>(x, y, curvature * x * x / 2); };
  const auto energy = [&](std::array<std::array<double, 2>, 4> p) {
    VertexVectors<double, 3, 4> rest, bent;
    for (std::size_t i = 0; i < 4; ++i) {
      rest[i] = {p[i][0], p[i][1], 0};
      bent[i] = at(p[i][0], p[i][1]);
    }
    return Hinge<double>::from_rest({0, 1, 2, 3}, rest, rigidity).energy(bent);
  };
  const double b = 0.7, area = b;
  const double sum = energy({{{0, 0}, {1, b}, {0, b}, {1, 0}}}) + energy({{{0, 0}, {0, b}, {-1, 0}, {1, b}}}) +
                     energy({{{0, 0}, {1, 0}, {1, b}, {0, -b}}});
  EXPECT_NEAR(sum / area, rigidity / 2 * curvature * curvature, 1e-3 * rigidity * curvature * curvature);
  // Equilateral triangles: three edges for two triangles.
  const double s = 1, h = s * std::sqrt(3) / 2;
  const double equilateral = energy({{{0, 0}, {s, 0}, {s / 2, h}, {s / 2, -h}}}) +
                             energy({{{0, 0}, {s / 2, h}, {-s / 2, h}, {s, 0}}}) +
                             energy({{{0, 0}, {-s / 2, h}, {-s, 0}, {s / 2, h}}});
  EXPECT_NEAR(equilateral / (s * h), rigidity / 2 * curvature * curvature, 1e-3 * rigidity * curvature * curvature);
}

TEST(HingeTest, FlexuralRigidity) { EXPECT_DOUBLE_EQ(integrator::flexural_rigidity(12.0, 0.5, 2.0), 8 / 0.75); }

TEST(TurningTest, EnergyOfATurn) {
  const double rigidity = 3, K = rigidity / 1.75;
  for (const double phi0 : {-2.5, 0.0, 1.0}) {
    const auto turning = Turning<double>::from_rest({0, 1, 2}, turned(phi0), rigidity);
    EXPECT_NEAR(turning.constant, K, 1e-14);
    EXPECT_NEAR(turning.rest.sine, std::sin(phi0), 1e-15);  // positive to the left
    EXPECT_NEAR(turning.rest.cosine, std::cos(phi0), 1e-15);
    for (const double phi : {-3.0, -0.1, 0.0, 1.5, 2.9}) {
      EXPECT_NEAR(turning.energy(turned(phi)), K * (1 - std::cos(phi - phi0)), 1e-13);
    }
  }
  const auto straight = Turning<double>::from_rest({0, 1, 2}, turned(0), 1);
  EXPECT_GT(straight.gradient(turned(0.5))[2][1], 0);
  EXPECT_LT(straight.gradient(turned(-0.5))[2][1], 0);
}

/// The moment is greatest at a right angle from rest, and decreases beyond.
TEST(TurningTest, WeakensBeyondARightAngle) {
  const auto straight = Turning<double>::from_rest({0, 1, 2}, turned(0), 1);
  const auto moment = [&](double phi) {
    return greatest(straight.gradient(turned(phi))) / greatest(straight.measure_gradients(turned(phi))[0]);
  };
  EXPECT_LT(moment(1.2), moment(pi / 2));
  EXPECT_LT(moment(2.0), moment(pi / 2));
  EXPECT_LT(moment(pi), 1e-15);
}

template <int Dim, std::size_t N>
void expect_zero(const VertexVectors<double, Dim, N>& x) {
  for (const auto& point : x) EXPECT_EQ(point, (Vec<double, Dim>::Zero()));
}

TEST(DegenerateTest, NoAngleNoForce) {
  const auto hinge = Hinge<double>::from_rest({0, 1, 2, 3}, folded(1), 1);
  const Vec<double, 3> o(0, 0, 0), p(1, 0, 0), q(0, 1, 0), r(3, 0, 0);
  for (const VertexVectors<double, 3, 4>& x : {VertexVectors<double, 3, 4>{o, o, o, o},
                                               {o, p, r, q},
                                               {o, p, q, r},
                                               {o, o, p, q},
                                               {o, p, o, q},
                                               {1e-200 * o, 1e-200 * p, 1e-200 * q, -1e-200 * q}}) {
    expect_zero(hinge.gradient(x));
    expect_zero(hinge.measure_gradients(x)[0]);
    EXPECT_EQ(hinge.energy(x), hinge.constant);
  }
  const auto turning = Turning<double>::from_rest({0, 1, 2}, turned(1), 1);
  const Vec<double, 2> a(1, 2), b(3, 5);
  for (const VertexVectors<double, 2, 3>& x : {VertexVectors<double, 2, 3>{a, a, a}, {a, a, b}, {a, b, b}}) {
    expect_zero(turning.gradient(x));
    expect_zero(turning.measure_gradients(x)[0]);
    EXPECT_EQ(turning.energy(x), turning.constant);
  }
  // Folded back on itself, the angle exists, and so does a force unless the angle is opposite to the rest angle.
  EXPECT_GT(greatest(turning.gradient({a, b, a})), 0);
}

TEST(DegenerateTest, ACrushedTrianglePushesBack) {
  const Vec<double, 3> o(0, 0, 0), p(1, 0, 0), q(0, 1, 0);
  const auto membrane = Membrane<double>::from_rest({0, 1, 2}, {o, p, q}, {1, 0.3, 1});
  EXPECT_TRUE(std::isfinite(membrane.energy({o, p, 0.5 * p})));
  EXPECT_GT(greatest(membrane.gradient({o, p, 0.5 * p})), 0);
  expect_zero(membrane.gradient({o, o, o}));  // no direction for a force
}

TEST(DegenerateTest, RestShapesWithoutShapeAreRefused) {
  const Vec<double, 3> o(0, 0, 0), p(0.1, 0.2, 0.3), q(1, 0, 1), r = 3 * p, far(1e200, 0, 0);
  const double infinite = std::numeric_limits<double>::infinity(), none = std::numeric_limits<double>::quiet_NaN();
  const auto membrane = [](auto... x) { return Membrane<double>::from_rest({0, 1, 2}, {x...}, {1, 0.3, 1}); };
  EXPECT_NO_THROW(membrane(o, p, q));
  EXPECT_THROW(membrane(o, o, q), std::invalid_argument);
  EXPECT_THROW(membrane(o, p, o), std::invalid_argument);
  EXPECT_THROW(membrane(o, q, q), std::invalid_argument);
  EXPECT_THROW(membrane(o, p, r), std::invalid_argument);
  EXPECT_THROW(membrane(o, p, far), std::invalid_argument);
  EXPECT_THROW(membrane(o, p, Vec<double, 3>(none, 0, 0)), std::invalid_argument);
  EXPECT_THROW(membrane(o, p, Vec<double, 3>(infinite, 0, 0)), std::invalid_argument);
  const auto hinge = [](auto... x) { return Hinge<double>::from_rest({0, 1, 2, 3}, {x...}, 1); };
  EXPECT_NO_THROW(hinge(o, p, q, Vec<double, 3>(-q)));
  EXPECT_THROW(hinge(o, o, q, q), std::invalid_argument);
  EXPECT_THROW(hinge(o, p, q, r), std::invalid_argument);
  EXPECT_THROW(hinge(o, p, r, q), std::invalid_argument);
  EXPECT_THROW(hinge(o, p, q, far), std::invalid_argument);
  EXPECT_THROW(hinge(o, p, q, Vec<double, 3>(none, 0, 0)), std::invalid_argument);
  const auto turning = [](auto... x) { return Turning<double>::from_rest({0, 1, 2}, {x...}, 1); };
  const Vec<double, 2> a(0.1, 0.2), b(3, 5);
  EXPECT_NO_THROW(turning(a, b, a));
  EXPECT_THROW(turning(a, a, b), std::invalid_argument);
  EXPECT_THROW(turning(a, b, b), std::invalid_argument);
  EXPECT_THROW(turning(a, b, Vec<double, 2>(none, 0)), std::invalid_argument);
  EXPECT_THROW(turning(a, b, Vec<double, 2>(1e200, 0)), std::invalid_argument);
}

TEST(AngleTest, DifferenceAndOneMinusCosine) {
  const auto angle = [](double t) { return Angle<double>{std::cos(t), std::sin(t)}; };
  for (const double t : {-3.0, -1.0, 0.0, 0.5, 2.0}) {
    for (const double u : {-2.0, 0.25, 3.0}) {
      const auto difference = angle(t) - angle(u);
      EXPECT_NEAR(difference.cosine, std::cos(t - u), 1e-15);
      EXPECT_NEAR(difference.sine, std::sin(t - u), 1e-15);
    }
    EXPECT_NEAR(integrator::one_minus_cosine(angle(t)), 1 - std::cos(t), 1e-15);
  }
}

}  // namespace
}  // namespace noli
