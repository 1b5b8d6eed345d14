// SPDX-License-Identifier: Apache-2.0
#include "audit/fuzz/scenes/scene_generators.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace noli::audit {

namespace {

/// What is extreme about a scene. Lengths are in units of `size`. Members stand in the order in which generators draw
/// them.
struct Extremes {
  double size = 1;             ///< of a body [m]
  double stiffness = 100;      ///< of the lowest body's edges [N/m]
  double stiffness_ratio = 1;  ///< of each body to the one below it
  double mass = 0.01;          ///< of a vertex of the lowest body [kg]
  double mass_ratio = 1;
  double thickness = 0.05;  ///< of contact
  int most_layers = 1000;
  double speed = 1;   ///< [sizes/s]
  double offset = 0;  ///< of everything from the origin
  double sliver = 1;  ///< the width of what is broad
  double step_factor = 0.5;
  bool unstable = false, own_steps = false, contact = true;
};

/// 2^low to 2^high, each power as likely, times 1 to 2 in sixteenths.
double between_powers(Random& random, int low, int high) {
  const auto exponent = static_cast<int>(random.between(low, high));
  return std::ldexp(static_cast<double>(random.between(16, 31)) / 16, exponent);
}

double power(double base, int exponent) {
  double result = 1;
  for (; exponent > 0; --exponent) result *= base;
  return result;
}

/// -1 to 1 in steps of 1/64.
double fraction(Random& random) { return static_cast<double>(random.between(-64, 64)) / 64; }

class SceneMaker {
 public:
  SceneMaker(const Extremes& extremes, Random& random)
      : e_(extremes), random_(random), dimension_(random.one_in(2) ? 2 : 3) {}

  SceneJson make() {
    const auto bodies = static_cast<int>(random_.between(2, 3));
    scene_["noli_scene"] = 1;
    scene_["dimension"] = dimension_;
    choose_windows(bodies);
    if (random_.one_in(3)) scene_["gravity"] = along_height(-e_.size * between_powers(random_, -2, 4));
    if (e_.own_steps) scene_["steps"] = "own";
    if (e_.step_factor != 0.5) scene_["step_factor"] = e_.step_factor;
    if (e_.unstable) scene_["allow_unstable"] = true;
    if (random_.one_in(8)) scene_["record"] = "frames";
    scene_["bodies"] = SceneJson::array();
    for (int i = 0; i < bodies; ++i) scene_["bodies"].push_back(body(i));
    const std::uint64_t held = random_.below(4);
    if (held == 0) scene_["bodies"][0]["pin"] = {"all"};
    if (held == 1) add_script();
    if (e_.contact) scene_["contact"] = contact();
    return scene_;
  }

 private:
  /// About a hundred steps of the stiffest, lightest body a window, and a few windows until something meets.
  void choose_windows(int bodies) {
    const double ratio = std::max(1.0, power(e_.stiffness_ratio, bodies - 1)),
                 lightest = e_.mass * std::min(1.0, e_.mass_ratio * (bodies > 2 ? e_.mass_ratio : 1));
    const double step = e_.step_factor * std::sqrt(lightest / (e_.stiffness * ratio));
    const double window = std::min({100 * step, 0.4 / e_.speed, 0.25});
    scene_["window"] = std::clamp(window, 1e-12, 1e6);
    windows_ = static_cast<int>(random_.between(2, 5));
    duration_ = std::clamp(window, 1e-12, 1e6) * windows_;
    scene_["duration"] = duration_;
  }

  /// Height is the last coordinate; the others are as given.
  SceneJson vector(double along, double height) const {
    return dimension_ == 2 ? SceneJson{along, height} : SceneJson{along, 0.5 * along, height};
  }
  SceneJson along_height(double height) const { return vector(0, height); }

  /// The places of a line across, a little tilted.
  SceneJson line() {
    SceneJson points = SceneJson::array();
    for (const double x : {-0.5, 0.5}) points.push_back(vector(e_.size * x, e_.size * 0.1 * fraction(random_)));
    return points;
  }

