// SPDX-License-Identifier: Apache-2.0
#include "integrator/scene/explain.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "integrator/scene/pinch.h"
#include "integrator/scene/predict.h"
#include "integrator/scene/shapes/body_mesh.h"
#include "integrator/scene/start_layers.h"
#include "trajectory/cells.h"

namespace noli::integrator {
namespace {

constexpr double most_breakpoints = 2e6;  ///< per window, approximately (design, "Volume")

/// Sorts the possible features of a scene into those that it has and those that it lacks.
class Survey {
 public:
  Survey(const Scene& scene, Explanation& explanation) : scene_(scene), out_(explanation) {}

  /// `count` forces of this kind act; `why_not`: the reason when it is zero.
  void forces(std::size_t count, const std::string& what, const std::string& why_not) {
    say(count > 0, fmt::format("{} {}", count, what), what, why_not);
  }

  void run() {
    say(scene_.gravity != Position{}, "gravity", "its acceleration is zero");
    const auto damped = [](const Body& b) { return b.material.damping > 0 || b.material.bending_damping > 0; };
    say(any(damped), "damping", "no material has any");
    say(!scene_.scripts.empty(), "scripts", "the scene has none");
    say(any([](const Body& b) { return !b.pin.empty(); }), "pinned vertices", "the scene has none");
    say(scene_.record == Record::full, "world lines in the files",
        "\"record\" is \"frames\": they can be computed again");
    contact();
    if (scene_.dimension == 2) left_out("third coordinate", "the scene has dimension 2");
  }

  void body(const Body& body, const BuiltBody& built) {
    const auto of = [&built](const std::string& what) { return fmt::format("{} of {}", what, built.name); };
    if (!body.stretch) left_out(of("stretching"), "\"forces\" does not list it");
    if (!body.bend) left_out(of("bending"), "\"forces\" does not list it");
    if (built.idle_forces > 0) {
      left_out(of(fmt::format("{} forces", built.idle_forces)), "all their vertices are pinned or scripted");
    }
    if (built.crowded > 0) {
      left_out(of(fmt::format("bending at {} places", built.crowded)), "more than two faces or edges meet there");
    }
    if (scene_.dimension == 3 && built.edges > 0 && body.bend)
      left_out(of("bending of edges"), "curves do not bend in space");
    const auto* elastic = std::get_if<ElasticMaterial>(&body.material.kind);
    if (elastic != nullptr && elastic->width != elastic->thickness && built.edges == 0) {
      left_out(of("width"), "only curves have one");
    }
  }

 private:
  void contact() {
    const auto& all = out_.contact;
    const auto some = [&all](auto&& holds) { return std::any_of(all.begin(), all.end(), holds); };
    if (!scene_.contact) return left_out("contact forces", "the scene has no \"contact\": a contact ends the run");
    say(!all.empty(), "contact forces", "nothing can move, or all that can is excluded");
    say(some([](auto& c) { return c.material.restitution < 1; }), "restitution", "it is 1 everywhere");
    say(some([](auto& c) { return c.material.friction > 0; }), "friction", "its coefficient is 0 everywhere");
    say(scene_.contact->inclusion_exclusion, "inclusion and exclusion",
        "\"inclusion_exclusion\" is not set: each pair of features pushes for itself");
    for (const BodyPair& pair : scene_.contact->excluded) {
      left_out(fmt::format("contact of {} and {}", scene_.bodies[pair[0]].name, scene_.bodies[pair[1]].name),
               "\"exclude\" names them: they may go through each other");
    }
  }

  template <class Holds>
  bool any(Holds&& holds) const {
    return std::any_of(scene_.bodies.begin(), scene_.bodies.end(), holds);
  }
  void left_out(const std::string& what, const std::string& why) { out_.left_out.push_back({what, why}); }
  void say(bool active, const std::string& what, const std::string& why_not) { say(active, what, what, why_not); }
  void say(bool active, const std::string& description, const std::string& what, const std::string& why_not) {
    if (active) {
      out_.active.push_back(description);
    } else {
      left_out(what, why_not);
    }
  }

