// SPDX-License-Identifier: Apache-2.0
#include "integrator/scene/build_model.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>
#include <set>

#include <noli/errors.h>
#include "integrator/stable_step.h"
#include "tests/integrator/scenes.h"
#include "tests/support/temporary_folder.h"

namespace noli::integrator {
namespace {

using testing::changed;
using testing::loop;
using testing::sheet;

template <int Dim = 3>
BuiltScene<Dim> built(const Json& scene, const std::filesystem::path& path = "s.json") {
  return build_model<Dim>(parse_scene(scene.dump(), path));
}

template <int Dim = 3>
std::string build_problem(const Json& scene, const std::filesystem::path& path = "s.json") {
  try {
    built<Dim>(scene, path);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

double total(const std::vector<double>& mass) { return std::accumulate(mass.begin(), mass.end(), 0.0); }

TEST(BuildModel, AnElasticSheetHasMembranesAndHinges) {
  const auto [model, bodies, contact] = built(sheet());
  EXPECT_EQ(model.mesh.vertex_count, 9u);
  EXPECT_EQ(model.mesh.faces.size(), 8u);
  EXPECT_EQ(model.forces.membranes.forces.size(), 8u);
  EXPECT_EQ(model.forces.hinges.forces.size(), 8u);
  EXPECT_TRUE(model.forces.edge_springs.forces.empty());
  EXPECT_EQ(model.window_length, 0.01);
  EXPECT_EQ(model.clocks, Clocks::grouped);
  EXPECT_FALSE(model.gravity);
  EXPECT_NEAR(total(model.mass), 10, 1e-14);
  EXPECT_NEAR(model.mass[4], 10.0 * 8 / 24, 1e-14) << "a third of each of its 8 faces";
  ASSERT_EQ(bodies.size(), 1u);
  EXPECT_EQ(bodies[0].name, "body0");
  EXPECT_NEAR(bodies[0].mass, 10, 1e-14);
  EXPECT_EQ(bodies[0].open_edges, 8u);
}

TEST(BuildModel, RigidityIsThatOfAPlate) {
  Json scene = sheet();
  scene["bodies"][0]["material"]["bending"] = 2;
  scene["bodies"][0]["material"]["bending_damping"] = 0.5;
  const auto model = built(scene).model;
  const Hinge<double>& hinge = model.forces.hinges.forces[0];
  Hinge<double>::X x;
  for (std::size_t i = 0; i < 4; ++i) x[i] = model.x[hinge.vertices[i]];
  const auto expected = Hinge<double>::from_rest(hinge.vertices, x, 2 * 1e5 * 1e-6 / (12 * (1 - 0.09)), 0.5);
  EXPECT_NEAR(hinge.constant, expected.constant, 1e-15);
  EXPECT_EQ(hinge.damping, 0.5);
}

TEST(BuildModel, ASheetOfSpringsHasOneForEachEdge) {
  const Json scene =
      changed(sheet(), "/bodies/0/material",
              R"({"edge_stiffness": 50, "bending_stiffness": 0.5, "mass_per_area": 2, "damping": 0.25})"_json);
  const auto model = built(scene).model;
  EXPECT_EQ(model.forces.edge_springs.forces.size(), 16u);
  EXPECT_EQ(model.forces.hinges.forces.size(), 8u);
  EXPECT_TRUE(model.forces.membranes.forces.empty());
  EXPECT_EQ(model.forces.edge_springs.forces[0].constant, 50);
  EXPECT_EQ(model.forces.edge_springs.forces[0].damping, 0.25);
  EXPECT_NEAR(total(model.mass), 2, 1e-15);
}

TEST(BuildModel, ForcesWithoutStiffnessAndForcesNotListedAreNotThere) {
  EXPECT_TRUE(built(changed(sheet(), "/bodies/0/material/bending", 0)).model.forces.hinges.forces.empty());
  const auto stretched = built(changed(sheet(), "/bodies/0/forces", {"stretch"})).model;
  EXPECT_TRUE(stretched.forces.hinges.forces.empty());
  EXPECT_FALSE(stretched.forces.membranes.forces.empty());
  const auto bent = built(changed(sheet(), "/bodies/0/forces", {"bend"})).model;
  EXPECT_FALSE(bent.forces.hinges.forces.empty());
  EXPECT_TRUE(bent.forces.membranes.forces.empty());
  const Json slack = changed(loop(), "/bodies/0/material", R"({"edge_stiffness": 0, "mass_per_vertex": 1})"_json);
  EXPECT_TRUE(built<2>(slack).model.forces.edge_springs.forces.empty());
  EXPECT_TRUE(built<2>(slack).model.forces.turnings.forces.empty());
}

TEST(BuildModel, ALoopInThePlaneTurns) {
  const auto model = built<2>(loop()).model;
  EXPECT_EQ(model.forces.edge_springs.forces.size(), 8u);
  EXPECT_EQ(model.forces.turnings.forces.size(), 8u);
  EXPECT_EQ(model.mesh.edges.size(), 8u);
  EXPECT_EQ(model.forces.edge_springs.forces[0].constant, 100);
  EXPECT_NEAR(model.forces.edge_springs.forces[0].rest_length, std::sin(std::numbers::pi / 8), 1e-15);
  EXPECT_NEAR(total(model.mass), 0.08, 1e-15);
}

TEST(BuildModel, AnArrayIsCopiesInRows) {
  Json scene = sheet();
  scene["bodies"][0]["transform"]["translate"] = {10, 0, 0};
  scene["bodies"][0]["array"] = {{"counts", {2, 3, 2}}, {"spacing", {2, 3, 0.5}}};
  scene["bodies"][0]["pin"] = {"left_top"};
  const auto [model, bodies, contact] = built(scene);
  ASSERT_EQ(model.mesh.vertex_count, 12u * 9);
  EXPECT_EQ(model.mesh.faces.size(), 12u * 8);
  EXPECT_EQ(model.forces.membranes.forces.size(), 12u * 8);
  EXPECT_EQ(model.forces.hinges.forces.size(), 12u * 8) << "copies are not joined";
  EXPECT_NEAR(total(model.mass), 120, 1e-12);
  for (VertexId i = 0; i < 9; ++i) {
    EXPECT_EQ(model.x[9 + i], model.x[i] + (Vec<double, 3>(2, 0, 0)));
    EXPECT_EQ(model.x[18 + i], model.x[i] + (Vec<double, 3>(0, 3, 0)));
    EXPECT_EQ(model.x[99 + i], model.x[i] + (Vec<double, 3>(2, 6, 0.5)));
  }
  EXPECT_EQ(model.mesh.faces[8],
            (std::array{model.mesh.faces[0][0] + 9, model.mesh.faces[0][1] + 9, model.mesh.faces[0][2] + 9}));
  EXPECT_EQ(bodies[0].pinned, 12u) << "one of each copy";
  EXPECT_EQ(model.pinned[1], model.pinned[0] + 9);
}

TEST(BuildModel, ArraysThatDoNotFit) {
  const auto problem = [](const char* array) {
    return build_problem(changed(sheet(), "/bodies/0/array", Json::parse(array)));
  };
  EXPECT_EQ(problem(R"({"counts": [2, 1, 1]})"),
            "s.json: /bodies/0/array/spacing: expected a spacing along axis 0, of which there are 2 copies");
  EXPECT_EQ(problem(R"({"counts": [2, 1], "spacing": [1, 1, 1]})"),
            "s.json: /bodies/0/array/counts: expected 3 numbers, as many as the scene has dimensions, found [2,1]");
  EXPECT_EQ(problem(R"({"counts": [1000000, 1000000, 1000000], "spacing": [1, 1, 1]})"),
            "s.json: /bodies/0/array/counts: expected at most 20000000 vertices, found 9e+18");
}

TEST(BuildModel, LoosePointsHaveMassByVertexOnly) {
  Json scene = loop();
  scene["bodies"][0]["mesh"] = R"({"points": {"at": [[0, 1], [2, 1]]}})"_json;
  const auto model = built<2>(scene).model;
  EXPECT_EQ(model.mesh.points, (std::vector<VertexId>{0, 1}));
  EXPECT_EQ(total(model.mass), 0.02);
  scene["bodies"][0]["material"] = R"({"edge_stiffness": 1, "mass_per_length": 1})"_json;
  EXPECT_NE(build_problem<2>(scene), "");
}

TEST(BuildModel, AnElasticCurveIsABeam) {
  Json scene = loop();
  scene["bodies"][0] = Json::parse(R"({
      "mesh": {"chain": {"points": [[0, 0], [2, 0]], "segments": 4}},
      "material": {"young": 1e6, "density": 100, "thickness": 0.1, "width": 0.5}})");
  const auto model = built<2>(scene).model;
  EXPECT_NEAR(model.forces.edge_springs.forces[0].constant, 1e6 * 0.05 / 0.5, 1e-9);
  ASSERT_EQ(model.forces.turnings.forces.size(), 3u);
  EXPECT_NEAR(model.forces.turnings.forces[0].constant, 1e6 * 0.001 * 0.5 / 12 / 0.5, 1e-10);
  EXPECT_NEAR(total(model.mass), 100 * 0.05 * 2, 1e-14);
  EXPECT_NEAR(model.mass[0], 100 * 0.05 * 0.25, 1e-14);
}

TEST(BuildModel, TheRestShapeIsScaledAndNotDeformed) {
  Json scene = sheet();
  scene["bodies"][0]["transform"] = R"({"scale": 2, "translate": [1, 2, 3]})"_json;
  scene["bodies"][0]["deform"] = R"({"stretch": [1.5, 1, 1]})"_json;
  scene["bodies"][0]["material"] = R"({"edge_stiffness": 50, "mass_per_area": 2})"_json;
  const auto model = built(scene).model;
  EXPECT_EQ(model.x[0], (Vec<double, 3>(-0.5, 1, 3)));
  EXPECT_EQ(model.x[8], (Vec<double, 3>(2.5, 3, 3)));
  EXPECT_NEAR(total(model.mass), 8, 1e-14);
  EXPECT_EQ(model.forces.edge_springs.forces[0].rest_length, 1);
}

TEST(BuildModel, TwistAndRotation) {
  Json scene = sheet();
  scene["bodies"][0]["deform"] = R"({"twist": 90})"_json;
  scene["bodies"][0]["transform"] = R"({"rotate": {"axis": [0, 0, 2], "degrees": 90}})"_json;
  const auto model = built(scene).model;
  // Vertex 2 is at (0.5, -0.5, 0): twisted by 45 degrees about x, then x to y.
  const double half = std::sqrt(0.125);
  EXPECT_NEAR((model.x[2] - Vec<double, 3>(half, 0.5, -half)).norm(), 0, 1e-15);
  scene["bodies"][0]["transform"] = R"({"rotate": {"quaternion": [3, 0, 0, 3]}})"_json;
  const auto by_quaternion = built(scene).model;
  for (std::size_t i = 0; i < 9; ++i) EXPECT_NEAR((model.x[i] - by_quaternion.x[i]).norm(), 0, 1e-15) << i;
}

TEST(BuildModel, SpinIsAboutTheCentreOfMass) {
  Json scene = sheet();
  scene["bodies"][0]["transform"] = R"({"translate": [5, 0, 0]})"_json;
  scene["bodies"][0]["velocity"] = R"([1, 0, 0])"_json;
  scene["bodies"][0]["spin"] = R"([0, 0, 2])"_json;
  const auto model = built(scene).model;
  EXPECT_NEAR((model.v[8] - Vec<double, 3>(1 - 1, 1, 0)).norm(), 0, 1e-14) << "at (0.5, 0.5) from the centre";
  EXPECT_NEAR((model.v[4] - Vec<double, 3>(1, 0, 0)).norm(), 0, 1e-14);
  const auto ring = built<2>(changed(loop(), "/bodies/0/spin", 2)).model;
  EXPECT_NEAR((ring.v[0] - Vec<double, 2>(0, 1)).norm(), 0, 1e-15);
}

TEST(BuildModel, PerturbationsAreDrawnWithTheSeed) {
  const Json perturbed = changed(sheet(), "/bodies/0/perturb", 0.125);
  const auto rest = built(sheet()).model, one = built(perturbed).model, again = built(perturbed).model;
  const auto two = built(changed(perturbed, "/seed", 2)).model;
  EXPECT_EQ(one.x, again.x);
  EXPECT_NE(one.x, two.x);
  double largest = 0, sum = 0;
  for (std::size_t i = 0; i < 9; ++i) {
    largest = std::max(largest, (one.x[i] - rest.x[i]).cwiseAbs().maxCoeff());
    sum += (one.x[i] - rest.x[i]).sum();
  }
  EXPECT_LE(largest, 0.125);
  EXPECT_GT(largest, 0.0625);
  EXPECT_LT(std::abs(sum), 27 * 0.125 / 2);
  EXPECT_EQ(one.x[0][0], -0.5 + 0.125 * 0.38702427802045847) << "the same draw everywhere, for ever";
  EXPECT_EQ(built<2>(changed(loop(), "/bodies/0/perturb", 0.125)).model.x.size(), 8u);
}

TEST(BuildModel, PinsByNumberSetAndBox) {
  const auto pinned = [](const char* pin) {
    return built(changed(sheet(), "/bodies/0/pin", Json::parse(pin))).model.pinned;
  };
  EXPECT_EQ(pinned("[]"), std::vector<VertexId>{});
  EXPECT_EQ(pinned("[7, 2]"), (std::vector<VertexId>{2, 7}));
  EXPECT_EQ(pinned("[\"left\", 0]"), (std::vector<VertexId>{0, 3, 6}));
  EXPECT_EQ(pinned(R"([{"box": [[0, 0, 0], [0.5, 0.5, 0]]}])"), (std::vector<VertexId>{4, 5, 7, 8}));
}

TEST(BuildModel, SecondBodiesAreNumberedOn) {
  Json scene = changed(sheet(), "/bodies/0/pin", {"left"});
  scene["bodies"].push_back(scene["bodies"][0]);
  scene["bodies"][1]["transform"] = R"({"translate": [0, 0, 1]})"_json;
  const auto [model, bodies, contact] = built(scene);
  EXPECT_EQ(bodies[1].first, 9u);
  EXPECT_EQ(bodies[1].name, "body1");
  EXPECT_EQ(model.pinned, (std::vector<VertexId>{0, 3, 6, 9, 12, 15}));
  EXPECT_EQ(model.mesh.faces[8], (std::array<VertexId, 3>{9, 10, 13}));
  EXPECT_EQ(model.forces.membranes.forces[8].vertices, (std::array<VertexId, 3>{9, 10, 13}));
}

TEST(BuildModel, ForcesThatMoveNothingAreLeftOut) {
  const auto [model, bodies, contact] = built(changed(sheet(), "/bodies/0/pin", R"([0, 1, 3, 4])"_json));
  EXPECT_EQ(model.forces.membranes.forces.size(), 6u);
  EXPECT_EQ(model.forces.hinges.forces.size(), 7u);
  EXPECT_EQ(bodies[0].idle_forces, 3u);
  const auto all = built(changed(sheet(), "/bodies/0/pin", {"all"}));
  EXPECT_TRUE(all.model.forces.membranes.forces.empty());
  EXPECT_EQ(all.bodies[0].idle_forces, 16u);
}

TEST(BuildModel, PatchesMultiply) {
  Json scene = sheet();
  scene["bodies"][0]["patches"] = R"([{"box": [[-1, -1, -1], [0, 0, 1]], "stiffness_factor": 9, "density_factor": 3},
                                     {"box": [[-1, -1, -1], [1, 1, 1]], "stiffness_factor": 2}])"_json;
  const auto plain = built(sheet()).model, patched = built(scene).model;
  EXPECT_NEAR(patched.forces.membranes.forces[0].shear, 18 * plain.forces.membranes.forces[0].shear, 1e-9);
  EXPECT_NEAR(patched.forces.membranes.forces[7].shear, 2 * plain.forces.membranes.forces[7].shear, 1e-9);
  EXPECT_NEAR(total(patched.mass), 15, 1e-14) << "a quarter is three times as heavy";
  std::multiset<double> ratios;
  for (std::size_t i = 0; i < 8; ++i) {
    ratios.insert(std::round(10 * patched.forces.hinges.forces[i].constant / plain.forces.hinges.forces[i].constant) /
                  10);
  }
  EXPECT_EQ(ratios, (std::multiset<double>{2, 2, 2, 2, 2, 3.6, 3.6, 18})) << "in between as springs in a row";
}

TEST(BuildModel, StepsAreAPartOfTheLimit) {
  const auto model = built(changed(sheet(), "/step_factor", 0.25)).model;
  const std::vector<double> inverse_mass = [&] {
    std::vector<double> inverse;
    for (const double m : model.mass) inverse.push_back(1 / m);
    return inverse;
  }();
  EXPECT_EQ(model.forces.membranes.steps, stable_steps(model.forces.membranes, model.x, inverse_mass, 0.25));
  EXPECT_EQ(built(sheet()).model.forces.hinges.steps, std::vector<double>(8, 0.01)) << "at most the window";
}

TEST(BuildModel, GivenStepsAreTakenAndTheLastPatchCounts) {
  Json scene = changed(sheet(), "/bodies/0/steps", R"({"stretch": 1e-3, "bend": 2e-3})"_json);
  auto model = built(scene).model;
  EXPECT_EQ(model.forces.membranes.steps, std::vector<double>(8, 1e-3));
  EXPECT_EQ(model.forces.hinges.steps, std::vector<double>(8, 2e-3));
  scene["bodies"][0]["patches"] =
      R"([{"box": [[-1, -1, -1], [0, 1, 1]], "steps": {"stretch": 5e-4}},
          {"box": [[-1, -1, -1], [0, 0, 1]], "steps": {"stretch": 25e-5}}])"_json;
  model = built(scene).model;
  EXPECT_EQ(model.forces.membranes.steps, (std::vector<double>{25e-5, 25e-5, 1e-3, 1e-3, 5e-4, 5e-4, 1e-3, 1e-3}));
}

