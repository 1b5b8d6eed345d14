// SPDX-License-Identifier: Apache-2.0
#include "integrator/scene/read_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <noli/errors.h>
#include "integrator/scene/read_body.h"
#include "trajectory/text.h"

namespace noli::integrator {
namespace {

using Pointer = Json::json_pointer;

bool is_there(const Json& document, const Pointer& place) {
  try {
    return document.contains(place);
  } catch (const Json::exception&) {
    return false;  // an index that is too large
  }
}

/// Why a document has no such place; "" if the place is a field of an object, existing or new, or an existing item of
/// an array.
std::string lack_of(const Json& document, const Pointer& place) {
  if (is_there(document, place)) return "";
  Pointer owner = place.parent_pointer();
  std::string name = place.back();
  const bool only_last = is_there(document, owner);
  for (; !is_there(document, owner); owner.pop_back()) name = owner.back();
  const Json& there = document.at(owner);
  if (there.is_array()) {
    return fmt::format("{} has {} item{}, counted from 0", owner.to_string(), there.size(),
                       there.size() == 1 ? "" : "s");
  }
  if (!there.is_object()) return owner.to_string() + " is neither an object nor an array";
  if (only_last) return "";
  std::vector<std::string> known;
  for (const auto& item : there.items()) known.push_back(item.key());
  const std::optional<std::string> near = nearest(name, known);
  return fmt::format("there is no {}{}", (owner / name).to_string(),
                     near ? "; the nearest is " + (owner / *near).to_string() : "");
}

/// The place that a JSON pointer names. Nothing if the text is not a JSON pointer, or names the root.
std::optional<Pointer> pointer_of(const std::string& text) {
  try {
    const Pointer pointer(text);
    if (!pointer.empty()) return pointer;
  } catch (const Json::exception&) {  // the text has no slash at its beginning, or a wrong escape
  }
  return std::nullopt;
}

/// The document of the short form. Precondition: "short" is an object.
Json short_form(Json document, const std::string& file) {
  const Json overrides = document.at("short");
  for (const auto& item : overrides.items()) {
    const std::string found = Json(item.key()).dump(-1, ' ', false, Json::error_handler_t::replace);
    const std::optional<Pointer> place = pointer_of(item.key());
    if (!place) {
      throw InputError(file, "/short",
                       "expected a JSON pointer to a place in this file, such as \"/duration\" or "
                       "\"/bodies/0/mesh\", found " +
                           found);
    }
    const std::string lack = lack_of(document, *place);
    if (!lack.empty()) throw InputError(file, "/short", fmt::format("{} is not a place in this file: {}", found, lack));
    document[*place] = item.value();
  }
  return document;
}

/// Default vectors have three numbers; a scene of dimension 2 takes two of them.
void cut_default_vectors(Scene& scene) {
  for (DefaultTaken& taken : scene.defaults) {
    if (!taken.value.is_array() || taken.value.size() != 3 || !taken.value[0].is_number()) continue;
    taken.value.erase(2);
    scene.document[Pointer(taken.path)] = taken.value;
  }
}

void require_different_names(const Field& bodies, const std::vector<Body>& read) {
  for (std::size_t i = 0; i < read.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (read[i].name != read[j].name) continue;
      bodies[i]["name"].fail(
          fmt::format("expected another name than that of body {}, {}", j, Json(read[j].name).dump()));
    }
  }
}

void read_run(Scene& scene, const Field& f) {
  scene.title = f["title"].text();
  scene.about = f["about"].text();
  scene.duration = f["duration"].number();
  scene.window = f["window"].countable_time();
  if (f.has("most_breakpoints")) scene.most_breakpoints = f["most_breakpoints"].count<std::uint64_t>();
  scene.seed = f["seed"].count<std::uint64_t>();
  scene.record = f["record"].text() == "full" ? Record::full : Record::frames;
  scene.frame_rate = f["frame_rate"].number();
  scene.steps = f["steps"].text() == "grouped" ? Clocks::grouped : Clocks::own;
  scene.step_factor = f["step_factor"].number();
  scene.allow_unstable = f["allow_unstable"].flag();
  if (scene.step_factor > 1 && !scene.allow_unstable) {
    f["step_factor"].fail(
        fmt::format("expected at most 1, which is the limit of stability, or \"allow_unstable\": true, found {}",
                    scene.step_factor));
  }
  scene.gravity = f["gravity"].vector();
  if (f.has("gravity_step")) scene.gravity_step = f["gravity_step"].countable_time();
  if (scene.gravity_step > scene.window) {
    f["gravity_step"].fail(
        fmt::format("expected at most the window, {} [s], found {}", scene.window, *scene.gravity_step));
  }
}

// --- Contact ---------------------------------------------------------------------------------------------------------

void require_one_of(const Field& f, std::string_view a, std::string_view b) {
  if (f.has(a) && f.has(b)) f.fail(fmt::format("expected at most one of the fields \"{}\", \"{}\"", a, b));
}

std::optional<double> read_restitution(const Field& f) {
  require_one_of(f, "restitution", "newton_restitution");
  const std::optional<double> newton = f.number_if("newton_restitution");
  return newton ? *newton * *newton : f.number_if("restitution");
}

std::optional<double> read_stability(const Field& f, bool allow_unstable) {
  require_one_of(f, "step", "stability");
  const std::optional<double> stability = f.number_if("stability");
  if (stability > greatest_stability && !allow_unstable) {
    f["stability"].fail(
        fmt::format("expected at most {}, above which a bounce gains energy without end, or "
                    "\"allow_unstable\": true, found {}",
                    greatest_stability, *stability));
  }
  return stability;
}

ContactValues read_values(const Field& f, bool allow_unstable) {
  return {f.number_if("thickness"),          f.number_if("stiffness"), read_step(f, "step"),
          read_stability(f, allow_unstable), read_restitution(f),      f.number_if("friction")};
}

int read_quarters(const Field& f) {
  const double quarters = 4 * f.number();
  if (quarters != std::trunc(quarters)) f.fail(fmt::format("expected a multiple of 1/4, found {}", f.number()));
  return static_cast<int>(quarters);
}

LayerSchedule read_layers(const Field& f) {
  const LayerSchedule s{read_quarters(f["thickness_exponent"]), read_quarters(f["stiffness_exponent"]),
                        read_quarters(f["step_exponent"])};
  if (!s.diverges()) {
    const int least = 2 * s.thickness_quarters - 4;
    f["stiffness_exponent"].fail(
        fmt::format("expected at least {}, 2 * thickness_exponent - 1, found {}: the layers' energies, stiffness * "
                    "thickness^2, have a finite sum, so a fast impact gets through",
                    least / 4.0, s.stiffness_quarters / 4.0));
  }
  if (!s.outruns()) {
    f["step_exponent"].fail(
        fmt::format("expected more than {}, the thickness_exponent, found {}: deep layers could be passed between two "
                    "of their kicks",
                    s.thickness_quarters / 4.0, s.step_quarters / 4.0));
  }
  return s;
}

BodyPair read_pair(const Field& f, const std::vector<Body>& bodies) {
  const std::size_t a = find_body(f[0], bodies), b = find_body(f[1], bodies);
  return {std::min(a, b), std::max(a, b)};
}

ContactPair read_contact_pair(const Field& f, const Scene& scene, const SceneContact& contact) {
  const Field bodies = f["bodies"];
  const ContactPair pair{read_pair(bodies, scene.bodies), read_values(f, scene.allow_unstable)};
  if (contact.excludes(pair.bodies)) bodies.fail("expected bodies that \"exclude\" does not name");
  for (const ContactPair& other : contact.pairs) {
    if (other.bodies == pair.bodies)
      bodies.fail("expected bodies that no other pair has, found " + brief(bodies.json()));
  }
  return pair;
}

/// Reads the object `contact`, which the schema has accepted. Throws InputError: unknown bodies, pairs that occur twice
/// or are excluded, both of two fields that exclude each other, steps longer than the window or above the limit of
/// stability (unless allow_unstable), exponents with which layers cannot stop every impact.
SceneContact read_contact(const Field& f, const Scene& scene) {
  SceneContact contact{read_values(f, scene.allow_unstable),
                       read_layers(f["layers"]),
                       f["inclusion_exclusion"].flag(),
                       f["most_layers"].count(),
                       {},
                       {}};
  for (const Field& pair : f["exclude"].items()) contact.excluded.push_back(read_pair(pair, scene.bodies));
  for (const Field& pair : f["pairs"].items()) contact.pairs.push_back(read_contact_pair(pair, scene, contact));
  return contact;
}

/// Results of `--json` name their schema: "noli-verify". Throws InputError.
void refuse_results(const Json& document, const std::string& file) {
  if (!document.is_object() || !document.contains("schema") || !document["schema"].is_string()) return;
  const auto schema = document["schema"].get<std::string>();
  if (!schema.starts_with("noli-")) return;
  throw InputError(file, "", fmt::format("is a result ({}); expected a scene; `noli report` shows results", schema));
}

/// `name`: of the file and, for the short form, of its place in it.
Scene scene_of(const Json& document, const std::filesystem::path& path, const std::string& name) {
  static const Json schema = parse_json(scene_schema_text(), "schemas/scene.json");
  Validated validated = validate(schema, document, name);
  Scene scene;
  scene.path = path;
  scene.document = std::move(validated.document);
  scene.defaults = std::move(validated.defaults);
  const Field f(scene.document, name);
  scene.dimension = f.dimension();
  if (scene.dimension == 2) cut_default_vectors(scene);
  read_run(scene, f);
  for (const Field& body : f["bodies"].items()) scene.bodies.push_back(read_body(body, scene.bodies.size()));
  require_different_names(f["bodies"], scene.bodies);
  for (const Field& script : f["scripts"].items()) scene.scripts.push_back(read_script(script, scene.bodies));
  if (f.has("contact")) scene.contact = read_contact(f["contact"], scene);
  return scene;
}

}  // namespace

Scene parse_scene(std::string_view text, const std::filesystem::path& path, Form form) {
  const Json document = parse_json(text, path.string());
  refuse_results(document, path.string());
  Scene full = scene_of(document, path, path.string());
  if (!has_short_form(full)) return full;
  Scene brief = scene_of(short_form(document, path.string()), path, path.string() + ": /short");
  return form == Form::brief ? brief : full;
}

Scene read_scene(const std::filesystem::path& path, Form form) {
  return parse_scene(read_whole_file(path), path, form);
}

std::vector<std::filesystem::path> files_of(const Scene& scene) {
  const std::filesystem::path folder = scene.path.parent_path();
  std::vector<std::filesystem::path> files;
  for (const Body& body : scene.bodies) {
    if (const auto* const mesh = std::get_if<MeshFile>(&body.mesh)) files.push_back(folder / mesh->path);
  }
  for (const ScriptedVertices& script : scene.scripts) {
    const auto* const frames = std::get_if<ScriptFrames>(&script.motion);
    if (frames == nullptr) continue;
    for (const std::string& file : frames->files) files.push_back(folder / file);
  }
  return files;
}

}  // namespace noli::integrator