  const Scene& scene_;
  Explanation& out_;
};

void survey_forces(const Forces<double, 3>& forces, Survey& survey) {
  survey.forces(forces.edge_springs.forces.size(), "edge springs", "no body has edges with a stiffness that can move");
  survey.forces(forces.membranes.forces.size(), "membranes", "no sheet with a Young's modulus can move");
  survey.forces(forces.hinges.forces.size(), "hinges", "no sheet with a bending stiffness can move");
}

void survey_forces(const Forces<double, 2>& forces, Survey& survey) {
  survey.forces(forces.edge_springs.forces.size(), "edge springs", "no body has edges with a stiffness that can move");
  survey.forces(forces.turnings.forces.size(), "turning angles", "no curve with a bending stiffness can move");
}

template <int Dim>
std::string part_name(const BuiltScene<Dim>& built, const BuiltPair& pair, std::size_t side) {
  const std::string& name = built.bodies[pair.bodies[side]].name;
  const double heights = pair.heights_up_to[side];
  return std::isfinite(heights) ? fmt::format("{} (cells up to {:.3g} m)", name, heights) : name;
}

/// Describes how bodies meet.
template <int Dim>
void add_contact(const BuiltScene<Dim>& built, Explanation& e) {
  if (!built.model.contact) return;
  e.layers = built.model.contact->schedule;
  e.most_layers = built.model.contact->most_layers;
  for (std::size_t i = 0; i < built.contact.size(); ++i) {
    const BuiltContact& use = built.contact[i];
    const ContactMaterial& m = built.model.contact->materials[i];
    const double stability = m.step / std::sqrt(use.least_mass / (2 * m.stiffness));
    PredictedContact& predicted = e.contact.emplace_back(PredictedContact{{}, m, stability, use.bound});
    for (const BuiltPair& pair : use.pairs)
      predicted.pairs.push_back({part_name(built, pair, 0), part_name(built, pair, 1)});
  }
}

/// Warns of values that change nothing, and of a duration that is not a whole number of windows.
void warn_of_values(const Scene& scene, Explanation& e) {
  const double end = windows_up_to(scene.duration, scene.window) * scene.window;
  if (end > scene.duration * (1 + 1e-6)) {  // less would not show in six digits
    e.warnings.push_back(fmt::format(
        "\"duration\" {:.6g} is rounded up to {:.6g} s, because a run consists of whole windows of {:.6g} s "
        "(\"window\")",
        scene.duration, end, scene.window));
  }
  const auto warn_of_start = [&](const char* field, const Position& value, const BuiltBody& body) {
    if (value == Position{} || body.pinned + body.scripted < body.vertices) return;
    e.warnings.push_back(
        fmt::format("\"{}\" of {} has no effect: all its vertices are pinned or scripted", field, body.name));
  };
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    warn_of_start("velocity", scene.bodies[i].velocity, e.bodies[i]);
    warn_of_start("spin", scene.bodies[i].spin, e.bodies[i]);
  }
  for (std::size_t k = 0; k < scene.scripts.size(); ++k) {
    const auto* const path = std::get_if<ScriptPath>(&scene.scripts[k].motion);
    const double begin = path ? path->times.front() : std::get<ScriptFrames>(scene.scripts[k].motion).from;
    if (begin < end) continue;
    e.warnings.push_back(
        fmt::format("/scripts/{} begins at {:.6g} s, but the duration ends at {:.6g} s: the script moves nothing of {}",
                    k, begin, end, e.bodies[scene.scripts[k].body].name));
  }
}

/// `most`: the most breakpoints of a window.
void warn(const Scene& scene, std::size_t most, Explanation& e) {
  if (scene.allow_unstable)
    e.warnings.emplace_back("steps above the limit of stability are accepted (\"allow_unstable\")");
  if (e.breakpoints_a_window > most_breakpoints) {
    e.warnings.push_back(fmt::format("a window has about {:.2g} breakpoints; with \"window\" {:.2g} it has {:.2g}",
                                     e.breakpoints_a_window, scene.window * most_breakpoints / e.breakpoints_a_window,
                                     most_breakpoints));
  }
  if (e.breakpoints_a_window > static_cast<double>(most)) {
    e.warnings.push_back(fmt::format("windows end early, with {} breakpoints (\"most_breakpoints\")", most));
  }
  if (scene.contact && e.contact.empty()) {
    e.warnings.emplace_back("there are no layers of contact: nothing can move, or all that can is excluded");
  }
  for (const BuiltBody& body : e.bodies) {
    if (body.damped_steps > 1) {
      e.warnings.push_back(fmt::format("damping makes some steps of {} {:.3g} times shorter than stiffness alone would",
                                       body.name, body.damped_steps));
    }
    if (body.damping_excess > 1) {
      e.warnings.push_back(
          fmt::format("some given steps of {} are {:.3g} times too long for its damping, which may create energy then",
                      body.name, body.damping_excess));
    }
  }
  const bool clips = std::ranges::any_of(e.groups, [&](const auto& g) { return g.longest >= scene.window; });
  if (clips) e.hints.emplace_back("some steps are as long as the window and could be longer with a longer \"window\"");
}

template <int Dim>
void warn_of_pinches(const BuiltScene<Dim>& built, double duration, Explanation& e) {
  for (const Pinch& pinch : find_pinches(built, duration)) {
    e.warnings.push_back(
        fmt::format("{} and {} touch each other at about {:.6g} s: anything free between them is then squeezed to a "
                    "gap of 0, for which no number of layers is enough",
                    built.bodies[pinch.bodies[0]].name, built.bodies[pinch.bodies[1]].name, pinch.time));
  }
}

/// Warns of bodies that layers of contact push apart from the first moment.
template <int Dim>
void warn_of_start_pushes(const BuiltScene<Dim>& built, Explanation& e) {
  constexpr std::size_t most = 3;
  const std::vector<StartPush> pushes = find_start_pushes(built);
  double rest = 0;
  bool at_least = false;
  for (std::size_t i = 0; i < pushes.size(); ++i) {
    const StartPush& push = pushes[i];
    if (i >= most) {
      rest += push.energy;
      at_least |= push.at_least;
      continue;
    }
    const std::string &a = built.bodies[push.bodies[0]].name, &b = built.bodies[push.bodies[1]].name;
    e.warnings.push_back(
        fmt::format("{} begin {:.3g} m apart, inside layer {} of contact: they push each other apart with {}{:.3g} J; "
                    "layers begin at {:.3g} m (\"thickness\")",
                    a == b ? "parts of " + a : fmt::format("{} and {}", a, b), push.gap, push.layer,
                    push.at_least ? "at least " : "", push.energy, push.thickness));
  }
  if (pushes.size() <= most) return;
  const std::size_t more = pushes.size() - most;
  e.warnings.push_back(
      fmt::format("layers of contact also push the bodies of {} more pair{} apart, with {}{:.3g} J in all", more,
                  more == 1 ? "" : "s", at_least ? "at least " : "", rest));
}

/// Warns of bodies whose cells only the scene moves.
template <int Dim>
void warn_of_what_is_not_compared(const BuiltScene<Dim>& built, Explanation& e) {
  std::vector<VertexId> cells = held_cells(built.model.mesh, held_vertices(built.model));
  std::sort(cells.begin(), cells.end());
  std::vector<std::string> names;
  for (const BuiltBody& body : built.bodies) {
    const auto least = std::lower_bound(cells.begin(), cells.end(), body.first);
    if (least != cells.end() && body.has(*least)) names.push_back(body.name);
  }
  if (names.size() < 2) return;
  e.warnings.push_back(
      fmt::format("cells of {} and {} whose vertices are all scripted or pinned are not compared with each other: they "
                  "may go through each other",
                  fmt::join(names.begin(), names.end() - 1, ", "), names.back()));
}

/// Values for absent fields without a default in the schema, because the default depends on other fields.
class Derived {
 public:
  explicit Derived(std::vector<DefaultTaken>& defaults) : defaults_(defaults) {}

