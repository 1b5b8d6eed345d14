// SPDX-License-Identifier: Apache-2.0
//
// Tests that the paper's examples show what scenes/README.md says: numbers read from runs of their short forms.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>
#include <vector>

#include "integrator/scene/build_model.h"
#include "integrator/scene/read_scene.h"
#include "tests/app/runs/knots.h"
#include "tests/app/runs/simulate_fixture.h"
#include "trajectory/blocks/run_file.h"

namespace noli::app_tests {
namespace {

double distance(const Position& p, const Position& q) { return std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]); }

// --- Knot invariants -------------------------------------------------------------------------------------------------

/// An open curve from -x to x with an overhand knot of this handedness, or without a knot.
Curve overhand(double hand) {
  Curve curve{{-9, 2.4, 0}};
  for (int i = 0; i <= 40; ++i) {
    const double t = -2 + 0.1 * i;
    curve.push_back({t * t * t - 3 * t, t * t * t * t - 4 * t * t, hand * (std::pow(t, 5) - 10 * t) / 5});
  }
  curve.push_back({9, 2.4, 0});
  return curve;
}

TEST(Knots, InvariantsAreThoseOfTheTables) {
  EXPECT_EQ(degree_two_invariant(overhand(1)), 1);
  EXPECT_EQ(degree_two_invariant(overhand(-1)), 1) << "the other hand";
  Curve loop = overhand(1);
  for (std::size_t i = 0; i < loop.size(); ++i) loop[i][2] = static_cast<double>(i);  // each crossing over the last
  EXPECT_EQ(degree_two_invariant(loop), 0);
  Curve ring, through, beside;
  for (int i = 0; i < 20; ++i) {
    const double angle = 2 * std::numbers::pi * i / 20;
    ring.push_back({std::cos(angle), std::sin(angle), 0});
    through.push_back({1 + std::cos(angle), 0, std::sin(angle)});
    beside.push_back({3 + std::cos(angle), 0, std::sin(angle)});
  }
  EXPECT_EQ(std::abs(linking_number(ring, through)), 1);
  EXPECT_EQ(linking_number(ring, beside), 0);
}

// --- Scenes ----------------------------------------------------------------------------------------------------------

class SceneShowsSlow : public Simulate {
 protected:
  /// Runs a scene's short form and reads all positions at the start and after each window.
  void run(const std::string& name) {
    const fs::path file = fs::path(NOLI_SOURCE_DIR) / "scenes" / (name + ".json");
    const Process process = run_noli({"simulate", file.string(), "--short", "-o", run_path("run")});
    ASSERT_EQ(process.exit_code, 0) << process.out << process.err;
    built_ = integrator::build_model<3>(integrator::read_scene(file, integrator::Form::brief));
    std::vector<Position> start;
    for (const auto& x : built_.model.x) start.push_back({x[0], x[1], x[2]});
    states_ = {start};
    RunReader reader(run_path("run"));
    while (const auto window = reader.next_window()) states_.push_back(window->positions);
  }

  const std::vector<Position>& begin() const { return states_.front(); }
  const std::vector<Position>& end() const { return states_.back(); }
  /// The positions after this fraction of the short form.
  const std::vector<Position>& after(double part) const {
    return states_[static_cast<std::size_t>(part * static_cast<double>(states_.size() - 1))];
  }

  std::size_t first_vertex(std::size_t body) const {
    std::size_t first = 0;
    for (std::size_t b = 0; b < body; ++b) first += built_.bodies[b].vertices;
    return first;
  }
  std::span<const Position> vertices(const std::vector<Position>& x, std::size_t body) const {
    return std::span(x).subspan(first_vertex(body), built_.bodies[body].vertices);
  }

  /// The centre line of a ribbon with `across` vertices across, from end to end.
  Curve middle(const std::vector<Position>& x, std::size_t body, std::size_t across) const {
    const auto all = vertices(x, body);
    Curve curve;
    for (std::size_t i = 0; i < all.size(); i += across) {
      Position mean{};
      for (std::size_t k = 0; k < across; ++k) {
        for (std::size_t d = 0; d < 3; ++d) mean[d] += all[i + k][d] / static_cast<double>(across);
      }
      curve.push_back(mean);
    }
    return curve;
  }
  /// The strain of the first (or last) twentieth of a ribbon since the start.
  double strain(std::size_t body, std::size_t across, bool at_end) const {
    Curve before = middle(begin(), body, across), now = middle(end(), body, across);
    if (at_end) {
      std::ranges::reverse(before);
      std::ranges::reverse(now);
    }
    double rest = 0, length = 0;
    for (std::size_t i = 0; i < before.size() / 20; ++i) {
      rest += distance(before[i], before[i + 1]);
      length += distance(now[i], now[i + 1]);
    }
    return length / rest - 1;
  }

  /// The volume of a closed body [m^3].
  double volume(const std::vector<Position>& x, std::size_t body) const {
    const std::size_t first = first_vertex(body), last = first + built_.bodies[body].vertices;
    double six = 0;
    for (const auto& [a, b, c] : built_.model.mesh.faces) {
      if (a < first || a >= last) continue;
      const Position &p = x[a], &q = x[b], &r = x[c];
      six +=
          p[0] * (q[1] * r[2] - q[2] * r[1]) + p[1] * (q[2] * r[0] - q[0] * r[2]) + p[2] * (q[0] * r[1] - q[1] * r[0]);
    }
    return std::abs(six) / 6;
  }

