// SPDX-License-Identifier: Apache-2.0
#include "audit/numerics/stability_rows.h"

#include <fmt/format.h>

#include <cmath>

#include "certify/json.h"
#include "trajectory/formats/write_ply.h"

namespace noli::audit {
namespace {

// --- scenes ----------------------------------------------------------------------------------------------------------

Json sheet_material() { return {{"young", 1e5}, {"density", 300}, {"thickness", 0.001}}; }
Json chain_material() { return {{"edge_stiffness", 100}, {"mass_per_length", 1}}; }

Json lasting(Json scene, double duration, int windows) {
  scene["duration"] = duration;
  scene["window"] = duration / windows;
  return scene;
}

/// A sheet that flies and spins; with contact, it flies against another one.
Json sheets(bool contact) {
  Json scene = {{"noli_scene", 1}, {"bodies", Json::array()}};
  Json body = {{"name", "sheet"},
               {"mesh", {{"grid", {{"size", {0.3, 0.3}}, {"cells", {3, 3}}}}}},
               {"transform", {{"rotate", {{"axis", {1, 2, 3}}, {"degrees", 25}}}}},
               {"velocity", {0.1, 0.2, -1}},
               {"spin", {1, 2, 3}},
               {"material", sheet_material()}};
  if (contact) body["transform"]["translate"] = {0.01, 0.02, 0.12};
  scene["bodies"].push_back(body);
  if (contact) {
    scene["bodies"].push_back({{"name", "other"},
                               {"mesh", {{"grid", {{"size", {0.4, 0.4}}, {"cells", {3, 3}}}}}},
                               {"material", sheet_material()}});
    scene["contact"] = {{"thickness", 0.01}};
  }
  return lasting(std::move(scene), 0.2, 10);
}

/// The same in the plane.
Json chains(bool contact) {
  Json scene = {{"noli_scene", 1}, {"dimension", 2}, {"bodies", Json::array()}};
  scene["bodies"].push_back({{"name", "chain"},
                             {"mesh", {{"chain", {{"points", {{-0.5, 0}, {0.5, 0}}}, {"segments", 4}}}}},
                             {"velocity", {0.3, -1}},
                             {"spin", 2},
                             {"material", chain_material()}});
  if (contact) {
    scene["bodies"].push_back({{"name", "other"},
                               {"mesh", {{"chain", {{"points", {{-0.8, -0.3}, {0.7, -0.4}}}, {"segments", 3}}}}},
                               {"material", chain_material()}});
    scene["contact"] = {{"thickness", 0.01}};
  }
  return lasting(std::move(scene), 0.6, 12);
}

/// Scales a number, or all numbers in nested arrays.
void scale(Json& numbers, double factor) {
  if (numbers.is_number()) numbers = numbers.get<double>() * factor;
  if (numbers.is_array()) {
    for (Json& each : numbers) scale(each, factor);
  }
}

/// Changes a property of one cell, or one spring, of the first body.
Json patched(Json scene, const char* property, double factor) {
  const bool plane = scene.contains("dimension");
  const Json box = plane ? Json{{-0.2, -1}, {0, 1}} : Json{{-0.05, -0.05, -1}, {0.05, 0.05, 1}};
  Json& body = scene["bodies"][0];
  if (!plane) body["transform"].erase("rotate");  // the box refers to the start position
  body["patches"] = {{{"box", box}, {property, factor}}};
  return scene;
}

/// Puts the two bodies of a scene of sheets flat above each other, within two thicknesses of the first layer.
Json sheets_about_to_meet(double thickness) {
  Json scene = sheets(true);
  scene["bodies"][0]["transform"] = {{"translate", {0.01, 0.02, 2 * thickness}}};
  scene["contact"]["thickness"] = thickness;
  return scene;
}

/// The step of a stiff spring shrinks as its frequency grows. Beyond a ratio of a million the run is shortened in
/// proportion, so that the computing time stays the same.
Json stiffness_ratio(bool contact, double ratio) {
  Json scene = patched(chains(contact), "stiffness_factor", ratio);
  const double shorter = std::max(1.0, std::sqrt(ratio / 1e6));
  if (contact) {
    const double below = -0.02 / shorter;
    scene["bodies"][1]["mesh"]["chain"]["points"] = {{-0.8, below}, {0.7, below}};
    scene["contact"]["thickness"] = 0.01 / shorter;
  }
  return lasting(std::move(scene), 0.6 / shorter, 12);
}

Json light_ratio(bool contact, double ratio) {
  const double shorter = std::sqrt(ratio);
  Json scene = contact ? sheets_about_to_meet(0.01 / shorter) : sheets(false);
  return lasting(patched(std::move(scene), "density_factor", 1 / ratio), 0.2 / shorter, 10);
}

Json thickness(Json scene, double value) {
  scene["contact"]["thickness"] = value;
  return scene;
}

/// Travels the same distance as at ordinary speed.
Json speed(Json scene, double factor) {
  const double duration = scene["duration"].get<double>() / factor;
  for (const char* const motion : {"velocity", "spin"}) scale(scene["bodies"][0][motion], factor);
  return lasting(std::move(scene), duration, 10);
}

/// The first layer is only as stiff as ordinary speed requires, so deeper ones have to act.
Json speed_against_weak_layers(double factor) {
  Json scene = speed(chains(true), factor);
  scene["contact"]["stiffness"] = 2500;
  return scene;
}

Json offset(Json scene, double value) {
  for (Json& body : scene["bodies"]) {
    Json& translate = body["transform"]["translate"];
    if (translate.is_null()) translate = {0, 0, 0};
    for (std::size_t k = 0; k < 2; ++k) translate[k] = translate[k].get<double>() + value;
  }
  return scene;
}

/// Multiplies all lengths and speeds by a factor. Uses masses at vertices, because products of lengths leave the range
/// of double before lengths do.
Json magnitude(bool contact, double factor) {
  Json scene = chains(contact);
  for (Json& body : scene["bodies"]) {
    scale(body["mesh"]["chain"]["points"], factor);
    body["material"] = {{"edge_stiffness", 100}, {"mass_per_vertex", 1}};
    if (body.contains("velocity")) scale(body["velocity"], factor);
  }
  if (contact) scene["contact"]["thickness"] = 0.01 * factor;
  return scene;
}

/// A sheet whose cells are `ratio` times longer than wide.
Json slivers(bool contact, double ratio) {
  Json scene = contact ? sheets_about_to_meet(0.01 / ratio) : sheets(false);
  scene["bodies"][0]["mesh"]["grid"]["size"] = {0.3, 0.3 / ratio};
  scene["bodies"][0]["material"]["bending"] = 0;
  return lasting(std::move(scene), 0.2 / ratio, 10);
}

/// Makes coordinates and speeds in one direction subnormal, or nearly so.
Json subnormal(bool contact, double value) {
  Json scene = sheets(contact);
  Json& body = scene["bodies"][contact ? 1 : 0];
  body.erase("transform");
  body["transform"]["translate"] = {0, 0, value};
  body["velocity"] = {contact ? 0.0 : 0.1, 0, value};
  if (!contact) body["spin"] = {0, 0, 3};
  return scene;
}

Json elastic_steps(double factor, bool unstable) {
  Json scene = lasting(sheets(false), 2, 20);
  scene["step_factor"] = factor;
  scene["allow_unstable"] = unstable;
  return scene;
}

Json layer_steps(double stability, bool unstable) {
  Json scene = sheets(true);
  scene["contact"]["stability"] = stability;
  scene["allow_unstable"] = unstable;
  return scene;
}

/// A mass between a stiff spring and a soft one with a step ten times as long, both held at their other ends.
/// scenes/resonance.json shows the two ends of this row. With contact, a free point also bounces off the soft spring.
Json resonance(bool contact, double step) {
  const Json soft = {{"box", {{0, -0.5}, {1, 0.5}}}, {"stiffness_factor", 0.25}, {"steps", {{"stretch", 10 * step}}}};
  const Json body = {{"name", "mass"},
                     {"mesh", {{"chain", {{"points", {{-1, 0}, {1, 0}}}, {"segments", 2}}}}},
                     {"velocity", {1e-6, 0}},
                     {"material", {{"edge_stiffness", 1}, {"mass_per_vertex", 1}}},
                     {"steps", {{"stretch", step}}},
                     {"patches", Json::array({soft})},
                     {"pin", {"first", "last"}}};
  Json scene = {{"noli_scene", 1}, {"dimension", 2}, {"steps", "own"}, {"allow_unstable", true}};
  scene["bodies"] = Json::array({body});  // compilers disagree on the meaning of {body}
  if (contact) {
    const double speed = 1e-6, thickness = 1e-3;
    scene["bodies"].push_back({{"name", "point"},
                               {"mesh", {{"points", {{"at", {{0.5, thickness + 80 * step * speed}}}}}}},
                               {"velocity", {0, -speed}},
                               {"material", {{"mass_per_vertex", 1}, {"edge_stiffness", 0}}}});
    scene["contact"] = {{"thickness", thickness}, {"stiffness", 1}};
  }
  return lasting(std::move(scene), 400 * step, 20);
}

// --- frames ----------------------------------------------------------------------------------------------------------

/// A face, and above it another one whose lowest corner moves down to half a unit above its plane, or half a unit below
/// if they `touch`. `change` maps all positions.
FramesCase corner_over_face(bool touch, const std::function<Position(Position)>& change) {
  Frame frame;
  frame.mesh.vertex_count = 6;
  frame.mesh.faces = {{0, 1, 2}, {3, 4, 5}};
  FramesCase result;
  result.touch = touch;
  for (std::size_t i = 0; i < 2; ++i) {
    const double down = i == 0 ? 0 : touch ? 1.5 : 0.5;
    frame.positions = {{-4, -4, 0}, {4, -4, 0}, {0, 4, 0}, {0, 0, 1 - down}, {-1, 0, 3 - down}, {1, 0, 3 - down}};
    for (Position& x : frame.positions) x = change(x);
    result.frames[i] = format_ply(frame, PlyEncoding::ascii);
  }
  return result;
}

/// The greatest power of two up to `value`: scaling by it is exact and leaves the answer the same, as long as nothing
/// underflows.
double power_below(double value) { return std::ldexp(1.0, std::ilogb(value)); }

FramesCase frames_magnitude(bool touch, double value) {
  const double factor = power_below(value);
  return corner_over_face(touch, [factor](const Position& x) {
    return Position{x[0] * factor, x[1] * factor, x[2] * factor};
  });
}

/// Makes heights small. They are multiples of half a unit, so exact as long as half the unit is a double.
FramesCase frames_height(bool touch, double value) {
  const double factor = power_below(value);
  return corner_over_face(touch, [factor](const Position& x) { return Position{x[0], x[1], x[2] * factor}; });
}

FramesCase frames_sliver(bool touch, double ratio) {
  const double factor = power_below(1 / ratio);
  return corner_over_face(touch, [factor](const Position& x) { return Position{x[0], x[1] * factor, x[2]}; });
}

/// Moves all positions by an offset. Exact as long as a half does not round away beside it.
FramesCase frames_offset(bool touch, double value) {
  const double far = power_below(value);
  return corner_over_face(touch, [far](const Position& x) { return Position{x[0] + far, x[1] + far, x[2] + far}; });
}

// --- rows ------------------------------------------------------------------------------------------------------------

class Rows {
 public:
  /// Adds two rows: without contact and with it.
  void scenes(const std::string& name, const std::string& varied, const std::vector<double>& values,
              const std::function<Json(bool, double)>& make) {
    for (const bool contact : {false, true}) {
      scene(name + (contact ? "-contact" : ""), varied, contact, values,
            [make, contact](double value) { return make(contact, value); });
    }
  }

