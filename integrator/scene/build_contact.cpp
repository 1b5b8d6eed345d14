// SPDX-License-Identifier: Apache-2.0
#include "integrator/scene/build_contact.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "integrator/scene/shapes/curve.h"
#include "trajectory/stop.h"

namespace noli::integrator {
namespace {

constexpr std::size_t most_bodies = 4096;  ///< limits the table of their pairs
constexpr std::size_t most_classes = 16;
constexpr double infinity = std::numeric_limits<double>::infinity();

double least_height(const std::vector<Position>& rest, const std::array<VertexId, 2>& edge) {
  return length(to_vec(rest[edge[1]]) - to_vec(rest[edge[0]]));
}

/// The least height of a triangle: twice its area over its longest edge.
double least_height(const std::vector<Position>& rest, const std::array<VertexId, 3>& face) {
  const Vec3 a = to_vec(rest[face[1]]) - to_vec(rest[face[0]]), b = to_vec(rest[face[2]]) - to_vec(rest[face[0]]);
  return length(cross(a, b)) / std::max({length(a), length(b), length(b - a)});
}

/// The properties of a body's free part that matter for contact.
struct Free {
  double height = infinity;  ///< H of its cells
  double least_mass = infinity, greatest_mass = 0;

  bool any() const { return greatest_mass > 0; }
  friend Free operator|(const Free& a, const Free& b) {
    return {std::min(a.height, b.height), std::min(a.least_mass, b.least_mass),
            std::max(a.greatest_mass, b.greatest_mass)};
  }
};

/// A body's classes: the class of each vertex, and the properties of each class and of all.
struct Parts {
  std::vector<std::uint8_t> classes;
  std::vector<Free> of_class;
  Free all;
  double greatest_height = 0;

  /// Heights of the class are at most this; infinity if there is only one class.
  double bound_of(std::size_t c) const {
    return of_class.size() == 1 ? infinity : std::ldexp(greatest_height, -static_cast<int>(c));
  }
};

/// For each vertex, the least height at rest of its cells; infinity if it has none.
std::vector<double> heights_of(const BodyMesh& body) {
  std::vector<double> heights(body.mass.size(), infinity);
  const auto look = [&](const auto& cells) {
    for (const auto& cell : cells) {
      end_if_stopped();
      for (const VertexId i : cell) heights[i] = std::min(heights[i], least_height(body.rest, cell));
    }
  };
  look(body.shape.mesh.faces);
  look(body.shape.mesh.edges);
  return heights;
}

std::uint8_t class_of(double height, double greatest_height) {
  std::uint8_t result = 0;
  while (result + 1U < most_classes && height <= std::ldexp(greatest_height, -result - 1)) ++result;
  return result;
}

Parts classify(const BodyMesh& body) {
  Parts parts;
  const std::vector<double> heights = heights_of(body);
  for (const double height : heights) {
    if (std::isfinite(height)) parts.greatest_height = std::max(parts.greatest_height, height);
  }
  std::uint8_t last = 0;
  for (const double height : heights) {
    parts.classes.push_back(class_of(height, parts.greatest_height));
    last = std::max(last, parts.classes.back());
  }
  parts.of_class.resize(last + std::size_t{1});
  return parts;
}

/// Computes a body's classes. A cell with a free vertex counts for the classes of all its vertices, as their features
/// are parts of it. A feature of a class may have vertices of all earlier classes.
Parts parts_of(const BodyMesh& body, const BuiltBody& built, const std::vector<double>& inverse_mass) {
  const auto is_free = [&](VertexId i) { return inverse_mass[built.first + i] != 0; };
  bool any_free = false;
  for (VertexId i = 0; i < body.mass.size(); ++i) any_free |= is_free(i);
  // A body without free vertices is one class.
  Parts parts = any_free ? classify(body) : Parts{std::vector<std::uint8_t>(body.mass.size(), 0), {{}}, {}, 0};
  const auto add = [&](VertexId of, const Free& part) {
    Free& all = parts.of_class[parts.classes[of]];
    all = all | part;
    parts.all = parts.all | part;
  };
  const auto look = [&](const auto& cells) {
    for (const auto& cell : cells) {
      end_if_stopped();
      if (std::none_of(cell.begin(), cell.end(), is_free)) continue;
      for (const VertexId i : cell) add(i, Free{least_height(body.rest, cell), infinity, 0});
    }
  };
  look(body.shape.mesh.faces);
  look(body.shape.mesh.edges);
  for (VertexId i = 0; i < body.mass.size(); ++i) {
    if (is_free(i)) add(i, Free{infinity, body.mass[i], body.mass[i]});
  }
  for (std::size_t c = 0; c < parts.of_class.size(); ++c) {
    Free& part = parts.of_class[c];
    if (!part.any()) part = parts.all;
    if (c > 0) part.height = std::min(part.height, parts.of_class[c - 1].height);
  }
  return parts;
}

template <int Dim>
double greatest_speed(const Script<double, Dim>& script) {
  double greatest = 0;
  for (std::size_t k = 1; k < script.times.size(); ++k) {
    const Vec<double, Dim> move = script.positions[k] - script.positions[k - 1];
    greatest = std::max(greatest, std::sqrt(move.squaredNorm()) / (script.times[k] - script.times[k - 1]));
  }
  return greatest;
}

/// The speed of a fall from top to bottom.
template <int Dim>
double falling_speed(const Model<double, Dim>& model) {
  if (!model.gravity) return 0;
  double least = infinity, greatest = -infinity;
  for (const Vec<double, Dim>& x : model.x) {
    const double height = model.gravity->acceleration.dot(x);
    least = std::min(least, height);
    greatest = std::max(greatest, height);
  }
  return std::sqrt(2 * (greatest - least));
}

/// v, without its lower bound eta(1) / window.
struct MeetingSpeed {
  double start = 0, scripts = 0, fall = 0;

