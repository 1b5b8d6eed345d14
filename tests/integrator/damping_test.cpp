// SPDX-License-Identifier: Apache-2.0
#include "integrator/kick.h"

#include <gtest/gtest.h>

#include "integrator/books.h"
#include "tests/integrator/big.h"
#include "tests/integrator/shapes.h"

namespace noli {
namespace {

using integrator::damp;
using integrator::EdgeSpring;
using integrator::Hinge;
using integrator::Membrane;
using integrator::Turning;
using integrator::Vec;
using integrator::VertexVectors;
using test::Big;
using test::Random;

constexpr int states = 200;

/// The kinetic energy of the vertices of finite mass, with negligible rounding.
template <int Dim, std::size_t N>
Big kinetic_energy(const VertexVectors<double, Dim, N>& v, const std::array<double, N>& inverse_mass) {
  Big sum(0);
  const auto big = test::to_big(v);
  for (std::size_t i = 0; i < N; ++i) {
    if (inverse_mass[i] != 0) sum += big[i].squaredNorm() / (2 * Big(inverse_mass[i]));
  }
  return sum;
}

/// Damps, and returns the work on the vertices of finite mass: impulses times the means of velocities before and after.
template <class F, class S, int Dim, std::size_t N>
S work_of_damping(const F& force, const VertexVectors<S, Dim, N>& x, VertexVectors<S, Dim, N>& v,
                  const std::array<S, N>& inverse_mass, const S& h) {
  const auto before = v;
  const auto impulses = damp(force, x, v, inverse_mass, h);
  S work(0);
  for (std::size_t i = 0; i < N; ++i) {
    if (inverse_mass[i] != S(0)) work += S(0.5) * impulses[i].dot(before[i] + v[i]);
  }
  return work;
}

/// ds/dt of each measure.
template <class F, class X>
std::vector<double> rates(const F& force, const X& x, const X& v) {
  std::vector<double> result;
  for (const auto& g : force.measure_gradients(x)) {
    double rate = 0;
    for (std::size_t i = 0; i < v.size(); ++i) rate += g[i].dot(v[i]);
    result.push_back(rate);
  }
  return result;
}

template <class F>
class Damping : public testing::Test {
 public:
  using X = VertexVectors<double, F::dimension, F::size>;

  F force = test::random_force<F>(random);
  X x, v;
  std::array<double, F::size> inverse_mass;

  /// Draws another force in another state, with finite masses, and with damping from weak to extremely strong.
  void draw() {
    force = test::random_force<F>(random);
    force.damping = std::ldexp(1.0, random.around_zero(30));
    x = test::random_stencil<F::size, F::dimension>(random, 1);
    v = test::random_stencil<F::size, F::dimension>(random, 10);
    for (double& w : inverse_mass) w = 0.1 + 10 * random.unit();
  }

