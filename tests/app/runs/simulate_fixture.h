// SPDX-License-Identifier: Apache-2.0
//
// Runs small scenes for the tests of commands that write and read runs.
#pragma once

#include <gtest/gtest.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <string>

#include "tests/app/process.h"
#include "tests/app/runs/bouncing_point.h"
#include "tests/app/scene.h"
#include "trajectory/blocks/run_log.h"

namespace noli::app_tests {

using Json = nlohmann::json;
namespace fs = std::filesystem;

inline std::string bytes_of(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

class Simulate : public testing::Test {
 protected:
  std::string scene(const Json& json) const { return folder.write("scene.json", json.dump(2)); }
  std::string run_path(const std::string& name) const { return folder.path(name); }
  std::string blocks(const std::string& run) const {
    return bytes_of(fs::path(folder.path(run)) / "trajectory.blocks");
  }

  /// A small sheet that hangs from two corners and swings.
  static Json hanging_sheet() {
    return Json::parse(R"({
      "noli_scene": 1, "title": "hanging sheet", "duration": 0.25, "window": 0.01, "gravity": [0, 0, -9.81],
      "bodies": [{"name": "sheet", "mesh": {"grid": {"size": [1, 1], "cells": [6, 6]}}, "perturb": 1e-3,
                  "material": {"young": 2e4, "poisson": 0.3, "density": 200, "thickness": 0.001, "bending": 100},
                  "pin": [0, 6]}]})");
  }

  /// A triangle whose lowest corner falls through a resting one. All numbers are short, so the first time is exactly
  /// 0.3125 s.
  Json falling_triangle() const {
    folder.write("level.obj", "v -1 -1 0\nv 1 -1 0\nv 0 1 0\nf 1 2 3\n");
    folder.write("upright.obj", "v 0 -0.25 0.3125\nv -0.25 -0.25 1\nv 0.25 -0.25 1\nf 1 2 3\n");
    return Json::parse(R"({
      "noli_scene": 1, "title": "falling triangle", "duration": 1, "window": 0.0078125,
      "bodies": [{"name": "level", "mesh": {"file": "level.obj"},
                  "material": {"young": 1e4, "density": 200, "thickness": 0.001}},
                 {"name": "upright", "mesh": {"file": "upright.obj"},
                  "material": {"young": 1e4, "density": 200, "thickness": 0.001}}],
      "scripts": [{"body": "upright", "path": [{"t": 0, "move": [0, 0, 0]}, {"t": 1, "move": [0, 0, -1]}]}]})");
  }

  Folder folder;
};

/// A bar in the plane at rest, so that many events leave few breakpoints.
inline Json resting_bar(double duration, double window) {
  Json json = Json::parse(R"({
      "noli_scene": 1, "dimension": 2, "bodies": [
        {"name": "bar", "mesh": {"chain": {"points": [[0, 0], [1, 0]], "segments": 1}}, "steps": {"stretch": 1e-3},
         "material": {"edge_stiffness": 1, "mass_per_vertex": 1}}]})");
  json["duration"] = duration;
  json["window"] = window;
  return json;
}

/// A small cloth that falls onto a pinned, tilted one below it.
inline Json two_cloths() {
  const Json material = {{"young", 2e4}, {"density", 200}, {"thickness", 0.001}};
  return {{"noli_scene", 1},
          {"title", "Two cloths"},
          {"duration", 0.2},
          {"window", 0.01},
          {"gravity", {0, 0, -9.81}},
          {"bodies",
           {{{"name", "falling"},
             {"mesh", {{"grid", {{"size", {0.3, 0.3}}, {"cells", {4, 4}}}}}},
             {"transform", {{"translate", {0.02, 0.01, 0.06}}}},
             {"velocity", {0, 0, -1}},
             {"material", material}},
            {{"name", "lying"},
             {"mesh", {{"grid", {{"size", {0.3, 0.3}}, {"cells", {3, 3}}}}}},
             {"transform", {{"rotate", {{"axis", {1, 0, 0}}, {"degrees", 10}}}}},
             {"material", material},
             {"pin", {"all"}}}}},
          {"contact", {{"thickness", 0.01}, {"stiffness", 200}, {"friction", 0.3}, {"restitution", 0.5}}}};
}

inline Json last_entry(const std::string& run) {
  Json last;
  read_log_lines(run, [&last](const nlohmann::ordered_json& entry) { last = entry; });
  return last;
}

/// Adds a line to the log of a run.
inline void add_entry(const std::string& run, const nlohmann::ordered_json& entry) { RunLog(run).append(entry); }

/// Whether `noli report` is built; if not, prints that the test runs without it.
inline bool reports_are_there() {
  const bool there =
      run_noli({"report", "absent", "-o", "absent"}).err.find("built without reports") == std::string::npos;
  if (!there) std::puts("reports are not built: not tested with them");
  return there;
}

inline ProcessOptions interrupt_after(int milliseconds) {
  ProcessOptions options;
  options.signal = SIGINT;
  options.signal_after = std::chrono::milliseconds(milliseconds);
  return options;
}

/// A beam in the plane, cheap enough for long runs.
inline Json beam(double duration) {
  Json json = Json::parse(bytes_of(fs::path(NOLI_SOURCE_DIR) / "scenes/cantilever.json"));
  json["duration"] = duration;
  return json;
}

}  // namespace noli::app_tests