  SceneJson loose_points() {
    SceneJson at = SceneJson::array();
    for (std::int64_t i = random_.between(1, 4); i > 0; --i) {
      const double x = e_.size * (0.2 * static_cast<double>(i) - 0.5);
      at.push_back(vector(x, e_.size * 0.1 * fraction(random_)));
    }
    return {{"points", {{"at", at}}}};
  }

  SceneJson mesh() {
    const std::uint64_t kind = random_.below(dimension_ == 2 ? 3 : 6);
    if (kind == 0) return {{"chain", {{"points", line()}, {"segments", random_.between(1, 4)}}}};
    if (kind == 1) return loose_points();
    if (dimension_ == 2) return {{"ring", {{"radius", 0.25 * e_.size}, {"segments", random_.between(3, 7)}}}};
    if (kind == 2) {
      const SceneJson size = {e_.size, e_.size * e_.sliver}, cells = {random_.between(1, 3), random_.between(1, 2)};
      return {{"grid", {{"size", size}, {"cells", cells}}}};
    }
    if (kind == 3) return {{"sphere", {{"radius", 0.25 * e_.size}, {"subdivisions", 0}}}};
    return {{"pyramid",
             {{"radius", 0.3 * e_.size * e_.sliver}, {"height", 0.25 * e_.size}, {"sides", random_.between(3, 5)}}}};
  }

  SceneJson body(int i) {
    SceneJson body;
    body["name"] = "body" + std::to_string(i);
    body["mesh"] = mesh();
    const bool points = body["mesh"].contains("points");
    const double place = e_.offset * e_.size;
    body["transform"]["translate"] = vector(place + 0.1 * e_.size * fraction(random_), place + e_.size * 0.8 * i);
    if (!points && random_.one_in(2)) body["perturb"] = std::ldexp(e_.size, -10);
    if (i > 0) body["velocity"] = vector(0.1 * e_.size * e_.speed * fraction(random_), -e_.size * e_.speed * i);
    body["material"] = {{"edge_stiffness", points ? 0 : e_.stiffness * power(e_.stiffness_ratio, i)},
                        {"mass_per_vertex", e_.mass * power(e_.mass_ratio, i)}};
    if (!points && random_.one_in(3)) body["material"]["damping"] = 0.001 * duration_;
    return body;
  }

  void add_script() {
    const SceneJson path = {{{"t", 0}, {"move", along_height(0)}},
                            {{"t", duration_ * 0.75}, {"move", along_height(0.4 * e_.size * fraction(random_))}}};
    scene_["scripts"] = {{{"body", "body0"}, {"path", path}}};
  }

  SceneJson contact() {
    SceneJson contact = {{"thickness", e_.size * e_.thickness * std::min(1.0, e_.sliver)}};
    if (random_.one_in(2)) contact["stiffness"] = e_.stiffness * between_powers(random_, -3, 6);
    if (random_.one_in(3)) contact["restitution"] = static_cast<double>(random_.below(5)) / 4;
    if (random_.one_in(3)) contact["friction"] = static_cast<double>(random_.below(5)) / 4;
    if (e_.most_layers != 1000) contact["most_layers"] = e_.most_layers;
    if (random_.one_in(8)) contact["exclude"] = SceneJson::array({SceneJson::array({"body0", "body1"})});
    if (random_.one_in(4)) contact["inclusion_exclusion"] = true;
    return contact;
  }