TEST(BuildModel, StepsAboveTheLimitAreRefusedByName) {
  const Json stiff = changed(sheet(), "/bodies/0/material/young", 1e7);
  const Json scene = changed(stiff, "/bodies/0/steps", R"({"stretch": 0.01})"_json);
  const std::string problem = build_problem(scene);
  EXPECT_EQ(problem.substr(0, 53), "s.json: /bodies/0/steps/stretch: expected at most 0.0");
  EXPECT_NE(problem.find("the limit of stability of a membrane, or \"allow_unstable\": true, found 0.01"),
            std::string::npos);
  EXPECT_EQ(build_problem(changed(scene, "/allow_unstable", true)), "");
  Json patched = stiff;
  patched["bodies"][0]["patches"] = R"([{"box": [[-1, -1, -1], [1, 1, 1]], "steps": {"stretch": 0.01}}])"_json;
  EXPECT_EQ(build_problem(patched).substr(0, 52), "s.json: /bodies/0/patches/0/steps/stretch: expected ");
}

TEST(BuildModel, StiffnessBeyondAllStepsIsRefused) {
  EXPECT_EQ(build_problem(changed(sheet(), "/bodies/0/material/young", 1e60)).substr(0, 74),
            "s.json: /bodies/0/material: expected steps that can be counted over the du");
}