  void add(const Field& object, const std::string& name, const Json& value) {
    if (!object.has(name)) defaults_.push_back({object.path() + "/" + name, value});
  }
  void steps(const Field& steps) {
    add(steps, "stretch", "estimated");
    add(steps, "bend", "estimated");
  }
  /// Values for all pairs without values of their own, if they have a common value.
  void contact(const Field& at, const std::vector<PredictedContact>& ways) {
    const auto add_common = [&](const std::string& name, auto of) {
      const bool same = std::all_of(ways.begin(), ways.end(), [&](auto& way) { return of(way) == of(ways.front()); });
      if (!ways.empty()) add(at, name, same ? Json(of(ways.front())) : Json("of each pair"));
    };
    add_common("thickness", [](const PredictedContact& c) { return c.material.thickness; });
    add_common("stiffness", [](const PredictedContact& c) { return c.material.stiffness; });
    if (!at.has("step")) add(at, "stability", default_stability);
    if (!at.has("newton_restitution")) add(at, "restitution", 1);
    add(at, "friction", 0);
  }
  void body(const Body& body, const Field& at) {
    add(at, "name", body.name);
    add(at, "spin", 0);
    add(at["transform"], "rotate", "not at all");
    if (const auto* m = std::get_if<ElasticMaterial>(&body.material.kind)) add(at["material"], "width", m->width);
    add(at["material"], "bending_damping", body.material.bending_damping);
    steps(at["steps"]);
    for (const Field& patch : at["patches"].items()) steps(patch["steps"]);
  }