  static double mean(std::span<const Position> x, std::size_t axis) {
    double sum = 0;
    for (const Position& p : x) sum += p[axis];
    return sum / static_cast<double>(x.size());
  }

  integrator::BuiltScene<3> built_;

 private:
  std::vector<std::vector<Position>> states_;
};

TEST_F(SceneShowsSlow, TheTrefoilIsPulledTight) {
  run("trefoil");
  EXPECT_EQ(degree_two_invariant(middle(begin(), 0, 3)), 1);
  EXPECT_EQ(degree_two_invariant(middle(end(), 0, 3)), 1);
  const double left = strain(0, 3, false), right = strain(0, 3, true);
  std::printf("tension at the ends of the trefoil: %.1f %% and %.1f %%\n", 100 * left, 100 * right);
  EXPECT_GT(std::min(left, right), 0.005);
  const Curve now = middle(end(), 0, 3);
  EXPECT_GT(now.back()[0] - now.front()[0], 4) << "of 4.2 m, so that little is left for the knot";
}

TEST_F(SceneShowsSlow, TheBowlineHoldsThePost) {
  run("bowline");
  const double standing = strain(0, 3, false), free = strain(0, 3, true);
  std::printf("tension of the bowline: %.1f %%, %.1f %% at its free end\n", 100 * standing, 100 * free);
  EXPECT_GT(standing, 0.02);
  EXPECT_LT(std::abs(free), 0.02);
  // The loop is still around the post, which stands along x at y = -0.58.
  double lowest = 0;
  for (const Position& p : middle(end(), 0, 3)) lowest = std::min(lowest, p[1]);
  EXPECT_LT(lowest, -0.65);
}

TEST_F(SceneShowsSlow, TheReefKnotHolds) {
  run("reef_knot");
  for (const std::size_t ribbon : {0U, 1U}) {
    for (const bool at_end : {false, true}) {
      const double tension = strain(ribbon, 4, at_end);
      std::printf("tension of ribbon %zu of the reef knot: %.1f %%\n", ribbon + 1, 100 * tension);
      EXPECT_GT(tension, 0.01);
    }
  }
  // The ribbons, closed between their ends, wind around each other equally often in both directions.
  for (const auto* x : {&begin(), &end()}) EXPECT_EQ(linking_number(middle(*x, 0, 4), middle(*x, 1, 4)), 0);
  // They hook into each other: the left one reaches further right than the right one reaches left.
  double rightmost = -1, leftmost = 1;
  for (const Position& p : middle(end(), 0, 4)) rightmost = std::max(rightmost, p[0]);
  for (const Position& p : middle(end(), 1, 4)) leftmost = std::min(leftmost, p[0]);
  EXPECT_GT(rightmost, leftmost);
}

TEST_F(SceneShowsSlow, TheCompactorCompacts) {
  run("compactor");
  double before = 0, now = 0;
  for (std::size_t body = 0; body < 10; ++body) {
    before += volume(begin(), body);
    now += volume(end(), body);
  }
  std::printf("the compactor leaves %.0f %% of the volume\n", 100 * now / before);
  EXPECT_LT(now, 0.5 * before);
  EXPECT_GT(now, 0);
}

TEST_F(SceneShowsSlow, TheCurtainsSwingAgain) {
  run("curtains");
  const std::size_t each = vertices(begin(), 0).size() / 2;
  // The curtains are struck at 1.2 s of 4 s and their hems fly up. At the end both hang below the rail and swing.
  double highest = -2, least = 1, greatest = -1;
  for (double part = 0.32; part < 1; part += 0.005) {
    for (std::size_t sheet = 0; sheet < 2; ++sheet) {
      const auto x = vertices(after(part), 0).subspan(sheet * each, each);
      highest = std::max(highest, mean(x, 2));
      if (part < 0.6) continue;
      least = std::min(least, mean(x, 1));
      greatest = std::max(greatest, mean(x, 1));
    }
  }
  std::printf("the middle of a curtain rises to %.2f m above the rail; it swings %.2f m\n", highest, greatest - least);
  EXPECT_GT(highest, -0.7) << "the strike lifts them";
  EXPECT_GT(greatest - least, 0.1);
  for (std::size_t sheet = 0; sheet < 2; ++sheet) {
    const auto x = vertices(end(), 0).subspan(sheet * each, each);
    EXPECT_LT(mean(x, 2), -0.6);
    EXPECT_EQ(std::ranges::count_if(x, [](const Position& p) { return p[2] > 0.02; }), 0) << "none lies on the rail";
  }
}

TEST_F(SceneShowsSlow, TheNailsHoldTheSheetUp) {
  run("nails");
  const auto sheet = vertices(end(), 0);
  double lowest = 1;
  for (const Position& p : sheet) lowest = std::min(lowest, p[2]);
  std::printf("the sheet is %.3f m above the floor, its lowest vertex %.3f m\n", mean(sheet, 2), lowest);
  EXPECT_GT(mean(sheet, 2), 0.1) << "nails are 0.2 m high";
  EXPECT_LT(mean(sheet, 2), 0.2022) << "it sags between them";
}

}  // namespace
}  // namespace noli::app_tests