TEST(BuildModel, GravityHasAStepOfTheGroups) {
  Json scene = changed(sheet(), "/gravity", {0, 0, -9.81});
  const auto model = built(scene).model;
  ASSERT_TRUE(model.gravity);
  EXPECT_EQ(model.gravity->acceleration, (Vec<double, 3>(0, 0, -9.81)));
  EXPECT_EQ(model.gravity->step, 0.01 / 16);
  scene["gravity_step"] = 0.003;
  EXPECT_EQ(built(scene).model.gravity->step, 0.0025);
  scene["steps"] = "own";
  EXPECT_EQ(built(scene).model.gravity->step, 0.003);
}

TEST(Scripts, PathsAreDisplacements) {
  Json scene = sheet();
  scene["scripts"] = R"([{"body": "body0", "vertices": ["left"],
                          "path": [{"t": 0.5, "move": [0, 0, 1]}, {"t": 2, "move": [0, 0, 3]}]}])"_json;
  scene["bodies"][0]["velocity"] = {1, 1, 1};
  const auto [model, bodies, contact] = built(scene);
  ASSERT_EQ(model.scripts.size(), 3u);
  EXPECT_EQ(bodies[0].scripted, 3u);
  EXPECT_EQ(model.scripts[1].vertex, 3u);
  EXPECT_EQ(model.scripts[1].times, (std::vector<double>{0.5, 2}));
  EXPECT_EQ(model.scripts[1].positions[1], (Vec<double, 3>(-0.5, 0, 3)));
  EXPECT_EQ(model.x[3], (Vec<double, 3>(-0.5, 0, 1))) << "at rest before the first point";
  EXPECT_EQ(model.v[3], (Vec<double, 3>(0, 0, 0)));
  EXPECT_EQ(model.v[4], (Vec<double, 3>(1, 1, 1)));
}