  const Extremes& e_;
  Random& random_;
  int dimension_, windows_ = 0;
  double duration_ = 0;
  SceneJson scene_;
};

GeneratedScene made(const Extremes& extremes, Random& random) { return {SceneMaker(extremes, random).make(), {}}; }

GeneratedScene plain(Random& random) { return made({}, random); }

GeneratedScene stiff(Random& random) {
  return made({.stiffness = between_powers(random, -10, 30), .stiffness_ratio = between_powers(random, -20, 20)},
              random);
}

GeneratedScene heavy(Random& random) {
  return made({.mass = between_powers(random, -20, 10), .mass_ratio = between_powers(random, -15, 15)}, random);
}

GeneratedScene fast(Random& random) { return made({.speed = between_powers(random, -10, 30)}, random); }

GeneratedScene thin(Random& random) {
  return made({.thickness = between_powers(random, -40, -4), .speed = between_powers(random, -4, 4)}, random);
}

GeneratedScene far_off(Random& random) {
  Extremes e;
  const double sign = random.one_in(2) ? 1 : -1;  // drawn first
  e.offset = sign * between_powers(random, 10, 44);
  return made(e, random);
}

GeneratedScene scaled(Random& random) {
  const int low = random.one_in(4) ? -300 : -30, high = random.one_in(4) ? 300 : 30;
  return made({.size = between_powers(random, low, high)}, random);
}

GeneratedScene sliver(Random& random) { return made({.sliver = between_powers(random, -30, -1)}, random); }

GeneratedScene long_steps(Random& random) {
  Extremes e;
  e.step_factor = static_cast<double>(random.between(56, 80)) / 64;
  e.unstable = e.step_factor > 1;
  e.own_steps = random.one_in(2);
  return made(e, random);
}

GeneratedScene few_layers(Random& random) {
  return made({.most_layers = static_cast<int>(random.between(1, 4)), .speed = between_powers(random, 0, 10)}, random);
}

GeneratedScene no_contact_forces(Random& random) {
  return made({.speed = between_powers(random, 0, 6), .contact = false}, random);
}

/// A value that is wrong, at a place, which is made if it is not there.
struct Wrong {
  const char* place;
  SceneJson value;
};

GeneratedScene invalid(Random& random) {
  GeneratedScene generated = plain(random);
  SceneJson& scene = generated.scene;
  scene["contact"]["thickness"] = 0.05;
  static const std::vector<Wrong> faults = {
      {"/noli_scene", 2},
      {"/duration", 0},
      {"/duration", "long"},
      {"/window", -1},
      {"/dimension", 4},
      {"/record", "all"},
      {"/step_factor", 0},
      {"/seed", -1},
      {"/seed", 1.5},
      {"/gravity", {1}},
      {"/gravity", {1, 2, 3, 4}},
      {"/bodies", SceneJson::array()},
      {"/bodies/0/mesh", SceneJson::object()},
      {"/bodies/0/mesh", {{"file", "absent.ply"}}},
      {"/bodies/0/material/edge_stiffness", -1},
      {"/bodies/0/material/mass_per_vertex", 0},
      {"/bodies/0/material", {{"edge_stiffness", 1}}},
      {"/bodies/0/material", {{"young", 1}}},
      {"/bodies/1/velocity", {0}},
      {"/bodies/1/perturb", -1},
      {"/bodies/1/pin", {"no such set"}},
      {"/bodies/1/pin", {1000000}},
      {"/bodies/1/colour", "red"},
      {"/bodies/1/name", "body0"},
      {"/scripts", {{{"body", "nobody"}, {"path", {{{"t", 0}, {"move", {0, 0, 0}}}}}}}},
      {"/contact/thickness", 0},
      {"/contact/thicknes", 0.1},
      {"/contact/exclude", SceneJson::array({SceneJson::array({"body0", "nobody"})})},
      {"/contact/most_layers", 0},
      {"/contact/restitution", "much"},
  };
  const Wrong& wrong = faults[random.below(faults.size())];
  scene[SceneJson::json_pointer(wrong.place)] = wrong.value;
  generated.wrong_place = wrong.place;
  return generated;
}

constexpr std::array<SceneGenerator, 12> generators = {{
    {"plain", "nothing is extreme", plain},
    {"stiff", "lowest body from 2^-10 to 2^31 N/m, each other up to 2^21 times stiffer or softer", stiff},
    {"heavy", "masses up to 2^16 apart, from body to body", heavy},
    {"fast", "speeds up to 2^31 sizes a second", fast},
    {"thin", "layers of contact down to 2^-40 of a body", thin},
    {"far_off", "everything up to 2^45 sizes off the origin", far_off},
    {"scaled", "bodies from 2^-300 to 2^301 m", scaled},
    {"sliver", "triangles up to 2^30 times longer than wide", sliver},
    {"long_steps", "steps just below and above the limit of stability", long_steps},
    {"few_layers", "contact that may not have the layers it needs", few_layers},
    {"no_contact_forces", "a run that has to end at the first contact", no_contact_forces},
    {"invalid", "one thing wrong, which the message has to name", invalid},
}};

}  // namespace

std::span<const SceneGenerator> scene_generators() { return generators; }

}  // namespace noli::audit
