// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "integrator/scene/explain.h"

namespace noli::integrator {
namespace {

std::string step_text(const PredictedGroup& group) {
  if (group.shortest == group.longest) return fmt::format("{:.6g} s", group.shortest);
  return fmt::format("{:.6g} to {:.6g} s", group.shortest, group.longest);
}

std::string resonance_text(const ResonanceWarning& w) {
  return fmt::format(
      "{} with step {:.6g} s resonates with the oscillation of {} with step {:.6g} s at {} vertices; most at vertex "
      "{}: phase {:.3g} a step, strength {:.3g}. Damping, or a smaller \"step_factor\", helps",
      name(w.slow_kind), w.slow_step, name(w.fast_kind), w.fast_step, w.vertices, w.vertex, w.meeting.phase,
      w.meeting.strength);
}

Json resonance_json(const ResonanceWarning& w) {
  return {{"slow", name(w.slow_kind)}, {"slow_step", w.slow_step},      {"fast", name(w.fast_kind)},
          {"fast_step", w.fast_step},  {"vertices", w.vertices},        {"vertex", w.vertex},
          {"phase", w.meeting.phase},  {"strength", w.meeting.strength}};
}

Json group_json(const PredictedGroup& g) {
  return {{"force", name(g.kind)},
          {"forces", g.forces},
          {"shortest_step", g.shortest},
          {"longest_step", g.longest},
          {"events_per_second", g.events}};
}

Json contact_json(const PredictedContact& c) {
  return {{"pairs", c.pairs},
          {"thickness", c.material.thickness},
          {"thickness_below", c.bound},
          {"stiffness", c.material.stiffness},
          {"step", c.material.step},
          {"stability", c.stability},
          {"restitution", c.material.restitution},
          {"friction", c.material.friction}};
}

Json layers_json(const Explanation& e) {
  return {{"thickness_exponent", e.layers.thickness_quarters / 4.0},
          {"stiffness_exponent", e.layers.stiffness_quarters / 4.0},
          {"step_exponent", e.layers.step_quarters / 4.0},
          {"most_layers", e.most_layers}};
}

std::string pairs_text(const PredictedContact& c) {
  constexpr std::size_t most = 6;
  std::string text;
  for (std::size_t i = 0; i < std::min(most, c.pairs.size()); ++i) {
    const auto& [a, b] = c.pairs[i];
    text += fmt::format("{}{} with {}", i == 0 ? "" : ", ", a, a == b ? "itself" : b);
  }
  if (c.pairs.size() > most) text += fmt::format(", and {} more pairs", c.pairs.size() - most);
  return text;
}

Json body_json(const BuiltBody& b) {
  return {{"name", b.name},     {"first_vertex", b.first}, {"vertices", b.vertices},
          {"faces", b.faces},   {"edges", b.edges},        {"mass", b.mass},
          {"pinned", b.pinned}, {"scripted", b.scripted},  {"idle_forces", b.idle_forces}};
}

class Text {
 public:
  template <class... Args>
  void line(fmt::format_string<Args...> format, Args&&... args) {
    text += on_one_line(fmt::format(format, std::forward<Args>(args)...)) + "\n";
  }
  std::string text;
};

void write_bodies(Text& out, const Explanation& e) {
  out.line("Bodies:");
  for (const BuiltBody& b : e.bodies) {
    out.line("  {}: {} vertices from {}, {} faces, {} edges of no face, {:.6g} kg, {} pinned, {} scripted", b.name,
             b.vertices, b.first, b.faces, b.edges, b.mass, b.pinned, b.scripted);
  }
}

void write_activity(Text& out, const Explanation& e) {
  out.line("Active:");
  for (const std::string& what : e.active) out.line("  {}", what);
  out.line("Left out:");
  for (const LeftOut& l : e.left_out) out.line("  {}: {}", l.what, l.why);
}

void write_contact(Text& out, const Explanation& e) {
  if (e.contact.empty()) return;
  out.line("Contact: layer l has thickness * l^-{}, stiffness * l^{}, step * l^-{}; a pair has at most {} layers",
           e.layers.thickness_quarters / 4.0, e.layers.stiffness_quarters / 4.0, e.layers.step_quarters / 4.0,
           e.most_layers);
  for (const PredictedContact& c : e.contact) {
    const std::string bound = std::isfinite(c.bound) ? fmt::format(" (below {:.6g})", c.bound) : "";
    out.line(
        "  {}: thickness {:.6g} m{}, stiffness {:.6g} N/m, step {:.6g} s (stability {:.3g}), "
        "restitution {} of the energy, friction {}",
        pairs_text(c), c.material.thickness, bound, c.material.stiffness, c.material.step, c.stability,
        c.material.restitution, c.material.friction);
  }
}

void write_predictions(Text& out, const Explanation& e) {
  out.line("Predicted steps:");
  for (const PredictedGroup& g : e.groups) {
    out.line("  {} {}: {}, {:.3g} events a second", g.forces, name(g.kind), step_text(g), g.events);
  }
  out.line("Predicted for each second of simulated time: {:.3g} events, {:.3g} breakpoints, {:.3g} bytes", e.events,
           e.breakpoints, e.bytes);
  out.line("Predicted for the run: {:.0f} windows of about {:.3g} breakpoints, {:.3g} bytes without proofs", e.windows,
           e.breakpoints_a_window, e.bytes_in_all);
}

void write_defaults(Text& out, const Explanation& e) {
  out.line("Defaults taken:");
  for (const DefaultTaken& d : e.defaults) out.line("  {} = {}", d.path, d.value.dump());
}

}  // namespace

std::vector<std::string> notes(const Explanation& e) {
  std::vector<std::string> all = e.warnings;
  for (const ResonanceWarning& w : e.resonances) all.push_back(resonance_text(w));
  return all;
}

std::string to_text(const Explanation& e) {
  Text out;
  out.line("{} (dimension {})", e.title, e.dimension);
  write_bodies(out, e);
  write_activity(out, e);
  write_contact(out, e);
  write_predictions(out, e);
  for (const ResonanceWarning& w : e.resonances) out.line("Resonance: {}.", resonance_text(w));
  if (e.resonances.empty()) out.line("Resonance: none found.");
  for (const std::string& warning : e.warnings) out.line("Note: {}.", warning);
  for (const std::string& hint : e.hints) out.line("Hint: {}.", hint);
  write_defaults(out, e);
  return out.text;
}

Json to_json(const Explanation& e) {
  Json document = {{"title", e.title}, {"dimension", e.dimension}};
  Json& bodies = document["bodies"] = Json::array();
  for (const BuiltBody& b : e.bodies) bodies.push_back(body_json(b));
  document["active"] = e.active;
  Json& left_out = document["left_out"] = Json::array();
  for (const LeftOut& l : e.left_out) left_out.push_back({{"what", l.what}, {"why", l.why}});
  Json& groups = document["groups"] = Json::array();
  for (const PredictedGroup& g : e.groups) groups.push_back(group_json(g));
  Json& contact = document["contact"] = Json::array();
  for (const PredictedContact& c : e.contact) contact.push_back(contact_json(c));
  if (!e.contact.empty()) document["layers"] = layers_json(e);
  document["windows"] = e.windows;
  document["events_per_second"] = e.events;
  document["breakpoints_per_second"] = e.breakpoints;
  document["breakpoints_per_window"] = e.breakpoints_a_window;
  document["bytes_per_second"] = e.bytes;
  document["bytes"] = e.bytes_in_all;
  Json& resonances = document["resonances"] = Json::array();
  for (const ResonanceWarning& w : e.resonances) resonances.push_back(resonance_json(w));
  document["warnings"] = e.warnings;
  document["hints"] = e.hints;
  Json& defaults = document["defaults"] = Json::object();
  for (const DefaultTaken& d : e.defaults) defaults[d.path] = d.value;
  return document;
}

}  // namespace noli::integrator
