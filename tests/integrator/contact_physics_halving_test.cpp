// SPDX-License-Identifier: Apache-2.0
//
// Compares friction on an incline with theory, and tests that the physics of contact does not depend on the steps: with
// all steps halved it stays the same (docs/contact.md, 5).
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>

#include "contact_models.h"
#include "integrator/scene/build_model.h"
#include "integrator/scene/read_scene.h"
#include "running.h"
#include "trajectory/text.h"

namespace noli::integrator {
namespace {

template <int Dim>
Model<double, Dim> with_half_steps(Model<double, Dim> model) {
  const auto halve = [](auto& list) {
    for (double& step : list.steps) step /= 2;
  };
  std::apply([&](auto&... list) { (halve(list), ...); }, model.forces.lists());
  if (model.gravity) model.gravity->step /= 2;
  for (ContactMaterial& material : model.contact->materials) material.step /= 2;
  return model;
}

Json scene(const char* name) {
  return parse_json(read_whole_file(std::filesystem::path(NOLI_SOURCE_DIR) / "scenes" / name), "scene");
}

template <int Dim>
BuiltScene<Dim> built(const Json& json, Form form) {
  return build_model<Dim>(parse_scene(json.dump(), std::filesystem::path(NOLI_SOURCE_DIR) / "scenes/scene", form));
}

// --- On an incline ---------------------------------------------------------------------------------------------------

/// In the plane: a triangle of springs on a level floor, with gravity tilted by atan 1/2. `excess`: the tangent of the
/// angle over the coefficient of friction.
constexpr double gravity = 9.81, edge = 0.2;
const double slope = std::atan(0.5);

Model<double, 2> sled(double excess) {
  Model<double, 2> model;
  model.mesh.vertex_count = 5;
  model.mesh.edges = {{0, 1}, {1, 2}, {0, 2}, {3, 4}};
  constexpr double thickness = 0.01, stiffness = 2000, mass = 0.1;
  const double sinks = 1.5 * mass * gravity * std::cos(slope) / stiffness;
  const double y = thickness - sinks;
  model.x = {{0, y}, {edge, y}, {0.5 * edge, y + 0.75 * edge}, {-1, 0}, {3, 0}};
  model.v.assign(5, {0, 0});
  model.mass.assign(5, mass);
  model.pinned = {3, 4};
  const auto spring = [&](VertexId a, VertexId b) {
    model.forces.edge_springs.add({{a, b}, 2000, (model.x[b] - model.x[a]).norm(), 0.002}, 1);
  };
  spring(0, 1);
  spring(1, 2);
  spring(0, 2);
  test::choose_steps(model, 0.01);
  model.window_length = 0.01;
  model.gravity = Gravity<double, 2>{{gravity * std::sin(slope), -gravity * std::cos(slope)}, 1e-5};
  return test::with_contact(std::move(model), {thickness, stiffness, 0.003, 0.25, std::tan(slope) / excess});
}

/// The motion of a body along the incline, after it has settled across it.
struct Slide {
  double speed = 0, acceleration = 0;  ///< on average over the time watched
};

/// Mean of the first coordinates of the vertices [first, last).
template <int Dim>
double place(const Simulation<double, Dim>& simulation, std::size_t first, std::size_t last) {
  const auto s = simulation.snapshot();
  double sum = 0;
  for (std::size_t i = first; i < last; ++i) sum += s.x[i][0];
  return sum / static_cast<double>(last - first);
}

/// Measures positions at three times: after `settling` windows, and then after each half of `windows`.
Slide slide_of(const Model<double, 2>& model, std::uint64_t settling, std::uint64_t windows) {
  Simulation<double, 2> simulation(model);
  test::run(simulation, settling);
  const double x0 = place(simulation, 0, 3);
  const std::uint64_t half_of_windows = windows / 2;
  test::run(simulation, half_of_windows);
  const double x1 = place(simulation, 0, 3);
  test::run(simulation, half_of_windows);
  const double x2 = place(simulation, 0, 3);
  const double half = static_cast<double>(half_of_windows) * model.window_length;
  return {(x2 - x0) / (2 * half), (x2 - 2 * x1 + x0) / (half * half)};
}

TEST(Incline, BelowTheAngleItSticks) {
  const Slide whole = slide_of(sled(0.95), 50, 100), half = slide_of(with_half_steps(sled(0.95)), 50, 100);
  std::printf("sticks: %.3g edges a second, %.3g with half of the steps\n", whole.speed / edge, half.speed / edge);
  EXPECT_LT(std::abs(whole.speed), 1e-3 * edge);
  EXPECT_LT(std::abs(half.speed), 1e-3 * edge);
}

TEST(Incline, AboveTheAngleItSlides) {
  const double theory = gravity * std::sin(slope) * (1 - 1 / 1.05);
  const Slide whole = slide_of(sled(1.05), 50, 100), half = slide_of(with_half_steps(sled(1.05)), 50, 100);
  std::printf("slides: %.5f of theory's acceleration, %.5f with half of the steps\n", whole.acceleration / theory,
              half.acceleration / theory);
  EXPECT_NEAR(whole.acceleration, theory, 3e-4 * theory);
  EXPECT_NEAR(half.acceleration, whole.acceleration, 0.02 * theory);
}

/// In space: the scene's two boxes with one cell per side; one sticks and one slips.
struct Boxes {
  Slide sticks, slips;
  double edge = 0;
};

Boxes boxes_on_the_incline(bool half) {
  Json json = scene("incline.json");
  Boxes result;
  result.edge = json["bodies"][0]["mesh"]["box"]["size"][0];
  for (const std::size_t body : {0U, 1U}) json["bodies"][body]["mesh"]["box"]["cells"] = {1, 1, 1};
  const BuiltScene<3> both = built<3>(json, Form::full);
  Simulation<double, 3> simulation(half ? with_half_steps(both.model) : both.model);
  const std::size_t n = both.bodies[0].vertices;
  std::array<std::array<double, 3>, 2> x{};
  for (std::size_t k = 0; k < 3; ++k) {
    test::run(simulation, k == 0 ? 100 : 50);
    x[0][k] = place(simulation, 0, n);
    x[1][k] = place(simulation, n, 2 * n);
  }
  const double time = 50 * both.model.window_length;
  const auto slide = [time](const std::array<double, 3>& of) {
    return Slide{(of[2] - of[0]) / (2 * time), (of[2] - 2 * of[1] + of[0]) / (time * time)};
  };
  result.sticks = slide(x[0]);
  result.slips = slide(x[1]);
  return result;
}

TEST(Incline, BoxesStickAndSlide) {
  const Boxes whole = boxes_on_the_incline(false), half = boxes_on_the_incline(true);
  const double theory = gravity * std::sin(slope) * (1 - 1 / 1.05);
  std::printf("boxes: %.3g and %.3g edges a second; %.5f and %.5f of theory's acceleration\n",
              whole.sticks.speed / whole.edge, half.sticks.speed / half.edge, whole.slips.acceleration / theory,
              half.slips.acceleration / theory);
  EXPECT_LT(std::abs(whole.sticks.speed), 1e-3 * whole.edge);
  EXPECT_LT(std::abs(half.sticks.speed), 1e-3 * half.edge);
  EXPECT_NEAR(whole.slips.acceleration, theory, 3e-4 * theory);
  EXPECT_NEAR(half.slips.acceleration, whole.slips.acceleration, 0.02 * theory);
}

// --- Restitution -----------------------------------------------------------------------------------------------------

/// Each ball's speed after its first impact over its speed before, both converted to the height of the outermost layer.
std::vector<double> speed_ratios(Model<double, 2> model, std::size_t balls) {
  model.window_length = 0.01;  // the lowest rise takes 0.045 s
  Simulation<double, 2> simulation(model);
  const double thickness = model.contact->materials[0].thickness;
  std::vector<double> fall(balls), rise(balls);
  for (int w = 0; w < 200; ++w) {
    test::run(simulation, 1);
    const auto s = simulation.snapshot();
    const auto mean = simulation.mean_velocities();
    for (std::size_t i = 0; i < balls; ++i) {
      if (s.x[i][1] < thickness) continue;
      const double speed = std::sqrt(mean[i].squaredNorm() + 2 * 9.8 * (s.x[i][1] - thickness));
      if (fall[i] == 0) fall[i] = speed;
      if (s.v[i][1] > 0 && rise[i] == 0) rise[i] = speed;
    }
  }
  for (std::size_t i = 0; i < balls; ++i) rise[i] /= fall[i];
  return rise;
}

/// Gravity's work within the layers is a thousandth of the fall. That is more than a hundredth of the lowest rise, so
/// its tolerance is wider.
TEST(Halving, LeavesRestitution) {
  constexpr std::array<double, 5> returned{1, 0.5, 0.25, 0.1, 0.01};
  const Model<double, 2> model = built<2>(scene("restitution.json"), Form::brief).model;
  const std::vector<double> whole = speed_ratios(model, 5), half = speed_ratios(with_half_steps(model), 5);
  for (std::size_t i = 0; i < whole.size(); ++i) {
    std::printf("restitution: %.5f, %.5f with half of the steps\n", whole[i], half[i]);
    EXPECT_NEAR(whole[i], std::sqrt(returned[i]), (i < 4 ? 0.01 : 0.05) * std::sqrt(returned[i]));
    EXPECT_NEAR(half[i], whole[i], 0.02 * whole[i]);
  }
}

// --- Sphere and plate ------------------------------------------------------------------------------------------------

/// The sphere after it has left the plate, when neither value changes any more.
struct Rebound {
  double momentum = 0, energy = 0;
};

/// Elastic energy of the forces among the first `vertices`.
double elastic_energy(const Model<double, 3>& model, const Snapshot<double, 3>& s, std::size_t vertices) {
  double sum = 0;
  const auto add = [&](const auto& list) {
    for (const auto& force : list.forces) {
      VertexVectors<double, 3, std::tuple_size_v<std::remove_cvref_t<decltype(force.vertices)>>> x;
      for (std::size_t i = 0; i < x.size(); ++i) x[i] = s.x[force.vertices[i]];
      if (force.vertices[0] < vertices) sum += force.energy(x);
    }
  };
  std::apply([&](const auto&... list) { (add(list), ...); }, model.forces.lists());
  return sum;
}

Rebound rebound(const Model<double, 3>& model, std::size_t sphere) {
  Simulation<double, 3> simulation(model);
  test::run(simulation, 50);
  const auto s = simulation.snapshot();
  const auto v = simulation.mean_velocities();
  Rebound result;
  for (std::size_t i = 0; i < sphere; ++i) {
    result.momentum += model.mass[i] * v[i][2];
    result.energy += 0.5 * model.mass[i] * v[i].squaredNorm();
  }
  EXPECT_EQ(simulation.state().potential[static_cast<std::size_t>(ForceKind::contact)], 0);
  result.energy += elastic_energy(model, s, sphere);
  return result;
}

/// Mean over starts that differ by a micrometre: the shells buckle, and results then differ by about one per cent.
Rebound mean_rebound(const BuiltScene<3>& scene, bool half) {
  constexpr std::uint64_t starts = 4;
  Rebound mean;
  for (std::uint64_t k = 0; k < starts; ++k) {
    Model<double, 3> model = half ? with_half_steps(scene.model) : scene.model;
    for (std::size_t i = 0; i < model.x.size(); ++i) model.x[i][0] += 1e-6 * test::noise(i + 1000 * k);
    const Rebound one = rebound(model, scene.bodies[0].vertices);
    mean.momentum += one.momentum / starts;
    mean.energy += one.energy / starts;
  }
  return mean;
}

/// With twice the scene's steps (a step_factor of a half), the momentum changes by 2.1 % (over eight starts; standard
/// error 0.4 %). This comes from the membranes: halving only contact's steps changes 0.2 %.
TEST(Halving, SlowLeavesSphereAndPlate) {
  const BuiltScene<3> built_scene = built<3>(scene("sphere_plate.json"), Form::brief);
  const Rebound whole = mean_rebound(built_scene, false), half = mean_rebound(built_scene, true);
  std::printf("rebound: momentum %.5f, energy %.5f; with half of the steps %.5f, %.5f\n", whole.momentum, whole.energy,
              half.momentum, half.energy);
  EXPECT_GT(whole.momentum, 0);
  EXPECT_NEAR(half.momentum, whole.momentum, 0.02 * whole.momentum);
  EXPECT_NEAR(half.energy, whole.energy, 0.02 * whole.energy);
}

}  // namespace
}  // namespace noli::integrator
