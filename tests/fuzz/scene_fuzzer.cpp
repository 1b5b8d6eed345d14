// SPDX-License-Identifier: Apache-2.0
//
// Fuzzes the reader of scenes: any text gives an InputError of one line, or a scene that can be explained, which builds
// its meshes, forces and steps, or is then refused in one line.
//
// Input: 'S' or 'F' for the short or full form, then the text; or only the text, in full form, so that a scene file is
// an input as it is. Scenes of more than a few hundred vertices and scenes that name files are only read.
#include <algorithm>
#include <cstdint>
#include <string_view>

#include <noli/errors.h>
#include "check_frame.h"
#include "integrator/scene/explain.h"
#include "integrator/scene/read_scene.h"

namespace {

using noli::fuzz::require;
using noli::integrator::Json;

constexpr double many = 500;

/// Estimates the size of a mesh as the product of the integers in its description.
double size_of(const Json& value, const std::string& name) {
  if (value.is_number_integer()) {
    const double n = value.get<double>();
    return name == "subdivisions" ? (n < 4 ? 20 * (1 << static_cast<int>(std::max(n, 0.0)) * 2) : 2 * many)
                                  : std::max(n, 0.0) + 1;
  }
  double size = 1;
  if (!value.is_structured()) return size;
  for (const auto& [key, item] : value.items()) {
    const bool counts = value.is_object() || name == "cells" || name == "counts" || name == "array";
    if (counts) size *= size_of(item, value.is_object() ? key : name);
  }
  return size;
}

bool names_files(const Json& document) {
  const auto mesh_file = [](const Json& body) { return body["mesh"].contains("file"); };
  const auto frames = [](const Json& script) { return script.contains("frames"); };
  const Json& bodies = document["bodies"];
  const Json scripts = document.value("scripts", Json::array());
  return std::any_of(bodies.begin(), bodies.end(), mesh_file) || std::any_of(scripts.begin(), scripts.end(), frames);
}

bool is_small(const Json& document) {
  double size = 0;
  for (const Json& body : document["bodies"]) {
    size += size_of(body["mesh"], "mesh") * (body.contains("array") ? size_of(body["array"], "array") : 1);
  }
  return size <= many;
}

void read_and_explain(std::string_view text, noli::integrator::Form form) {
  const noli::integrator::Scene scene = noli::integrator::parse_scene(text, "input", form);
  require(!scene.bodies.empty() && scene.duration > 0 && scene.window > 0);
  if (names_files(scene.document) || !is_small(scene.document)) return;
  const noli::integrator::Explanation explanation = noli::integrator::explain(scene);
  require(explanation.bodies.size() == scene.bodies.size());
  require(!to_text(explanation).empty() && to_json(explanation).is_object());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view input(reinterpret_cast<const char*>(data), size);
  const bool brief = input.starts_with('S'), has_form = brief || input.starts_with('F');
  try {
    read_and_explain(input.substr(has_form ? 1 : 0),
                     brief ? noli::integrator::Form::brief : noli::integrator::Form::full);
  } catch (const noli::InputError& error) {
    const std::string_view message = error.what();
    require(message.starts_with("input: ") && message.find('\n') == std::string_view::npos);
  }
  return 0;
}