TEST(Scripts, OnlyFreeVerticesOnce) {
  Json scene = changed(sheet(), "/bodies/0/pin", {0});
  scene["scripts"] = R"([{"body": "body0", "vertices": [4, 5], "path": [{"t": 0, "move": [0, 0, 0]}]},
                         {"body": "body0", "vertices": [6, 7], "path": [{"t": 0, "move": [0, 0, 0]}]}])"_json;
  EXPECT_EQ(build_problem(scene), "");
  EXPECT_EQ(build_problem(changed(scene, "/scripts/1/vertices", {7, 5})),
            "s.json: /scripts/1/vertices: expected vertices that no other script moves; vertex 5 has a script already");
  EXPECT_EQ(build_problem(changed(scene, "/scripts/1/vertices", {"left"})),
            "s.json: /scripts/1/vertices: expected vertices that are not pinned; vertex 0 is pinned");
  EXPECT_EQ(build_problem(changed(scene, "/scripts/1/vertices", Json::array())),
            "s.json: /scripts/1/vertices: expected at least one vertex");
}

TEST(Selections, WhatIsNotThereIsNamed) {
  EXPECT_EQ(build_problem(changed(sheet(), "/bodies/0/pin", {3, 9})),
            "s.json: /bodies/0/pin/1: the body has no vertex 9; expected a number below 9");
  EXPECT_EQ(build_problem(changed(sheet(), "/bodies/0/pin", {"lft"})),
            "s.json: /bodies/0/pin/0: the body has no set of vertices \"lft\"; the nearest is \"left\"");
  EXPECT_EQ(
      build_problem(changed(sheet(), "/bodies/0/pin", R"([{"box": [[5, 5, 5], [6, 6, 6]]}])"_json)),
      "s.json: /bodies/0/pin/0/box: expected at least one vertex of the body in this box at the start, found none");
}

