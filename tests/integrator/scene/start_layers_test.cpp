// SPDX-License-Identifier: Apache-2.0
//
// Tests which bodies begin inside layers of contact, the energy of these layers, and the notes about them.
#include "integrator/scene/start_layers.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "integrator/books.h"
#include "integrator/scene/explain.h"
#include "integrator/scene/read_scene.h"
#include "integrator/simulation.h"

namespace noli::integrator {
namespace {

/// Loose points in the plane at these x, each a body: p0, p1, ...
Json row_of_points(const std::vector<double>& row) {
  Json scene = Json::parse(R"({"noli_scene": 1, "dimension": 2, "duration": 0.001, "window": 0.001, "bodies": [],
                               "contact": {"thickness": 1, "stiffness": 200}})");
  for (std::size_t i = 0; i < row.size(); ++i) {
    Json body = Json::parse(R"({"material": {"edge_stiffness": 0, "mass_per_vertex": 1}})");
    body["name"] = "p" + std::to_string(i);
    body["mesh"]["points"]["at"] = Json::array({Json::array({row[i], 0})});
    scene["bodies"].push_back(body);
  }
  return scene;
}

/// A box that begins 0.05 m above a pinned floor, in layers of 0.08 m.
Json box_above_floor() {
  return Json::parse(R"({"noli_scene": 1, "duration": 0.001, "window": 0.001, "bodies": [
      {"name": "box", "mesh": {"box": {"size": [1, 1, 1], "cells": [2, 2, 2]}},
       "transform": {"translate": [0.1, 0.2, 0.55]},
       "material": {"young": 1e5, "density": 1000, "thickness": 0.01}},
      {"name": "floor", "mesh": {"grid": {"size": [3, 3], "cells": [5, 5]}},
       "material": {"edge_stiffness": 0, "mass_per_area": 1}, "pin": ["all"]}],
      "contact": {"thickness": 0.08, "stiffness": 1000}})");
}

std::vector<std::string> notes_on_start(const Json& scene) {
  std::vector<std::string> all = explain(parse_scene(scene.dump(), "s.json")).warnings;
  std::erase_if(all, [](const std::string& note) { return note.find(" push ") == note.npos; });
  return all;
}

/// Compares the energy with that of a simulation.
template <int Dim>
void expect_energy_of_simulation(const Json& document, std::uint32_t deepest) {
  const BuiltScene<Dim> built = build_model<Dim>(parse_scene(document.dump(), "s.json"));
  const std::vector<StartPush> pushes = find_start_pushes(built);
  ASSERT_EQ(pushes.size(), 1u);
  EXPECT_EQ(pushes[0].layer, deepest);
  EXPECT_FALSE(pushes[0].at_least);
  Simulation<double, Dim> simulation(built.model);
  Books<double, Dim> books;
  simulation.run_window(books);
  EXPECT_GT(pushes[0].energy, 0);
  EXPECT_NEAR(pushes[0].energy, simulation.contact_at_start(), 1e-11 * simulation.contact_at_start());
}

TEST(StartLayers, AreNotedWithTheirEnergy) {
  EXPECT_EQ(
      notes_on_start(row_of_points({0, 0.9})),
      std::vector<std::string>{"p0 and p1 begin 0.9 m apart, inside layer 1 of contact: they push each other apart "
                               "with 1 J; layers begin at 1 m (\"thickness\")"});
  EXPECT_EQ(notes_on_start(row_of_points({0, 1})), std::vector<std::string>());
  EXPECT_EQ(notes_on_start(row_of_points({0, 1.1})), std::vector<std::string>());
}

TEST(StartLayers, PartsOfOneBodyPushToo) {
  Json scene = row_of_points({0});
  scene["bodies"][0]["array"] = Json::parse(R"({"counts": [2, 1], "spacing": [0.9, 0]})");
  const std::vector<std::string> notes = notes_on_start(scene);
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_TRUE(notes[0].starts_with("parts of p0 begin 0.9 m apart, inside layer 1 of contact: ")) << notes[0];
}

TEST(StartLayers, OnlyTheGreatestAreNotedOneByOne) {
  // The last pair is nearer, so it comes first.
  const std::vector<std::string> notes = notes_on_start(row_of_points({0, 0.9, 1.8, 2.7, 3.6, 4.45}));
  ASSERT_EQ(notes.size(), 4u);
  EXPECT_TRUE(notes[0].starts_with("p4 and p5 begin 0.85 m apart, ")) << notes[0];
  EXPECT_EQ(notes[3], "layers of contact also push the bodies of 2 more pairs apart, with 2 J in all");
}

TEST(StartLayers, NothingPushesWhatIsExcludedOrHeld) {
  Json scene = row_of_points({0, 0.9});
  scene["bodies"][0]["pin"] = {"all"};
  EXPECT_EQ(notes_on_start(scene).size(), 1u);
  scene["bodies"][1]["pin"] = {"all"};
  EXPECT_EQ(notes_on_start(scene).size(), 0u);
  scene = row_of_points({0, 0.9});
  scene["contact"]["exclude"] = Json::parse(R"([["p0", "p1"]])");
  EXPECT_EQ(notes_on_start(scene).size(), 0u);
  scene.erase("contact");
  EXPECT_EQ(notes_on_start(scene).size(), 0u);
}

TEST(StartLayers, HaveTheEnergyOfASimulation) {
  expect_energy_of_simulation<2>(row_of_points({0, 0.9}), 1);
  expect_energy_of_simulation<2>(row_of_points({0, 0.5}), 15);  // layer 16 is 0.5 m thick
  for (const bool joined : {false, true}) {
    Json scene = box_above_floor();
    scene["contact"]["inclusion_exclusion"] = joined;
    expect_energy_of_simulation<3>(scene, 6);  // 0.08 m / 6^(1/4) = 0.0511 m
  }
}

TEST(StartLayers, WhenThereAreTooManyTheEnergyIsALeastOne) {
  Json scene = row_of_points({0, 0.001, 0.002, 0.003, 0.004});
  scene["contact"]["most_layers"] = 1000000;
  const std::vector<StartPush> pushes = find_start_pushes(build_model<2>(parse_scene(scene.dump(), "s.json")));
  ASSERT_EQ(pushes.size(), 10u);
  EXPECT_TRUE(pushes[0].at_least);
  const std::vector<std::string> notes = notes_on_start(scene);
  ASSERT_EQ(notes.size(), 4u);
  EXPECT_NE(notes[0].find("they push each other apart with at least "), std::string::npos) << notes[0];
  EXPECT_NE(notes[3].find("7 more pairs apart, with at least "), std::string::npos) << notes[3];
}

}  // namespace
}  // namespace noli::integrator
