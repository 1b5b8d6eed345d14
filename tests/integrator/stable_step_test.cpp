// SPDX-License-Identifier: Apache-2.0
//
// Compares the estimated limits of steps with the true limit, 2 / omega_max of the assembled system, and that limit
// with the behaviour of a mesh stepped below and above it.
#include "integrator/stable_step.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <limits>

#include "tests/integrator/shapes.h"

namespace noli {
namespace {

using integrator::EdgeSpring;
using integrator::ForceList;
using integrator::Hinge;
using integrator::Membrane;
using integrator::Turning;
using integrator::Vec;
using integrator::VertexVectors;
using test::Random;

template <int Dim>
using Points = std::vector<Vec<double, Dim>>;

template <class F>
VertexVectors<double, F::dimension, F::size> at(const F& force, const Points<F::dimension>& x) {
  VertexVectors<double, F::dimension, F::size> result;
  for (std::size_t i = 0; i < F::size; ++i) result[i] = x[force.vertices[i]];
  return result;
}

/// Forces of one kind on particles.
template <class F>
struct System {
  static constexpr int Dim = F::dimension;
  ForceList<F> list;
  Points<Dim> x;
  std::vector<double> inverse_mass;

  Points<Dim> gradient(const Points<Dim>& y) const {
    Points<Dim> sum(y.size(), Vec<double, Dim>::Zero());
    for (const F& force : list.forces) {
      const auto g = force.gradient(at(force, y));
      for (std::size_t i = 0; i < F::size; ++i) sum[force.vertices[i]] += g[i];
    }
    return sum;
  }

  /// M^-1/2 Hess V M^-1/2 at x, computed by differences.
  Eigen::MatrixXd dynamical_matrix() const {
    const auto n = static_cast<Eigen::Index>(x.size()) * Dim;
    const double step = 1e-6;
    Eigen::MatrixXd matrix(n, n);
    for (Eigen::Index column = 0; column < n; ++column) {
      Points<Dim> above = x, below = x;
      above[static_cast<std::size_t>(column / Dim)][column % Dim] += step;
      below[static_cast<std::size_t>(column / Dim)][column % Dim] -= step;
      const auto g1 = gradient(above), g0 = gradient(below);
      for (Eigen::Index row = 0; row < n; ++row) {
        const auto i = static_cast<std::size_t>(row / Dim), k = static_cast<std::size_t>(column / Dim);
        matrix(row, column) =
            (g1[i][row % Dim] - g0[i][row % Dim]) / (2 * step) * std::sqrt(inverse_mass[i] * inverse_mass[k]);
      }
    }
    return (matrix + matrix.transpose()) / 2;
  }

  double true_limit() const {
    return 2 / std::sqrt(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(dynamical_matrix()).eigenvalues().maxCoeff());
  }

  double estimated_limit() const {
    const auto limits = integrator::stable_steps(list, x, inverse_mass, 1);
    return *std::min_element(limits.begin(), limits.end());
  }

  /// The growth of a small disturbance in `steps` steps of Verlet's method.
  double growth(double h, int steps) const {
    const double size = 1e-12;
    Random random(9);
    Points<Dim> y = x, v(x.size(), Vec<double, Dim>::Zero());
    for (std::size_t i = 0; i < x.size(); ++i) {
      for (int d = 0; d < Dim; ++d) v[i][d] = inverse_mass[i] == 0 ? 0 : size / h * (2 * random.unit() - 1);
    }
    double greatest = 0;
    for (int k = 0; k < steps; ++k) {
      for (std::size_t i = 0; i < x.size(); ++i) y[i] += h * v[i];
      const auto g = gradient(y);
      for (std::size_t i = 0; i < x.size(); ++i) {
        v[i] -= (h * inverse_mass[i]) * g[i];
        greatest = std::max(greatest, h * v[i].norm());
      }
    }
    return greatest / size;
  }
};

/// A sheet of 5 x 4 vertices, perturbed in all directions; vertex (i, j) has the number 5 j + i.
struct Sheet {
  static constexpr VertexId columns = 5, rows = 4;
  Points<3> x;
  std::vector<double> inverse_mass;