  double sum() const { return start + scripts + fall; }

  /// The greatest part, for messages.
  const char* origin() const {
    if (start >= scripts && start >= fall) return "the greatest speed at the start";
    return scripts >= fall ? "the greatest speed of a script"
                           : "the speed of a fall from the highest to the lowest vertex";
  }
};

template <int Dim>
MeetingSpeed meeting_speed(const Model<double, Dim>& model) {
  MeetingSpeed speed;
  for (const Vec<double, Dim>& v : model.v) speed.start = std::max(speed.start, std::sqrt(v.squaredNorm()));
  for (const auto& script : model.scripts) speed.scripts = std::max(speed.scripts, greatest_speed(script));
  speed.fall = falling_speed(model);
  return speed;
}

/// The contact of one pair of bodies: values for the pair, or for all pairs, or defaults.
class PairContact {
 public:
  PairContact(const Scene& scene, const BodyPair& bodies, const Free& part, const MeetingSpeed& speed)
      : scene_(scene), part_(part), speed_(speed.sum()), speed_origin_(speed.origin()) {
    const std::vector<ContactPair>& pairs = scene.contact->pairs;
    const auto found = std::ranges::find(pairs, bodies, &ContactPair::bodies);
    if (found == pairs.end()) return;
    pair_ = &*found;
    index_ = static_cast<std::size_t>(found - pairs.begin());
  }

  ContactMaterial material() const {
    ContactMaterial m;
    m.thickness = thickness();
    m.stiffness = value(&ContactValues::stiffness).value_or(default_stiffness(m.thickness));
    if (!(m.stiffness > 0 && std::isfinite(m.stiffness))) {
      at("stiffness")
          .fail(fmt::format("no stiffness is given, and its default, {} [N/m], cannot be used: it is {}; expected a {} "
                            "speed or mass, or a stiffness",
                            m.stiffness, origin_of_stiffness(m), m.stiffness == 0 ? "greater" : "lower"));
    }
    m.step = step(m);
    m.restitution = value(&ContactValues::restitution).value_or(1);
    m.friction = value(&ContactValues::friction).value_or(0);
    return m;
  }

