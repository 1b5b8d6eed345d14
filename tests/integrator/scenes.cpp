// SPDX-License-Identifier: Apache-2.0
#include "scenes.h"

#include <tuple>

#include <noli/errors.h>

namespace noli::integrator::testing {

Json sheet() {
  return Json::parse(R"({
    "noli_scene": 1,
    "duration": 1,
    "bodies": [{"mesh": {"grid": {"size": [1, 1], "cells": [2, 2]}},
                "material": {"young": 1e5, "density": 1000, "thickness": 0.01}}]})");
}

Json loop() {
  return Json::parse(R"({
    "noli_scene": 1,
    "dimension": 2,
    "duration": 1,
    "bodies": [{"mesh": {"ring": {"radius": 0.5, "segments": 8}},
                "material": {"edge_stiffness": 100, "bending_stiffness": 0.1, "mass_per_vertex": 0.01}}]})");
}

Json scripted() {
  Json scene = sheet();
  Json& body = scene["bodies"][0];
  body["deform"] = {{"stretch", {1.5, 1.25, 1}}, {"twist", 10}};
  body["transform"] = {{"scale", 2}, {"rotate", {{"axis", {1, 2, 3}}, {"degrees", 30}}}, {"translate", {1, 2, 3}}};
  body["perturb"] = 0.01;
  body["velocity"] = {1, 2, 3};
  body["spin"] = {1, 2, 3};
  body["patches"] = Json::parse(R"([{"box": [[-9, -9, -9], [9, 9, 9]], "stiffness_factor": 2, "density_factor": 3,
                                     "steps": {"stretch": 1e-4, "bend": 1e-4}}])");
  body["pin"] = Json::parse(R"(["left_top", 2])");
  scene["scripts"] = Json::parse(R"([{"body": "body0", "vertices": [4], "path": [{"t": 0, "move": [0, 0, 0]}]}])");
  scene["gravity"] = {0, 0, -9.81};
  return scene;
}

Json changed(Json scene, const std::string& pointer, const Json& value) {
  scene[Json::json_pointer(pointer)] = value;
  return scene;
}

Json without(Json scene, const std::string& pointer) {
  const Json::json_pointer at(pointer);
  scene.at(at.parent_pointer()).erase(at.back());
  return scene;
}