TEST(MeshFiles, AreReadBesideTheScene) {
  const test::TemporaryFolder folder;
  folder.write("two.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 1\nf 1 2 3\nf 2 4 3\n");
  const Json scene = changed(sheet(), "/bodies/0/mesh", R"({"file": "two.obj"})"_json);
  const auto model = built(scene, folder / "s.json").model;
  EXPECT_EQ(model.mesh.faces.size(), 2u);
  EXPECT_EQ(model.forces.hinges.forces.size(), 1u);
}

TEST(MeshFiles, ThatDoNotServeAreNamed) {
  const test::TemporaryFolder folder;
  const std::string file = (folder / "s.json").string() + ": /bodies/0/";
  const auto problem = [&](const std::string& obj, const std::string& material = "") {
    folder.write("m.obj", obj);
    Json scene = changed(sheet(), "/bodies/0/mesh", R"({"file": "m.obj"})"_json);
    if (!material.empty()) scene["bodies"][0]["material"] = Json::parse(material);
    return build_problem(scene, folder / "s.json");
  };
  const std::string square = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\n";
  EXPECT_EQ(problem("v 0 0\nf 1 2 3\n").substr(0, file.size() + 39), file + "mesh/file: expected a mesh that loads: ");
  EXPECT_EQ(problem("# empty\n"), file + "mesh/file: expected a mesh with vertices");
  EXPECT_EQ(problem(square + "f 1 2 2\n"),
            file + "mesh: expected faces with 3 different vertices; face 0 has vertex 1 twice");
  EXPECT_EQ(problem(square + "l 3 3\n"),
            file + "mesh: expected edges with 2 different vertices; edge 0 has vertex 2 twice");
  EXPECT_EQ(problem("v 0 0 0\nv 1 0 0\nv 2 0 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\nf 2 3 4\n"),
            file + "mesh: expected cells with a size; at face 0: membrane: a triangle has no area at rest");
  EXPECT_EQ(problem(square + "f 1 2 3\n").substr(0, file.size() + 79),
            file + "material: expected a mass at every vertex; that of vertex 3 is 0 [kg]: faces ha");
  EXPECT_EQ(problem(square + "f 1 2 3\n", R"({"edge_stiffness": 1, "mass_per_vertex": 1})"), "");
  EXPECT_EQ(problem("v 0 0 0\nv 0 0 0\nv 1 0 0\nl 1 2 3 1\n"),
            file + "mesh: expected edges with a length; edge 0 has none");
  Json missing = changed(sheet(), "/bodies/0/mesh", R"({"file": "no.ply"})"_json);
  EXPECT_EQ(build_problem(missing, folder / "s.json").substr(0, file.size() + 39),
            file + "mesh/file: expected a mesh that loads: ");
}

