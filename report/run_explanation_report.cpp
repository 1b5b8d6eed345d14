// SPDX-License-Identifier: Apache-2.0
#include "report/run_explanation_report.h"

#include <fmt/format.h>

#include <noli/errors.h>
#include "certify/contact_report.h"

namespace noli::report {
namespace {

using integrator::ForceKind;

std::span<const VertexId> vertices_of(const ActingLayer& action) {
  return {action.vertices.data(), point_count(action.pair)};
}

std::string names_of(const RunExplanation& e, const ActingLayer& action) {
  return e.log.names.pair(action.pair, vertices_of(action), "and");
}

// --- JSON ------------------------------------------------------------------------------------------------------------

Json moment_json(const RunExplanation& e, const std::optional<ActingMoment>& moment) {
  if (!moment) return nullptr;
  const ActingLayer& action = moment->action;
  const auto vertices = vertices_of(action);
  return {{"layer", action.layer},
          {"distance", action.distance},
          {"time", action.time},
          {"window", moment->window},
          {"pair", noli::name(action.pair)},
          {"vertices", std::vector<VertexId>(vertices.begin(), vertices.end())},
          {"names", names_of(e, action)},
          {"material", action.material}};
}

Json gap_json(const std::optional<ExactGap>& gap) {
  if (!gap) return nullptr;
  return {{"above", gap->above}, {"up_to", gap->up_to}, {"time", gap->time}};
}

Json works_json(const EnergySummary& energy) {
  Json kinds = Json::object(), materials = Json::array();
  for (std::size_t k = 0; k < energy.kinds.size(); ++k) {
    const ForceWork& work = energy.kinds[k];
    kinds[std::string(name(static_cast<ForceKind>(k)))] = {
        {"potential", work.potential}, {"damping", work.damping}, {"held", work.held}};
  }
  for (const ContactWork& work : energy.materials) {
    materials.push_back(
        {{"potential", work.potential}, {"friction", work.friction}, {"restitution", work.restitution}});
  }
  return {{"kinds", kinds}, {"materials", materials}, {"scripts", energy.scripts}};
}

Json energy_json(const std::optional<EnergySummary>& energy) {
  if (!energy) return nullptr;
  return {{"begin", energy->begin},
          {"first", energy->first},
          {"last", energy->last},
          {"least", energy->least},
          {"greatest", energy->greatest},
          {"damping_work", energy->damping_work},
          {"restitution_work", energy->restitution_work},
          {"held_work", energy->held_work},
          {"integration", energy->integration},
          {"work", works_json(*energy)}};
}

Json layer_cap_json(const RunExplanation& e) {
  if (!e.log.has_contact) return nullptr;
  Json worst = Json::array();
  for (const ActingMoment& m : e.worst) {
    worst.push_back({{"window", m.window}, {"layer", m.action.layer}, {"time", m.action.time}});
  }
  return {{"most_layers", e.log.most_layers}, {"worst", worst}};
}

Json kinds_json(const RunExplanation& e, double time) {
  Json json = Json::object();
  for (std::size_t k = 0; k < e.events.size(); ++k) {
    const std::string kind(name(static_cast<ForceKind>(k)));
    json[kind] = time == 0 ? Json(e.events[k]) : Json(rate(static_cast<double>(e.events[k]), time));
  }
  return json;
}

// --- Text ------------------------------------------------------------------------------------------------------------

std::string events_text(const RunExplanation& e) {
  std::string text = "Events:\n";
  for (std::size_t k = 0; k < e.events.size(); ++k) {
    if (e.events[k] == 0) continue;
    text += fmt::format("  {:<12} {:>14} {:>12.4g} a second of simulated time\n", name(static_cast<ForceKind>(k)),
                        e.events[k], rate(static_cast<double>(e.events[k]), e.time));
  }
  text += fmt::format("  {:<12} {:>14} {:>12.4g}\n", "breakpoints", e.breakpoints,
                      rate(static_cast<double>(e.breakpoints), e.time));
  return text;
}

std::string gap_text(const RunExplanation& e) {
  if (!e.gap) return "World lines were not recorded, so how near they came between impulses is not known exactly.";
  return fmt::format("Between impulses too, decided exactly: above {} m, up to {} m, first at about {} s.",
                     digits17(e.gap->above), digits17(e.gap->up_to), digits17(e.gap->time));
}

std::string contact_text(const RunExplanation& e) {
  if (!e.log.has_contact && !e.deepest) return "Contact: the scene has no contact forces.\n";
  if (!e.deepest) return "Contact: no layer acted.\n";
  const ActingMoment &deep = *e.deepest, &near = *e.nearest;
  std::string text = fmt::format("Deepest layer that acted: {}, between {}, at {} s (window {}).\n", deep.action.layer,
                                 on_one_line(names_of(e, deep.action)), digits17(deep.action.time), deep.window);
  text += fmt::format("Nearest at an impulse: {}, {} m apart, at {} s (window {}).\n  {}\n",
                      on_one_line(names_of(e, near.action)), digits17(near.action.distance), digits17(near.action.time),
                      near.window, gap_text(e));
  return text;
}

std::string bound_text(const RunExplanation& e) {
  if (!e.log.has_contact) return "";
  if (const auto bound = e.bound()) {
    return fmt::format(
        "Certificates had at most {} layers active for a pair: no pair was nearer than the next, at least {} m "
        "thick.\n",
        e.log.deepest, digits17(*bound));
  }
  return "The log does not cover all windows, so it is not known how many layers were active.\n";
}

std::string cap_text(const RunExplanation& e) {
  if (e.worst.empty() || e.log.most_layers == 0) return "";
  std::string text = fmt::format("The scene allows {} layers; the deepest acted in:\n", e.log.most_layers);
  for (const ActingMoment& m : e.worst) {
    text += fmt::format("  window {}: layer {} ({:.2g} %)\n", m.window, m.action.layer,
                        100 * static_cast<double>(m.action.layer) / e.log.most_layers);
  }
  return text;
}

std::string roll_backs_text(const RunExplanation& e) {
  if (e.log.roll_backs.empty()) return "No window was rolled back.\n";
  std::string text = fmt::format("Rolled back: {} time(s); steps of layers are halved {} time(s) now.\n",
                                 e.log.roll_backs.size(), e.halvings);
  for (const Json& entry : e.log.roll_backs)
    text += "  " + entry.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
  return text;
}

std::string kinds_of_work_text(const EnergySummary& energy) {
  std::string text;
  for (std::size_t k = 0; k < energy.kinds.size(); ++k) {
    const ForceWork& work = energy.kinds[k];
    if (work.potential == 0 && work.damping == 0 && work.held == 0) continue;
    const auto kind = static_cast<ForceKind>(k);
    text += fmt::format("  {:<12} {:>10.3g} J of its potential, {:>10.3g} J of {}", name(kind), work.potential,
                        work.damping, kind == ForceKind::contact ? "friction" : "damping");
    if (kind == ForceKind::contact) text += fmt::format(", {:>10.3g} J of restitution", energy.restitution_work);
    text += work.held != 0 ? fmt::format(", {:>10.3g} J of scripts against it\n", work.held) : "\n";
  }
  return text;
}

/// " (a and b, a and c)", or nothing.
std::string meetings_text(const LogFacts& log, std::size_t material) {
  if (material >= log.meetings.size() || log.meetings[material].pairs.empty()) return "";
  std::string text;
  for (const auto& [a, b] : log.meetings[material].pairs) {
    const auto name = [&](std::uint64_t body) { return on_one_line(log.names.bodies()[body].name); };
    text += fmt::format("{}{} and {}", text.empty() ? " (" : ", ", name(a), name(b));
  }
  const std::uint64_t more = log.meetings[material].more;
  return text + (more > 0 ? fmt::format(", and {} more pairs)", more) : ")");
}

constexpr std::size_t most_told = 16;  ///< materials, and scripts; JSON has all

std::string and_more(std::size_t count, const char* what) {
  return count > most_told ? fmt::format("  and {} more {}\n", count - most_told, what) : "";
}

/// By material of contact, where there are several.
std::string work_of_materials_text(const RunExplanation& e) {
  const std::vector<ContactWork>& materials = e.energy->materials;
  if (materials.size() < 2) return "";
  std::string text;
  for (std::size_t m = 0; m < std::min(materials.size(), most_told); ++m) {
    const ContactWork& work = materials[m];
    text += fmt::format("  material {}{}: {:.3g} J of its potential, {:.3g} J of friction, {:.3g} J of restitution\n",
                        m, meetings_text(e.log, m), work.potential, work.friction, work.restitution);
  }
  return text + and_more(materials.size(), "materials");
}

std::string work_of_scripts_text(const std::vector<double>& scripts) {
  std::string text;
  for (std::size_t s = 0; s < std::min(scripts.size(), most_told); ++s) {
    text += fmt::format("  scripts/{}: {:.3g} J\n", s, scripts[s]);
  }
  return text + and_more(scripts.size(), "scripts");
}

std::string energy_text(const RunExplanation& e) {
  if (!e.energy) return "";
  const EnergySummary& energy = *e.energy;
  return fmt::format(
             "Energy: {:.9g} J at the beginning, {:.9g} J after the last window (in between from {:.9g} to {:.9g}).\n"
             "Work: damping and friction {:.3g} J, restitution {:.3g} J, scripts {:.3g} J; the "
             "rest, {:.3g} J, is the error of finite steps.\n",
             energy.begin, energy.last, energy.least, energy.greatest, energy.damping_work, energy.restitution_work,
             energy.held_work, energy.integration) +
         kinds_of_work_text(energy) + work_of_materials_text(e) + work_of_scripts_text(energy.scripts);
}

std::string certificates_text(const RunExplanation& e) {
  if (!e.log.has_contact) return "";
  const CertificateCounts& c = e.log.certificates;
  const auto in_a_second = [&](std::uint64_t n) { return rate(static_cast<double>(n), e.time); };
  std::string text = fmt::format(
      "Certificates, a second of simulated time: {:.4g} slices, {:.4g} tubes left, {:.4g} plans, {:.4g} repairs, "
      "{:.4g} activations, {:.4g} deactivations; at most {} near pairs at a time.\n",
      in_a_second(c.slices), in_a_second(c.tubes), in_a_second(c.plans), in_a_second(c.repairs),
      in_a_second(c.activations), in_a_second(c.deactivations), c.most_near);
  if (c.activations == 0) return text;
  const auto in_each = [&](std::uint64_t n) { return static_cast<double>(n) / static_cast<double>(c.activations); };
  text += fmt::format("For each layer that was activated: {:.3g} plans, {:.3g} repairs", in_each(c.plans),
                      in_each(c.repairs));
  if (!e.log.not_logged.contains("events")) text += fmt::format(", {:.3g} events of certificates", in_each(c.events));
  return text + ".\n";
}

Json logged_certificates_json(const LogFacts& log) {
  Json json = certificates_json(log.certificates);
  for (const std::string& member : log.not_logged) json[member] = nullptr;
  return json;
}

std::string time_text(const RunExplanation& e) {
  std::string text = fmt::format("Time: {}.\n", phases_text(e.log.phases));
  text += fmt::format("Verifying took {:.2f} s in all, in parallel with the rest if there were several threads.\n",
                      e.log.verifying_seconds);
  if (e.log.parts_ended < e.log.parts) {
    text += fmt::format("{} of {} part(s) of the run did not end normally; their time is not known.\n",
                        e.log.parts - e.log.parts_ended, e.log.parts);
  }
  if (e.log.bad_lines > 0) text += fmt::format("{} line(s) of the log are of unknown kinds.\n", e.log.bad_lines);
  return text;
}

}  // namespace

Json to_json(const RunExplanation& e) {
  Json json = {{"verdict", "explained"}, {"title", e.title}, {"dimension", e.dimension}};
  json["record"] = e.full ? "full" : "frames";
  json["windows"] = e.windows;
  json["open_window"] = e.open_window;
  json["time"] = e.time;
  json["breakpoints"] = e.breakpoints;
  json["events"] = kinds_json(e, 0);
  json["events_a_second"] = kinds_json(e, e.time > 0 ? e.time : 1);
  json["smallest_step"] = e.smallest_step;
  json["deepest"] = moment_json(e, e.deepest);
  json["nearest"] = moment_json(e, e.nearest);
  json["gap"] = gap_json(e.gap);
  json["layer_cap"] = layer_cap_json(e);
  json["step_halvings"] = e.halvings;
  json["roll_backs"] = e.log.roll_backs;
  json["energy"] = energy_json(e.energy);
  json["timing"] = {{"phases", phases_json(e.log.phases)},
                    {"verifying_seconds", e.log.verifying_seconds},
                    {"certificates", logged_certificates_json(e.log)},
                    {"deepest_active", e.log.deepest},
                    {"bound", or_null(e.bound())},
                    {"end", e.log.end()},
                    {"parts", e.log.parts},
                    {"parts_ended", e.log.parts_ended},
                    {"windows_logged", e.log.windows},
                    {"bad_lines", e.log.bad_lines}};
  return json;
}

Answer answer_of(const Json& json, const RunExplanation& e) {
  Answer answer(json, {"windows", "time"});
  answer.add({"deepest", e.deepest ? e.deepest->action.layer : 0});
  answer.add({"end", e.log.end().empty() ? "unknown" : e.log.end()});
  std::string& text = answer.text;
  text += fmt::format("{}: {} windows, {} s.\n", on_one_line(e.title), e.windows, e.time);
  if (e.open_window) text += "The run ends in a window that was never committed; it is left out.\n";
  text += contact_text(e) + bound_text(e) + cap_text(e) + roll_backs_text(e);
  text += events_text(e);
  if (e.smallest_step > 0) text += fmt::format("Smallest step of a free vertex: {} s.\n", digits17(e.smallest_step));
  text += energy_text(e) + certificates_text(e) + time_text(e);
  return answer;
}

}  // namespace noli::report