std::string problem_of(const Json& scene, Form form) {
  try {
    parse_scene(scene.dump(), "s.json", form);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

std::vector<Json> scenes_with_every_field() {
  return {Json::parse(R"({
    "noli_scene": 1, "title": "t", "about": "a", "dimension": 3, "duration": 2.5, "window": 0.5, "seed": 7,
    "record": "frames", "frame_rate": 24.5, "steps": "own", "step_factor": 0.25, "allow_unstable": true,
    "gravity": [0.5, 0.25, -9.81], "gravity_step": 0.125, "most_breakpoints": 12345,
    "bodies": [
      {"mesh": {"grid": {"size": [1.5, 2.5], "cells": [4, 5], "diagonals": "parallel",
                         "refine": {"at": [0.5, -0.75], "factor": 3, "radius": 0.125}}},
       "deform": {"stretch": [1.5, 1.25, 1.75], "twist": 10.5},
       "transform": {"scale": 2.5, "rotate": {"axis": [0.5, 1.5, 2.5], "degrees": 30.5}, "translate": [1.5, 2.5, 3.5]},
       "perturb": 0.5,
       "velocity": [0.5, 1.5, 2.5],
       "spin": [0.5, 1.5, 2.5],
       "material": {"young": 1e5, "poisson": 0.25, "density": 1000.5, "thickness": 0.01, "width": 0.02, "bending": 2.5,
                    "damping": 0.1, "bending_damping": 0.2},
       "patches": [{"box": [[-1.5, -1.5, -1.5], [1.5, 1.5, 1.5]], "stiffness_factor": 2.5, "density_factor": 3.5,
                    "steps": {"stretch": 0.02, "bend": 0.03}}],
       "forces": ["stretch"],
       "steps": {"stretch": 0.01, "bend": 0.02},
       "pin": [3, "left", {"box": [[-1.5, -1.5, -1.5], [1.5, 1.5, 1.5]]}]},
      {"name": "curve",
       "mesh": {"chain": {"points": [[0.5, 0.5, 0.5], [1.5, 1.5, 1.5]], "segments": 3, "smooth": true, "closed": true}},
       "transform": {"rotate": {"quaternion": [0.5, 0.25, 1.5, 2.5]}},
       "material": {"edge_stiffness": 5.5, "bending_stiffness": 6.5, "mass_per_area": 7.5, "damping": 0.1,
                    "bending_damping": 0.2}},
      {"mesh": {"file": "a.ply"}, "material": {"edge_stiffness": 5.5, "mass_per_length": 7.5}},
      {"mesh": {"ring": {"radius": 1.5, "segments": 5}}, "material": {"edge_stiffness": 5.5, "mass_per_vertex": 7.5}},
      {"mesh": {"ribbon": {"points": [[0.5, 0.5, 0.5], [1.5, 1.5, 1.5]], "width": 0.5, "segments": 4, "across": 2,
                           "side": [0.5, 1.5, 2.5]}},
       "material": {"edge_stiffness": 5.5, "mass_per_vertex": 7.5}},
      {"mesh": {"disc": {"radius": 1.5, "rings": 3}}, "material": {"edge_stiffness": 5.5, "mass_per_vertex": 7.5}},
      {"mesh": {"rod": {"length": 1.5, "radius": 0.5, "segments": 4, "sides": 5}},
       "material": {"edge_stiffness": 5.5, "mass_per_vertex": 7.5}},
      {"mesh": {"sphere": {"radius": 1.5, "subdivisions": 2}},
       "material": {"edge_stiffness": 5.5, "mass_per_vertex": 7.5}},
      {"mesh": {"box": {"size": [1.5, 2.5, 3.5], "cells": [2, 3, 4]}},
       "material": {"edge_stiffness": 5.5, "mass_per_vertex": 7.5}},
      {"mesh": {"points": {"at": [[0.5, 1.5, 2.5]]}}, "array": {"counts": [2, 3, 4], "spacing": [0.5, 1.5, 2.5]},
       "material": {"edge_stiffness": 5.5, "mass_per_vertex": 7.5}},
      {"mesh": {"torus": {"radius": 1.5, "tube_radius": 0.5, "segments": 4, "sides": 5}},
       "material": {"edge_stiffness": 5.5, "mass_per_vertex": 7.5}},
      {"mesh": {"pyramid": {"radius": 1.5, "height": 0.5, "sides": 4}},
       "material": {"edge_stiffness": 5.5, "mass_per_vertex": 7.5}}
    ],
    "scripts": [
      {"body": "body0", "vertices": [5, "right"], "path": [{"t": 0.5, "move": [0.5, 1.5, 2.5]}]},
      {"body": "body0", "vertices": [6], "frames": {"files": ["a.ply", "b.ply"], "rate": 24.5, "from": 0.5}}
    ],
    "contact": {"thickness": 0.05, "stiffness": 1000.5, "step": 0.0001, "restitution": 0.5, "friction": 0.25,
                "layers": {"thickness_exponent": 1, "stiffness_exponent": 4, "step_exponent": 3},
                "inclusion_exclusion": true, "most_layers": 100, "exclude": [["body0", "body0"]], "pairs": [
                  {"bodies": ["body2", "body2"], "thickness": 0.05, "stiffness": 1000.5, "step": 0.0001,
                   "restitution": 0.5, "friction": 0.25}]},
    "short": {"/duration": 1}})"),
          Json::parse(R"({
    "noli_scene": 1, "duration": 2.5,
    "bodies": [
      {"mesh": {"disc": {"radius": 1.5, "rings": 3}}, "material": {"edge_stiffness": 5.5, "mass_per_vertex": 7.5}},
      {"name": "curve", "mesh": {"disc": {"radius": 1.5, "rings": 3}},
       "material": {"edge_stiffness": 5.5, "mass_per_vertex": 7.5}}
    ],
    "contact": {"stability": 0.125, "newton_restitution": 0.5, "pairs": [
      {"bodies": ["body0", "body0"], "stability": 0.125, "newton_restitution": 0.25}]}})")};
}

bool same(const Scene& a, const Scene& b) {
  const auto parts = [](const Scene& s) {
    return std::tie(s.title, s.about, s.dimension, s.duration, s.window, s.most_breakpoints, s.seed, s.record,
                    s.frame_rate, s.steps, s.step_factor, s.allow_unstable, s.gravity, s.gravity_step, s.bodies,
                    s.scripts, s.contact);
  };
  return parts(a) == parts(b);
}

}  // namespace noli::integrator::testing