  Random random{7};
};

using AllForces =
    testing::Types<EdgeSpring<double, 2>, EdgeSpring<double, 3>, Membrane<double>, Hinge<double>, Turning<double>>;
TYPED_TEST_SUITE(Damping, AllForces);

TYPED_TEST(Damping, LowersKineticEnergyByItsWork) {
  for (int k = 0; k < states; ++k) {
    this->draw();
    if (k % 2 == 1) {  // one vertex pinned
      this->inverse_mass[0] = 0;
      this->v[0].setZero();
    }
    const Big before = kinetic_energy(this->v, this->inverse_mass);
    const double work = work_of_damping(this->force, this->x, this->v, this->inverse_mass, 0.01);
    const Big after = kinetic_energy(this->v, this->inverse_mass);
    EXPECT_LT(work, 0);
    EXPECT_LE(after, before * (1 + Big("1e-15")));
    EXPECT_LE(abs(after - before - Big(work)), before * Big("1e-14"));
  }
}

TYPED_TEST(Damping, KeepsMomenta) {
  constexpr int Dim = TypeParam::dimension;
  for (int k = 0; k < states; ++k) {
    this->draw();
    const auto before = this->v;
    damp(this->force, this->x, this->v, this->inverse_mass, 0.01);
    Vec<double, Dim> push = Vec<double, Dim>::Zero();
    integrator::Moment<double, Dim> turn = integrator::Moment<double, Dim>::Zero();
    double momentum = 0;
    for (std::size_t i = 0; i < before.size(); ++i) {
      const Vec<double, Dim> impulse = (this->v[i] - before[i]) / this->inverse_mass[i];
      push += impulse;
      turn += integrator::moment<double, Dim>(this->x[i], impulse);
      momentum += before[i].norm() / this->inverse_mass[i];
    }
    EXPECT_LE(push.cwiseAbs().maxCoeff(), 1e-14 * momentum);
    EXPECT_LE(turn.cwiseAbs().maxCoeff(), 1e-14 * momentum);
  }
}

TYPED_TEST(Damping, LeavesRigidMotionAlone) {
  constexpr int Dim = TypeParam::dimension;
  for (int k = 0; k < states; ++k) {
    this->draw();
    this->force.damping = 1e-3;
    for (std::size_t i = 0; i < this->x.size(); ++i) {
      this->v[i] = Vec<double, Dim>::Constant(1);
      this->v[i][0] -= 2 * this->x[i][1];
      this->v[i][1] += 2 * this->x[i][0];
    }
    const auto before = this->v;
    const double work = work_of_damping(this->force, this->x, this->v, this->inverse_mass, 0.01);
    double most = 0;
    for (std::size_t i = 0; i < before.size(); ++i) {
      EXPECT_LE((this->v[i] - before[i]).norm(), 1e-12);
      most = std::max(most, before[i].squaredNorm());
    }
    EXPECT_LE(std::abs(work), 1e-24 * most) << "the square of what rounding leaves of the velocities";
  }
}

TYPED_TEST(Damping, NoneWithoutDamping) {
  this->draw();
  this->force.damping = 0;
  const auto before = this->v;
  EXPECT_EQ(work_of_damping(this->force, this->x, this->v, this->inverse_mass, 0.01), 0);
  EXPECT_EQ(this->v, before);
}

TYPED_TEST(Damping, NeverTurnsARateRound) {
  if constexpr (TypeParam::measures == 1) {
    for (int k = 0; k < states; ++k) {
      this->draw();
      const double before = rates(this->force, this->x, this->v)[0];
      double a = 0;
      const auto g = this->force.measure_gradients(this->x)[0];
      for (std::size_t i = 0; i < g.size(); ++i) a += this->inverse_mass[i] * g[i].squaredNorm();
      damp(this->force, this->x, this->v, this->inverse_mass, 0.01);
      const double hba = 0.01 * this->force.damping * this->force.stiffness()[0] * a;
      EXPECT_NEAR(rates(this->force, this->x, this->v)[0], before / (1 + hba), 1e-13 * std::abs(before) + 1e-12);
    }
  }
}

/// Measures are damped in turn: the last one keeps the rate that its own impulse leaves, which disturbs the others.
TEST(MembraneDampingTest, TheLastMeasureIsDampedLast) {
  Random random(3);
  auto membrane = test::random_force<Membrane<double>>(random);
  membrane.damping = 1e12;
  const auto x = test::random_stencil<3, 3>(random, 1);
  auto v = test::random_stencil<3, 3>(random, 1);
  const auto before = rates(membrane, x, v);
  damp(membrane, x, v, {1, 2, 3}, 0.01);
  const auto after = rates(membrane, x, v);
  EXPECT_LE(std::abs(after[2]), 1e-9 * std::abs(before[2]));
  EXPECT_GE(std::abs(after[0]), 1e-3 * std::abs(before[0]));
}

/// A scripted vertex keeps its velocity and drags the free one, whose gain in energy is the positive work.
TEST(ScriptedDampingTest, WorkOnTheFreeOnes) {
  const EdgeSpring<double, 2> spring{{0, 1}, 3, 1, 100};
  VertexVectors<double, 2, 2> v = {Vec<double, 2>(-5, 1), {0, 0}};
  const VertexVectors<double, 2, 2> x = {Vec<double, 2>(0, 0), {2, 0}};
  const std::array<double, 2> inverse_mass = {0, 0.5};
  const double work = work_of_damping(spring, x, v, inverse_mass, 0.01);
  EXPECT_EQ(v[0], (Vec<double, 2>(-5, 1)));
  EXPECT_LT(v[1][0], 0);
  EXPECT_GT(v[1][0], -5);
  EXPECT_GT(work, 0);
  EXPECT_NEAR(work, v[1].squaredNorm(), 1e-15);
}

TEST(DegenerateDampingTest, NoDirectionNoImpulse) {
  Random random(4);
  const auto hinge = test::random_force<Hinge<double>>(random);
  auto v = test::random_stencil<4, 3>(random, 1);
  const auto before = v;
  const std::array<double, 4> inverse_mass = {1, 1, 1, 1};
  EXPECT_EQ(work_of_damping(hinge, test::random_stencil<4, 3>(random, 0), v, inverse_mass, 0.01), 0);
  EXPECT_EQ(v, before);
}

}  // namespace
}  // namespace noli