  void scene(const std::string& name, const std::string& varied, bool contact, const std::vector<double>& values,
             const std::function<Json(double)>& make) {
    all.push_back({name, varied, contact, values, [make, name](double value) {
                     Json scene = make(value);
                     scene["title"] = fmt::format("{}, {:g}", name, value);
                     bool free = true;
                     for (const Json& body : scene["bodies"]) free = free && !body.contains("pin");
                     return StabilityCase(SceneCase{scene.dump(2) + "\n", free});
                   }});
  }

  void frames(const std::string& name, const std::string& varied, const std::vector<double>& values,
              const std::function<FramesCase(bool, double)>& make) {
    for (const bool touch : {false, true}) {
      all.push_back({name + (touch ? "-contact" : ""), varied, touch, values,
                     [make, touch](double value) { return StabilityCase(make(touch, value)); }});
    }
  }

  std::vector<StabilityRow> all;
};

void add_scenes(Rows& rows) {
  rows.scenes("stiffness-ratio", "stiffness of a spring / others", {1, 1e3, 1e6, 1e9, 1e12}, stiffness_ratio);
  rows.scenes("mass-ratio", "density of a spring / others", {1, 1e3, 1e6, 1e9},
              [](bool contact, double ratio) { return patched(chains(contact), "density_factor", ratio); });
  rows.scenes("light-ratio", "1 / density of a cell / others", {1, 1e3, 1e6, 1e9}, light_ratio);
  const std::vector<double> thicknesses = {1e-2, 1e-3, 1e-6, 1e-9, 1e-12};
  rows.scene("thickness-plane-contact", "thickness of the first layer [m]", true, thicknesses,
             [](double value) { return thickness(chains(true), value); });
  rows.scene("thickness-contact", "thickness of the first layer [m]", true, thicknesses,
             [](double value) { return thickness(sheets(true), value); });
  rows.scene("thickness-all-layers-contact", "thickness of the first layer [m]", true, thicknesses, [](double value) {
    Json scene = thickness(chains(true), value);
    scene["contact"]["most_layers"] = 1'000'000;
    return scene;
  });
  const std::vector<double> factors = {1, 1e3, 1e6, 1e9};
  rows.scenes("speed", "speed [m/s]", factors,
              [](bool contact, double factor) { return speed(sheets(contact), factor); });
  rows.scene("speed-weak-layers-contact", "speed [m/s]", true, {1, 10, 100, 1e3, 1e6, 1e9}, speed_against_weak_layers);
  rows.scenes("offset", "distance from the origin [m]", {1, 1e3, 1e6, 1e9, 1e12},
              [](bool contact, double value) { return offset(sheets(contact), value); });
  rows.scenes("magnitude-large", "size of the scene [m]", {1, 1e50, 1e100, 1e150, 1e200, 1e300}, magnitude);
  rows.scenes("magnitude-small", "size of the scene [m]", {1, 1e-50, 1e-100, 1e-150, 1e-200, 1e-300}, magnitude);
  rows.scenes("slivers", "length / width of a cell", {1, 1e2, 1e4, 1e6, 1e8}, slivers);
  rows.scenes("subnormals", "coordinates and speed [m, m/s]", {1e-3, 1e-100, 1e-300, 1e-310, 4.9406564584124654e-324},
              subnormal);
  const std::vector<double> parts = {0.25, 0.5, 1, 1.5, 2, 4, 8};
  rows.scene("steps", "step / limit of stability", false, parts,
             [](double factor) { return elastic_steps(factor, true); });
  rows.scene("steps-not-allowed", "step / limit of stability", false, parts,
             [](double factor) { return elastic_steps(factor, false); });
  const std::vector<double> stabilities = {0.05, 0.1, 0.2, 0.5, 1, 2, 4};
  rows.scene("steps-contact", "\"stability\" of layers", true, stabilities,
             [](double value) { return layer_steps(value, true); });
  rows.scene("steps-not-allowed-contact", "\"stability\" of layers", true, stabilities,
             [](double value) { return layer_steps(value, false); });
  rows.scenes("resonance", "step of the stiff spring [s]", {0.02, 0.05, 0.1, 0.2, 0.25, 0.26, 0.27}, resonance);
}

void add_frames(Rows& rows) {
  rows.frames("frames-magnitude-large", "size of the frames", {1, 1e100, 1e200, 1e300}, frames_magnitude);
  rows.frames("frames-magnitude-small", "size of the frames", {1, 1e-100, 1e-200, 1e-300, 1e-310, 1e-322},
              frames_magnitude);
  rows.frames("frames-height", "height of the upper face", {1, 1e-100, 1e-200, 1e-300, 1e-310, 1e-322}, frames_height);
  rows.frames("frames-slivers", "length / width of the faces", {1, 1e6, 1e12, 1e100, 1e300}, frames_sliver);
  rows.frames("frames-offset", "distance from the origin", {1, 1e3, 1e6, 1e9, 1e12, 1e15}, frames_offset);
}

}  // namespace

std::vector<StabilityRow> stability_rows() {
  Rows rows;
  add_scenes(rows);
  add_frames(rows);
  return std::move(rows.all);
}

}  // namespace noli::audit