  Sheet(double unevenness, bool pinned) {
    Random random(11);
    const auto jitter = [&] { return unevenness * (random.unit() - 0.5); };
    for (VertexId j = 0; j < rows; ++j) {
      for (VertexId i = 0; i < columns; ++i) {
        x.emplace_back(i + jitter(), j + jitter(), jitter());
        inverse_mass.push_back(pinned && j == 0 ? 0 : 1 + unevenness * random.unit());
      }
    }
  }
  static VertexId id(VertexId i, VertexId j) { return columns * j + i; }

  /// Calls use(a, b, c) for each triangle, with its right angle, if it has one, at b.
  template <class Use>
  static void triangles(const Use& use) {
    for (VertexId j = 0; j + 1 < rows; ++j) {
      for (VertexId i = 0; i + 1 < columns; ++i) {
        use(id(i, j), id(i + 1, j), id(i + 1, j + 1));
        use(id(i + 1, j + 1), id(i, j + 1), id(i, j));
      }
    }
  }

  /// Calls use(a, b, c, d) for each edge ab between two triangles abc and bad.
  template <class Use>
  static void folds(const Use& use) {
    for (VertexId j = 0; j < rows; ++j) {
      for (VertexId i = 0; i < columns; ++i) {
        const bool right = i + 1 < columns, up = j + 1 < rows;
        if (right && up) use(id(i, j), id(i + 1, j + 1), id(i, j + 1), id(i + 1, j));
        if (right && up && j > 0) use(id(i, j), id(i + 1, j), id(i + 1, j + 1), id(i, j - 1));
        if (right && up && i > 0) use(id(i, j + 1), id(i, j), id(i + 1, j + 1), id(i - 1, j));
      }
    }
  }
};

System<Membrane<double>> membranes(const Sheet& sheet) {
  System<Membrane<double>> system{{}, sheet.x, sheet.inverse_mass};
  Sheet::triangles([&](VertexId a, VertexId b, VertexId c) {
    system.list.add(Membrane<double>::from_rest({a, b, c}, {sheet.x[a], sheet.x[b], sheet.x[c]}, {100, 0.3, 0.1}), 1);
  });
  return system;
}

System<Hinge<double>> hinges(const Sheet& sheet) {
  System<Hinge<double>> system{{}, sheet.x, sheet.inverse_mass};
  Sheet::folds([&](VertexId a, VertexId b, VertexId c, VertexId d) {
    const VertexVectors<double, 3, 4> rest = {sheet.x[a], sheet.x[b], sheet.x[c], sheet.x[d]};
    system.list.add(Hinge<double>::from_rest({a, b, c, d}, rest, 1), 1);
  });
  return system;
}

System<EdgeSpring<double, 3>> springs(const Sheet& sheet) {
  System<EdgeSpring<double, 3>> system{{}, sheet.x, sheet.inverse_mass};
  const auto add = [&](VertexId a, VertexId b) {
    system.list.add({{a, b}, 10, (sheet.x[a] - sheet.x[b]).norm(), 0}, 1);
  };
  Sheet::triangles([&](VertexId a, VertexId b, VertexId c) {
    add(a, b);  // border sides once, others twice, so springs are not all equal
    add(b, c);
    add(c, a);
  });
  return system;
}

System<Turning<double>> turnings(double unevenness, bool pinned) {
  System<Turning<double>> system;
  Random random(12);
  for (VertexId i = 0; i < 12; ++i) {
    system.x.emplace_back(i + unevenness * (random.unit() - 0.5), unevenness * (random.unit() - 0.5));
    system.inverse_mass.push_back(pinned && i == 0 ? 0 : 1 + unevenness * random.unit());
  }
  for (VertexId i = 0; i + 2 < 12; ++i) {
    const VertexVectors<double, 2, 3> rest = {system.x[i], system.x[i + 1], system.x[i + 2]};
    system.list.add(Turning<double>::from_rest({i, i + 1, i + 2}, rest, 1), 1);
  }
  return system;
}

template <class F>
void expect_safe_and_useful(const System<F>& system, const char* what) {
  const double limit = system.true_limit(), estimate = system.estimated_limit();
  EXPECT_LE(estimate, limit) << what;
  EXPECT_GE(estimate, limit / 3) << what;
  EXPECT_LE(system.growth(estimate, 1000), 100) << what;
  EXPECT_LE(system.growth(0.99 * limit, 1000), 100) << what;
  EXPECT_GE(system.growth(1.02 * limit, 60), 1e4) << what;
}

TEST(StableStepTest, EstimatesAreBelowTheTrueLimitAndNotFarBelow) {
  for (const double unevenness : {0.0, 0.5}) {
    for (const bool pinned : {false, true}) {
      SCOPED_TRACE(testing::Message() << "unevenness " << unevenness << (pinned ? ", pinned" : ""));
      const Sheet sheet(unevenness, pinned);
      expect_safe_and_useful(springs(sheet), "springs");
      expect_safe_and_useful(membranes(sheet), "membranes");
      expect_safe_and_useful(hinges(sheet), "hinges");
      expect_safe_and_useful(turnings(unevenness, pinned), "turnings");
    }
  }
}

/// One spring between two equal masses has omega^2 = 2 k / m, which is also the sum of kappa.
TEST(StableStepTest, OneSpring) {
  System<EdgeSpring<double, 2>> system;
  system.x = {{0, 0}, {1, 0}};
  system.inverse_mass = {0.5, 0.5};
  system.list.add({{0, 1}, 8, 1, 0}, 1);
  const double limit = 2 / std::sqrt(2 * 8 * 0.5);
  EXPECT_NEAR(system.true_limit(), limit, 1e-6);
  EXPECT_DOUBLE_EQ(system.estimated_limit(), limit / std::sqrt(2));
  EXPECT_DOUBLE_EQ(integrator::stable_steps(system.list, system.x, system.inverse_mass)[0], limit / std::sqrt(2) / 2);
  EXPECT_DOUBLE_EQ(integrator::stable_steps(system.list, system.x, system.inverse_mass, 0.3)[0],
                   limit / std::sqrt(2) * 0.3);
}

TEST(StableStepTest, PinnedVerticesDoNotCount) {
  System<EdgeSpring<double, 2>> system;
  system.x = {{0, 0}, {1, 0}, {2, 0}, {3, 0}};
  system.inverse_mass = {0, 0, 0.5, 0.25};
  system.list.add({{0, 1}, 8, 1, 0}, 1);
  system.list.add({{1, 2}, 8, 1, 0}, 1);
  system.list.add({{2, 3}, 0, 1, 0}, 1);
  const auto limits = integrator::stable_steps(system.list, system.x, system.inverse_mass, 1);
  EXPECT_EQ(limits[0], std::numeric_limits<double>::infinity());  // moves nothing
  EXPECT_DOUBLE_EQ(limits[1], 2 / std::sqrt(2 * 8 * 0.5));
  EXPECT_DOUBLE_EQ(limits[2], limits[1]);  // by its neighbour at vertex 2
}

/// A stiff part shortens the steps of the forces that touch it, and only those.
TEST(StableStepTest, StiffPartsHaveStepsOfTheirOwn) {
  System<EdgeSpring<double, 2>> system;
  for (VertexId i = 0; i < 10; ++i) {
    system.x.emplace_back(i, 0);
    system.inverse_mass.push_back(1);
  }
  for (VertexId i = 0; i + 1 < 10; ++i) system.list.add({{i, i + 1}, i == 4 ? 1e4 : 1, 1, 0}, 1);
  const auto limits = integrator::stable_steps(system.list, system.x, system.inverse_mass, 1);
  for (std::size_t e = 0; e < limits.size(); ++e) {
    const bool touches = e >= 3 && e <= 5;
    EXPECT_NEAR(limits[e], touches ? 0.01 : std::sqrt(0.5), touches ? 1e-5 : 1e-15) << e;
  }
}

}  // namespace
}  // namespace noli