TEST(MeshFiles, InThePlane) {
  const test::TemporaryFolder folder;
  const std::string file = (folder / "s.json").string() + ": /bodies/0/mesh/file: ";
  const auto problem = [&](const std::string& obj) {
    folder.write("m.obj", obj);
    return build_problem<2>(changed(loop(), "/bodies/0/mesh", R"({"file": "m.obj"})"_json), folder / "s.json");
  };
  EXPECT_EQ(problem("v 0 0\nv 1 0\nv 1 1\nl 1 2 3\n"), "");
  EXPECT_EQ(problem("v 0 0\nv 1 0\nv 1 1\nf 1 2 3\n"),
            file + "expected a mesh of edges without faces, as the scene has dimension 2");
  EXPECT_EQ(problem("v 0 0 1\nv 1 0 1\nl 1 2\n"),
            file + "expected z = 0 at every vertex, as the scene has dimension 2");
}

TEST(MeshFiles, WhereSheetsMeetNothingBends) {
  const test::TemporaryFolder folder;
  folder.write("m.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 -1 0\nv 0 0 1\nf 1 2 3\nf 1 2 4\nf 1 2 5\n");
  const auto book = built(changed(sheet(), "/bodies/0/mesh", R"({"file": "m.obj"})"_json), folder / "s.json");
  EXPECT_EQ(book.bodies[0].crowded, 1u);
  EXPECT_TRUE(book.model.forces.hinges.forces.empty());
  folder.write("p.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 3 2\n");
  const auto pillow = built(changed(sheet(), "/bodies/0/mesh", R"({"file": "p.obj"})"_json), folder / "s.json");
  EXPECT_EQ(pillow.bodies[0].crowded, 3u);
  EXPECT_TRUE(pillow.model.forces.hinges.forces.empty());
  folder.write("y.obj", "v 0 0\nv 1 0\nv 0 1\nv -1 0\nl 1 2\nl 1 3\nl 1 4\n");
  const auto branched = built<2>(changed(loop(), "/bodies/0/mesh", R"({"file": "y.obj"})"_json), folder / "s.json");
  EXPECT_EQ(branched.bodies[0].crowded, 1u);
  EXPECT_TRUE(branched.model.forces.turnings.forces.empty());
}