 private:
  std::vector<DefaultTaken>& defaults_;
};

template <int Dim>
void add_derived_defaults(const Scene& scene, const Model<double, Dim>& model, Explanation& explanation) {
  const Field root = field_of(scene);
  Derived derived(explanation.defaults);
  if (model.gravity) derived.add(root, "gravity_step", model.gravity->step);
  derived.add(root, "most_breakpoints", model.most_breakpoints);
  derived.add(root, "contact", "none");
  if (scene.contact) derived.contact(root["contact"], explanation.contact);
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) derived.body(scene.bodies[i], root["bodies"][i]);
}

template <int Dim>
void explain(const Scene& scene, Explanation& explanation) {
  BuiltScene<Dim> built = build_model<Dim>(scene);
  add_contact(built, explanation);
  warn_of_what_is_not_compared(built, explanation);
  if (built.model.contact) {
    warn_of_start_pushes(built, explanation);
    warn_of_pinches(built, scene.duration, explanation);
  }
  explanation.bodies = std::move(built.bodies);
  warn_of_values(scene, explanation);
  Survey survey(scene, explanation);
  survey_forces(built.model.forces, survey);
  survey.run();
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) survey.body(scene.bodies[i], explanation.bodies[i]);
  add_derived_defaults(scene, built.model, explanation);
  const std::size_t most = built.model.most_breakpoints;
  predict(scene, std::move(built.model), explanation);
  warn(scene, most, explanation);
}

}  // namespace

Explanation explain(const Scene& scene) {
  Explanation explanation;
  explanation.title = scene.title.empty() ? scene.path.stem().string() : scene.title;
  explanation.dimension = scene.dimension;
  explanation.defaults = scene.defaults;
  if (scene.dimension == 2) {
    explain<2>(scene, explanation);
  } else {
    explain<3>(scene, explanation);
  }
  return explanation;
}

}  // namespace noli::integrator