  double bound() const { return part_.height / 2; }

  /// Where the scene gives the thickness: 0 for all pairs, 1 + k in pair k.
  std::optional<std::size_t> said_thickness() const {
    if (pair_ != nullptr && pair_->values.thickness) return 1 + index_;
    return scene_.contact->values.thickness ? std::optional<std::size_t>(0) : std::nullopt;
  }

 private:
  using Value = std::optional<double> ContactValues::*;

  std::optional<double> value(Value which) const {
    return pair_ != nullptr && pair_->values.*which ? pair_->values.*which : scene_.contact->values.*which;
  }

  /// The field that gives a value, for the pair or for all.
  Field at(std::string_view name) const {
    const Field contact = field_of(scene_)["contact"];
    if (pair_ != nullptr && contact["pairs"][index_].has(name)) return contact["pairs"][index_][name];
    return contact[name];
  }

  double thickness() const {
    const std::optional<double> given = value(&ContactValues::thickness);
    if (!given && !(std::isfinite(bound()) && bound() > 0)) {
      at("thickness").fail("expected a thickness, as no cell with a free vertex has a height to take it from");
    }
    return given.value_or(bound() / 2);
  }

  double default_stiffness(double thickness) const {
    const double rate = std::max(speed_ / thickness, 1 / scene_.window);
    return part_.greatest_mass * rate * rate;
  }

  /// How a default stiffness is computed, for messages.
  std::string origin_of_stiffness(const ContactMaterial& m) const {
    constexpr double fastest = 1e154;  // the square of a greater speed is infinite
    const bool by_speed = !(speed_ / m.thickness <= 1 / scene_.window), beyond = !(speed_ <= fastest);
    const double speed = beyond ? fastest : speed_;
    const std::string time = by_speed ? fmt::format("to cross a thickness of {:.6g} m at {}{:.6g} m/s, {}", m.thickness,
                                                    beyond ? "more than " : "", speed, speed_origin_)
                                      : "of a window";
    return fmt::format("the greatest mass of a vertex, {:.6g} kg, over the square of the time, {:.6g} s, {}",
                       part_.greatest_mass, by_speed ? m.thickness / speed : scene_.window, time);
  }

  /// Explains a default stiffness, for messages.
  std::string stiffness_text(const ContactMaterial& m) const {
    if (value(&ContactValues::stiffness)) return "";
    return fmt::format("; no stiffness is given, and its default, {:.6g} [N/m], is {}", m.stiffness,
                       origin_of_stiffness(m));
  }

  double step(const ContactMaterial& m) const {
    const double limit = std::sqrt(part_.least_mass / (2 * m.stiffness));
    const double stability = said_of_step().stability.value_or(default_stability);
    const double step = said_of_step().step.value_or(std::min(stability * limit, scene_.window));
    if (!(step * 0x1p50 > scene_.duration)) {
      at("stiffness")
          .fail(fmt::format("expected a step of contact that can be counted over the duration, found {} [s]: too "
                            "stiff, or too light{}",
                            step, stiffness_text(m)));
    }
    if (step > greatest_stability * limit && !scene_.allow_unstable) {
      at("step").fail(
          fmt::format("expected at most {} [s], above which a bounce gains energy without end, or "
                      "\"allow_unstable\": true, found {}",
                      greatest_stability * limit, step));
    }
    return step;
  }

  /// A step or a stability of the pair replaces both general values.
  const ContactValues& said_of_step() const {
    const bool own = pair_ != nullptr && (pair_->values.step || pair_->values.stability);
    return own ? pair_->values : scene_.contact->values;
  }

