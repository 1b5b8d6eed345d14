// SPDX-License-Identifier: Apache-2.0
//
// Compares the gradients of each force and of its measures with differences in 60 digits, and tests that rigid motions
// leave forces unchanged.
#include <gtest/gtest.h>

#include <boost/math/constants/constants.hpp>
#include <vector>

#include "integrator/books.h"
#include "integrator/model.h"
#include "tests/integrator/big.h"
#include "tests/integrator/shapes.h"

namespace noli {
namespace {

using integrator::EdgeSpring;
using integrator::Hinge;
using integrator::Membrane;
using integrator::Turning;
using integrator::Vec;
using integrator::VertexVectors;
using test::Big;
using test::greatest;
using test::Random;

template <class S, int Dim, std::size_t N>
VertexVectors<S, Dim, N> minus(const VertexVectors<S, Dim, N>& a, const VertexVectors<S, Dim, N>& b) {
  VertexVectors<S, Dim, N> result;
  for (std::size_t i = 0; i < N; ++i) result[i] = a[i] - b[i];
  return result;
}

/// Central differences of a function of a stencil; their error is of the order of 1e-38.
template <class Function, int Dim, std::size_t N>
VertexVectors<Big, Dim, N> differences(const Function& f, VertexVectors<Big, Dim, N> x) {
  const Big step("1e-20");
  VertexVectors<Big, Dim, N> result;
  for (std::size_t i = 0; i < N; ++i) {
    for (int d = 0; d < Dim; ++d) {
      const Big at = x[i][d];
      x[i][d] = at + step;
      const Big above = f(x);
      x[i][d] = at - step;
      result[i][d] = (above - f(x)) / (2 * step);
      x[i][d] = at;
    }
  }
  return result;
}

Big square_length(const Vec<Big, 3>& v) { return v.squaredNorm(); }

Big arc_tangent(const Big& sine, const Big& cosine) { return boost::multiprecision::atan2(sine, cosine); }

/// The measures of the forces, implemented independently.
template <int Dim>
std::vector<Big> measures(const EdgeSpring<Big, Dim>&, const VertexVectors<Big, Dim, 2>& x) {
  return {boost::multiprecision::sqrt((x[1] - x[0]).squaredNorm())};
}

std::vector<Big> measures(const Membrane<Big>& f, const VertexVectors<Big, 3, 3>& x) {
  // Rest edges r, s in the plane; Green strain from the changes of squared lengths.
  const Big r = 1 / f.b11, sy = 1 / f.b22, sx = -f.b12 * r * sy;
  const Big rr = square_length(x[1] - x[0]) - r * r, ss = square_length(x[2] - x[0]) - (sx * sx + sy * sy);
  const Big rs = (x[1] - x[0]).dot(x[2] - x[0]) - r * sx;
  const Big e11 = rr / (2 * r * r), e12 = (rs / 2 - e11 * r * sx) / (r * sy);
  return {e11, (ss / 2 - e11 * sx * sx - 2 * e12 * sx * sy) / (sy * sy), e12};
}

std::vector<Big> measures(const Hinge<Big>&, const VertexVectors<Big, 3, 4>& x) {
  const Vec<Big, 3> e = x[1] - x[0], n1 = (x[0] - x[2]).cross(x[1] - x[2]), n2 = (x[1] - x[3]).cross(x[0] - x[3]);
  const Big length = boost::multiprecision::sqrt(e.squaredNorm());
  return {arc_tangent(n1.cross(n2).dot(e) / length, n1.dot(n2))};
}

std::vector<Big> measures(const Turning<Big>&, const VertexVectors<Big, 2, 3>& x) {
  const Vec<Big, 2> a = x[1] - x[0], b = x[2] - x[1];
  return {arc_tangent(a[0] * b[1] - a[1] * b[0], a.dot(b))};
}

template <class F>
class Elastic : public testing::Test {
 public:
  static constexpr std::size_t size = F::size;
  using X = VertexVectors<double, F::dimension, size>;
  static F force(Random& random) { return test::random_force<F>(random); }
  static X shape(Random& random) { return test::random_stencil<size, F::dimension>(random, 1); }
};

using AllForces =
    testing::Types<EdgeSpring<double, 2>, EdgeSpring<double, 3>, Membrane<double>, Hinge<double>, Turning<double>>;
TYPED_TEST_SUITE(Elastic, AllForces);

TYPED_TEST(Elastic, GradientIsThatOfTheEnergy) {
  Random random(1);
  for (int i = 0; i < test::shape_count; ++i) {
    const auto force = this->force(random);
    const auto x = this->shape(random);
    const auto big = test::convert<Big>(force);
    const auto expected = differences([&](const auto& at) { return big.energy(at); }, test::to_big(x));
    const Big scale = greatest(expected);
    EXPECT_LE(greatest(minus(big.gradient(test::to_big(x)), expected)), Big("1e-30") * scale);
    EXPECT_LE(greatest(minus(test::to_big(force.gradient(x)), expected)), Big("1e-12") * scale);
  }
}

TYPED_TEST(Elastic, MeasureGradientsAreThoseOfTheMeasures) {
  Random random(2);
  for (int i = 0; i < test::shape_count; ++i) {
    const auto force = this->force(random);
    const auto x = this->shape(random);
    const auto big = test::convert<Big>(force);
    const auto gradients = big.measure_gradients(test::to_big(x));
    for (std::size_t j = 0; j < gradients.size(); ++j) {
      const auto expected = differences([&](const auto& at) { return measures(big, at)[j]; }, test::to_big(x));
      EXPECT_LE(greatest(minus(gradients[j], expected)), Big("1e-30") * greatest(expected)) << "measure " << j;
    }
  }
}

/// Measures minus their values at rest.
template <int Dim>
std::vector<Big> strains(const EdgeSpring<Big, Dim>& f, const VertexVectors<Big, Dim, 2>& x) {
  return {measures(f, x)[0] - f.rest_length};
}

std::vector<Big> strains(const Membrane<Big>& f, const VertexVectors<Big, 3, 3>& x) { return measures(f, x); }

template <class F, int Dim, std::size_t N>
std::vector<Big> strains(const F& f, const VertexVectors<Big, Dim, N>& x) {
  const Big& half_turn = boost::math::constants::pi<Big>();
  Big delta = measures(f, x)[0] - arc_tangent(f.rest.sine, f.rest.cosine);
  if (delta > half_turn) delta -= 2 * half_turn;
  if (delta < -half_turn) delta += 2 * half_turn;
  return {delta};
}

/// The energy is at most that of springs on the measures with the stiffness used by the step estimates.
TYPED_TEST(Elastic, StiffnessBoundsTheEnergy) {
  Random random(3);
  for (int i = 0; i < test::shape_count; ++i) {
    const auto force = test::convert<Big>(this->force(random));
    const auto x = test::to_big(this->shape(random));
    const auto s = strains(force, x);
    Big bound(0);
    for (std::size_t j = 0; j < s.size(); ++j) bound += force.stiffness()[j] * s[j] * s[j] / 2;
    EXPECT_GT(force.energy(x), 0);
    EXPECT_LE(force.energy(x), bound * (1 + Big("1e-30")));
    EXPECT_GE(force.energy(x), bound / 50) << "the bound is idle";
  }
}

TYPED_TEST(Elastic, NeitherPushesNorTurnsAsAWhole) {
  constexpr int Dim = TypeParam::dimension;
  Random random(4);
  for (int i = 0; i < test::shape_count; ++i) {
    const auto force = this->force(random);
    const auto x = this->shape(random);
    auto all = force.measure_gradients(x);
    const auto check = [&](const auto& g) {
      Vec<double, Dim> sum = Vec<double, Dim>::Zero();
      integrator::Moment<double, Dim> turn = integrator::Moment<double, Dim>::Zero();
      for (std::size_t k = 0; k < g.size(); ++k) {
        sum += g[k];
        turn += integrator::moment<double, Dim>(x[k], g[k]);
      }
      EXPECT_LE(sum.cwiseAbs().maxCoeff(), 1e-15 * greatest(g));
      EXPECT_LE(turn.cwiseAbs().maxCoeff(), 1e-13 * greatest(g));
    };
    check(force.gradient(x));
    for (const auto& g : all) check(g);
  }
}

}  // namespace
}  // namespace noli
