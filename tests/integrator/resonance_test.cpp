// SPDX-License-Identifier: Apache-2.0
#include "integrator/resonance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

namespace noli {
namespace {

using integrator::Oscillation;

/// Measured separately: `slow` slow steps equal `fast` fast ones, and `edge` is the least h2 omega2, in hundredths,
/// that is unstable for one of the soft springs. Hundredths matter: 5:2 is also unstable in [0.5504, 0.5550], between
/// two of them.
struct Row {
  int fast, slow;
  double edge;
};
constexpr Row table[] = {{2, 1, 1.16}, {3, 1, 0.81}, {3, 2, 0.90}, {4, 1, 0.62}, {5, 2, 0.59}, {10, 1, 0.26}};

constexpr double soft_springs[] = {0.01, 0.05, 0.1, 0.25};

Oscillation fast_of(double h) { return {h, 1}; }
Oscillation slow_of(const Row& row, double h, double stiffness) {
  return {h * row.fast / row.slow, std::sqrt(stiffness)};
}

/// The least h2 = 0.01, 0.02, ... at which one of the soft springs makes the motion unstable.
template <class Unstable>
double least_unstable(const Row& row, const Unstable& unstable) {
  for (int i = 1; i < 200; ++i) {
    const double h = 0.01 * i;
    for (const double k : soft_springs) {
      if (unstable(slow_of(row, h, k), fast_of(h))) return h;
    }
  }
  return 2;
}

TEST(ResonanceTest, TableByMonodromy) {
  for (const Row& row : table) {
    const double edge = least_unstable(row, [&](const Oscillation& slow, const Oscillation& fast) {
      return std::abs(integrator::monodromy_trace(slow, fast, row.slow, row.fast)) > 2;
    });
    EXPECT_NEAR(edge / row.edge, 1, 0.05) << row.fast << ":" << row.slow;
  }
}

TEST(ResonanceTest, WarningsFireOnTheTable) {
  for (const Row& row : table) {
    const double edge = least_unstable(row, [&](const Oscillation& slow, const Oscillation& fast) {
      return integrator::resonance(slow, fast).has_value();
    });
    EXPECT_NEAR(edge / row.edge, 1, 0.05) << row.fast << ":" << row.slow;
  }
}

/// If the slow step is a multiple of the fast one, the formula gives the trace of the product.
TEST(ResonanceTest, FormulaIsTheTrace) {
  for (const Row& row : table) {
    if (row.slow != 1) continue;
    for (const double h : {0.1, 0.26, 0.5, 1.1, 1.9}) {
      for (const double k : soft_springs) {
        const auto slow = slow_of(row, h, k), fast = fast_of(h);
        const auto [phi, kappa] = integrator::meeting(slow, fast);
        EXPECT_NEAR(integrator::monodromy_trace(slow, fast, row.slow, row.fast),
                    2 * std::cos(phi) - kappa * std::sin(phi), 1e-12);
      }
    }
  }
}

/// Tests the tongue's edges, and its law for a well resolved fast spring.
TEST(ResonanceTest, EdgesOfATongue) {
  using std::numbers::pi;
  const double kappa = 0.63, edge = pi - 2 * std::atan(kappa / 2);
  for (const int n : {0, 1, 5}) {
    EXPECT_FALSE(integrator::in_tongue({n * pi + edge - 1e-9, kappa}));
    EXPECT_TRUE(integrator::in_tongue({n * pi + edge + 1e-9, kappa}));
    EXPECT_TRUE(integrator::in_tongue({n * pi + pi - 1e-9, kappa}));
    EXPECT_FALSE(integrator::in_tongue({n * pi + pi + 1e-9, kappa}));
  }
  const auto meeting = integrator::meeting({2.5, 0.5}, {1e-4, 1});
  EXPECT_NEAR(meeting.phase, 2.5, 1e-6);
  EXPECT_NEAR(meeting.strength, 0.25 * 2.5, 1e-6);
}

TEST(ResonanceTest, NarrowTongueBetweenTheTablesHundredths) {
  const Row row{5, 2, 0.59};
  EXPECT_FALSE(integrator::resonant(slow_of(row, 0.5500, 0.25), fast_of(0.5500)));
  EXPECT_TRUE(integrator::resonant(slow_of(row, 0.5525, 0.25), fast_of(0.5525)));
  EXPECT_FALSE(integrator::resonant(slow_of(row, 0.5555, 0.25), fast_of(0.5555)));
}

/// Iterates the kicks directly: the mass flies off iff there is a warning.
TEST(ResonanceTest, WarningsTellWhatAMassDoes) {
  for (const Row& row : table) {
    for (const double side : {0.9, 1.0}) {
      int unstable = 0;
      for (const double k : soft_springs) {
        const double h = row.edge * side;
        const auto slow = slow_of(row, h, k), fast = fast_of(h);
        double x = 1, v = 0, greatest = 0;
        for (int i = 1; i <= 2000 * row.fast * row.slow; ++i) {
          x += v * h / row.slow;
          if (i % row.slow == 0) v -= h * x;
          if (i % row.fast == 0) v -= slow.step * k * x;
          greatest = std::max(greatest, std::abs(x));
        }
        const bool warned = integrator::resonance(slow, fast).has_value();
        EXPECT_EQ(warned, greatest > 50) << row.fast << ":" << row.slow << " k " << k << " side " << side;
        unstable += warned ? 1 : 0;
      }
      EXPECT_EQ(unstable > 0, side == 1) << row.fast << ":" << row.slow;
    }
  }
}

TEST(ResonanceTest, CommonPeriods) {
  using Pair = std::pair<int, int>;
  EXPECT_EQ(integrator::common_period({0.3, 1}, {0.1, 1}), Pair(3, 1));
  EXPECT_EQ(integrator::common_period({0.25, 1}, {0.1, 1}), Pair(5, 2));
  EXPECT_EQ(integrator::common_period({1, 1}, {0.3, 1}), Pair(10, 3));
  EXPECT_EQ(integrator::common_period({std::numbers::sqrt2, 1}, {1, 1}), Pair(0, 0));
}

TEST(ResonanceTest, PairsAreNamed) {
  const Oscillation fast{0.27, 1}, slow{2.7, 0.5}, calm{0.135, 1e-3}, beyond{0.01, 300};
  const std::array all{calm, fast, beyond, slow};
  for (std::size_t s = 0; s < all.size(); ++s) {
    for (std::size_t f = 0; f < all.size(); ++f) {
      EXPECT_EQ(integrator::resonance(all[s], all[f]).has_value(), s == 3 && f == 1) << s << " and " << f;
    }
  }
  EXPECT_NEAR(integrator::resonance(slow, fast)->phase, 2.7, 0.02);
  // Steps without a common period use the formula.
  EXPECT_TRUE(integrator::resonant({2.7 * std::numbers::sqrt2 / 1.4, 0.5}, fast));
  EXPECT_FALSE(integrator::resonant({std::numbers::sqrt2, 0.5}, fast));
}

}  // namespace
}  // namespace noli