  const Scene& scene_;
  const ContactPair* pair_ = nullptr;
  std::size_t index_ = 0;
  Free part_;
  double speed_;
  const char* speed_origin_;
};

/// Gives pairs their materials, and stores each different material once.
template <int Dim>
class Materials {
 public:
  Materials(const Scene& scene, BuiltScene<Dim>& built)
      : scene_(scene), built_(built), speed_(meeting_speed(built.model)) {
    const std::size_t pairs = built.bodies.size() * built.bodies.size(), classes = settings().class_count;
    settings().group_count = static_cast<std::uint16_t>(built.bodies.size());
    settings().material_of.assign(pairs * classes * classes, ContactSettings::excluded);
  }

  void add(const BodyPair& pair, const Parts& first, const Parts& second) {
    for_each_way(pair, first, second, [&](std::size_t a, std::size_t b, const Free& part) {
      const PairContact contact(scene_, pair, part, speed_);
      const std::uint16_t id = find(contact.material());
      BuiltContact& use = built_.contact[id];
      use.least_mass = std::min(use.least_mass, part.least_mass);
      use.bound = std::min(use.bound, contact.bound());
      use.pairs.push_back({pair, {first.bound_of(a), second.bound_of(b)}});
      const auto [g, h] = pair;
      for (const std::size_t place : {settings().place(g, h, a, b), settings().place(h, g, b, a)}) {
        settings().material_of[place] = id;
      }
    });
  }

  /// Notes the bound that the pair sets for a given thickness, which may apply to many pairs.
  void bound(const BodyPair& pair, const Parts& first, const Parts& second) {
    for_each_way(pair, first, second, [&](std::size_t, std::size_t, const Free& part) {
      const PairContact contact(scene_, pair, part, speed_);
      const std::optional<std::size_t> place = contact.said_thickness();
      if (!place) return;
      const auto [bound, is_new] = bounds_.insert({*place, {contact.bound(), pair}});
      if (contact.bound() < bound->second.below) bound->second = {contact.bound(), pair};
    });
  }

  /// Refuses a thickness that is too great for any of its pairs.
  void require_bounds() const {
    for (const auto& [place, bound] : bounds_) {
      const Field at = place == 0 ? contact_field() : contact_field()["pairs"][place - 1];
      const double thickness = at["thickness"].number();
      if (thickness < bound.below) continue;
      const std::string &a = scene_.bodies[bound.bodies[0]].name, &b = scene_.bodies[bound.bodies[1]].name;
      at["thickness"].fail(fmt::format(
          "expected less than {} [m], half the least height at rest of the cells with a free vertex of {}, found {}; "
          "the largest that works is {}",
          bound.below, a == b ? a : fmt::format("{} and {}", a, b), thickness, std::nextafter(bound.below, 0.0)));
    }
  }

 private:
  struct Bound {
    double below;
    BodyPair bodies;
  };

  /// Calls each(a, b, properties) for all pairs of classes of two bodies: class a of one and class b of the other.
  template <class Each>
  void for_each_way(const BodyPair& pair, const Parts& first, const Parts& second, const Each& each) const {
    if (!(first.all | second.all).any() || scene_.contact->excludes(pair)) return;
    for (std::size_t a = 0; a < first.of_class.size(); ++a) {
      for (std::size_t b = pair[0] == pair[1] ? a : 0; b < second.of_class.size(); ++b) {
        const Free &p = first.of_class[a], &q = second.of_class[b];
        Free part = p | q;
        // Classes after the first bound the mass by their own mass, so the lighter one decides.
        if (a > 0 && p.any()) part.greatest_mass = std::min(part.greatest_mass, p.greatest_mass);
        if (b > 0 && q.any()) part.greatest_mass = std::min(part.greatest_mass, q.greatest_mass);
        each(a, b, part);
      }
    }
  }

  ContactSettings& settings() { return *built_.model.contact; }

  std::uint16_t find(const ContactMaterial& material) {
    std::vector<ContactMaterial>& list = settings().materials;
    const auto found = std::find(list.begin(), list.end(), material);
    if (found != list.end()) return static_cast<std::uint16_t>(found - list.begin());
    if (list.size() == ContactSettings::excluded)
      contact_field().fail("expected at most 65535 different sets of values; give more pairs the same values");
    list.push_back(material);
    built_.contact.push_back({infinity, infinity, {}});
    return static_cast<std::uint16_t>(list.size() - 1);
  }