TEST(Scripts, FramesGivePositions) {
  const test::TemporaryFolder folder;
  folder.write("m.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  folder.write("n.obj", "v 0 0 1\nv 1 0 2\nv 0 1 3\nf 1 2 3\n");
  folder.write("four.obj", "v 0 0 1\nv 1 0 2\nv 0 1 3\nv 0 0 0\nf 1 2 3\n");
  Json scene = changed(sheet(), "/bodies/0/mesh", R"({"file": "m.obj"})"_json);
  scene["scripts"] = R"([{"body": "body0", "frames": {"files": ["n.obj", "m.obj"], "rate": 4, "from": 1}}])"_json;
  const auto model = built(scene, folder / "s.json").model;
  ASSERT_EQ(model.scripts.size(), 3u);
  EXPECT_EQ(model.scripts[2].times, (std::vector<double>{1, 1.25}));
  EXPECT_EQ(model.scripts[2].positions[0], (Vec<double, 3>(0, 1, 3)));
  EXPECT_EQ(model.x[2], (Vec<double, 3>(0, 1, 3)));
  const std::string file = (folder / "s.json").string() + ": /scripts/0/frames/";
  const auto problem = [&](const char* pointer, const Json& value) {
    return build_problem(changed(scene, std::string("/scripts/0/frames/") + pointer, value), folder / "s.json");
  };
  EXPECT_EQ(problem("files/1", "four.obj"), file + "files/1: expected as many vertices as the body has, 3, found 4");
  folder.write("turned.obj", "v 0 0 1\nv 1 0 2\nv 0 1 3\nf 3 2 1\n");
  folder.write("bare.obj", "v 0 0 1\nv 1 0 2\nv 0 1 3\n");
  folder.write("lines.obj", "v 0 0 1\nv 1 0 2\nv 0 1 3\nl 1 2 3\n");
  for (const char* good : {"turned.obj", "bare.obj"}) {
    EXPECT_EQ(built(changed(scene, "/scripts/0/frames/files/1", good), folder / "s.json").model.scripts.size(), 3u);
  }
  EXPECT_EQ(problem("files/1", "lines.obj"),
            file + "files/1: expected the faces, edges and points of the body, or none, found others");
  EXPECT_EQ(problem("files/0", "no.obj").substr(0, file.size() + 37), file + "files/0: expected a mesh that loads: ");
  Json fast = changed(scene, "/scripts/0/frames/rate", 1e9);
  fast["scripts"][0]["frames"]["from"] = 1e9;
  EXPECT_EQ(build_problem(fast, folder / "s.json"),
            file + "rate: expected times of frames that increase in double precision");
}

TEST(MeshFiles, ACurveWithoutLengthIsRefused) {
  Json scene = loop();
  scene["bodies"][0]["mesh"] = R"({"chain": {"points": [[1, 1], [1, 1]], "segments": 4}})"_json;
  EXPECT_EQ(build_problem<2>(scene), "s.json: /bodies/0/mesh/chain: expected a curve with a positive, finite length");
}

}  // namespace
}  // namespace noli::integrator