  Field contact_field() const { return field_of(scene_)["contact"]; }

  const Scene& scene_;
  BuiltScene<Dim>& built_;
  MeetingSpeed speed_;
  std::map<std::size_t, Bound> bounds_;  ///< by said_thickness()
};

void add_classes(const std::vector<Parts>& parts, ContactSettings& settings) {
  for (const Parts& p : parts) {
    settings.class_count = std::max(settings.class_count, static_cast<std::uint16_t>(p.of_class.size()));
  }
  if (settings.class_count == 1) return;
  for (const Parts& p : parts) settings.classes.insert(settings.classes.end(), p.classes.begin(), p.classes.end());
}

/// Requires that lengths of contact have enough digits and range. 64 times the distance that certificates keep clear
/// for recorded positions (certificates/decisions.h) must be less than any layer. Closest points need products of four
/// lengths (certificates/closest.h). These must stay within the range of double, with some room for bodies that move
/// away and for layers thinner than the first.
template <int Dim>
void require_numbers(const Scene& scene, const Model<double, Dim>& model) {
  constexpr double part = 0x1p-38, least = 1e-70, greatest = 1e70;
  double farthest = 0, thinnest = infinity;
  for (const auto& x : model.x) farthest = std::max(farthest, x.cwiseAbs().maxCoeff());
  for (const ContactMaterial& m : model.contact->materials) thinnest = std::min(thinnest, m.thickness);
  const Field at = field_of(scene)["contact"]["thickness"];
  if (!(part * farthest < thinnest)) {
    at.fail(
        fmt::format("expected more than {:.3g} where coordinates are as large as {:.3g}, found {:.3g}: smaller "
                    "distances are lost in their rounding",
                    part * farthest, farthest, thinnest));
  }
  if (!(thinnest >= least && farthest <= greatest)) {
    at.fail(
        fmt::format("expected at least {:g} [m], and coordinates of at most {:g}, found {:.3g} and {:.3g}: contact "
                    "needs the fourth powers of lengths, which must stay in the range of double",
                    least, greatest, thinnest, farthest));
  }
}

}  // namespace

template <int Dim>
void add_contact(const Scene& scene, const std::vector<BodyMesh>& bodies, const std::vector<double>& inverse_mass,
                 BuiltScene<Dim>& built) {
  if (!scene.contact) return;
  if (bodies.size() > most_bodies) {
    field_of(scene)["bodies"].fail(
        fmt::format("expected at most {} bodies in a scene with contact, found {}", most_bodies, bodies.size()));
  }
  ContactSettings& settings = built.model.contact.emplace();
  settings.schedule = scene.contact->layers;
  settings.most_layers = scene.contact->most_layers;
  settings.inclusion_exclusion = scene.contact->inclusion_exclusion;
  std::vector<Parts> parts;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    settings.groups.insert(settings.groups.end(), built.bodies[b].vertices, static_cast<std::uint16_t>(b));
    parts.push_back(parts_of(bodies[b], built.bodies[b], inverse_mass));
  }
  add_classes(parts, settings);
  Materials<Dim> materials(scene, built);
  const auto for_each_pair = [&](auto&& each) {
    for (std::size_t a = 0; a < bodies.size(); ++a) {
      for (std::size_t b = a; b < bodies.size(); ++b) each(BodyPair{a, b}, parts[a], parts[b]);
    }
  };
  for_each_pair([&](const auto&... pair) { materials.bound(pair...); });
  materials.require_bounds();
  for_each_pair([&](const auto&... pair) { materials.add(pair...); });
  require_numbers(scene, built.model);
}

template void add_contact(const Scene&, const std::vector<BodyMesh>&, const std::vector<double>&, BuiltScene<2>&);
template void add_contact(const Scene&, const std::vector<BodyMesh>&, const std::vector<double>&, BuiltScene<3>&);

}  // namespace noli::integrator
