// SPDX-License-Identifier: Apache-2.0
#include "audit/numerics/precision_report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <span>

#include "audit/ccd/audit_report.h"

namespace noli::audit {
namespace {

std::string three_digits(double x) { return fmt::format("{:.3g}", x); }

/// The last window for which the runs can be compared.
const EnergyError* last_in_order(const PrecisionOutcome& outcome) {
  const std::size_t windows = outcome.windows_in_order();
  return windows > 0 ? &outcome.energies[windows - 1] : nullptr;
}

/// The greatest position drift of the first windows [m].
double greatest_position(const PrecisionRun& run, std::size_t windows) {
  double greatest = 0;
  for (std::size_t i = 0; i < std::min(windows, run.drifts.size()); ++i) {
    greatest = std::max(greatest, run.drifts[i].position);
  }
  return greatest;
}

/// The vertices of one feature of the pair, then those of the other.
std::span<const VertexId> vertices_of(const certificates::Stencil& pair) { return {pair.vertices.data(), pair.size()}; }

std::string vertices_text(const certificates::Stencil& pair) {
  const auto vertices = vertices_of(pair);
  return fmt::format("{} and {}", fmt::join(vertices.first(pair.first()), " "),
                     fmt::join(vertices.subspan(pair.first()), " "));
}

// --- text ------------------------------------------------------------------------------------------------------------

std::string first_time(const CourseChanges::Way& way) { return way.first ? three_digits(way.first->time) : "-"; }

TableRow row_of(const PrecisionRun& run, std::size_t windows) {
  windows = std::min(windows, run.drifts.size());
  const Drift last = windows > 0 ? run.drifts[windows - 1] : Drift{};
  const CourseChanges& changes = run.changes;
  return {std::to_string(run.arithmetic.bits), three_digits(greatest_position(run, windows)),
          three_digits(last.position),         three_digits(last.position_rms),
          three_digits(last.energy),           three_digits(last.momentum),
          three_digits(last.angular_momentum), first_time(changes.acts),
          first_time(changes.corners),         first_time(changes.parts),
          first_time(changes.sticks)};
}

std::string table_of_runs(const PrecisionOutcome& outcome) {
  std::vector<TableRow> rows = {{"bits", "position", "at-end", "rms-at-end", "energy", "momentum", "angular",
                                 "acts-from", "corners-from", "parts-from", "sticks-from"}};
  for (const PrecisionRun& run : outcome.runs) rows.push_back(row_of(run, outcome.windows_in_order()));
  return table_text(rows, 0);
}

std::string order_text(const PrecisionOutcome& outcome) {
  const auto time = outcome.order_changes();
  if (!time && last_in_order(outcome) == nullptr) return "Order of events: no window was compared.\n";
  if (!time) return "Order of events: the same.\n";
  const auto& acts = outcome.runs.back().changes.acts.first;
  if (acts && acts->time == *time) {
    return fmt::format("Order of events: differs from {} s on, when layer {} acts between vertices {} in {} only.\n",
                       three_digits(*time), acts->layer, vertices_text(acts->pair),
                       acts->acts_in_double ? "double" : fmt::format("{} bits", outcome.runs.back().arithmetic.bits));
  }
  return fmt::format(
      "Order of events: differs from {} s on, where {} comes before {}; double has both at one time, in the opposite "
      "order.\n",
      three_digits(*time), outcome.tie->first, outcome.tie->second);
}

std::string energy_text(const PrecisionOutcome& outcome) {
  if (last_in_order(outcome) == nullptr) return "";
  const EnergyError& last = *last_in_order(outcome);
  return fmt::format(
      "Energy of double at {} s: {} J. Gained by truncation {} J, by rounding {} J: rounding is {} of both.\n",
      three_digits(last.time), three_digits(last.energy), three_digits(last.truncation), three_digits(last.rounding),
      three_digits(last.share_of_rounding()));
}

// --- JSON ------------------------------------------------------------------------------------------------------------

Json way_json(const CourseChanges::Way& way) {
  Json json = {{"count", way.count}, {"first", nullptr}};
  if (!way.first) return json;
  json["first"] = {{"time", way.first->time},
                   {"layer", way.first->layer},
                   {"vertices", vertices_of(way.first->pair)},
                   {"acts_in_double", way.first->acts_in_double}};
  return json;
}

Json drift_json(const Drift& drift) {
  return {{"time", drift.time},
          {"position", drift.position},
          {"vertex", drift.vertex},
          {"position_rms", drift.position_rms},
          {"energy", drift.energy},
          {"momentum", drift.momentum},
          {"angular_momentum", drift.angular_momentum}};
}

Json run_json(const PrecisionRun& run, std::size_t windows) {
  Json json = {{"bits", run.arithmetic.bits},
               {"binary64", run.arithmetic.binary64},
               {"greatest_position", greatest_position(run, windows)},
               {"acts", way_json(run.changes.acts)},
               {"corners", way_json(run.changes.corners)},
               {"parts", way_json(run.changes.parts)},
               {"sticks", way_json(run.changes.sticks)},
               {"ended", or_null(run.ended)},
               {"windows", Json::array()}};
  for (const Drift& drift : run.drifts) json["windows"].push_back(drift_json(drift));
  return json;
}

Json energy_json(const EnergyError& error) {
  return {{"time", error.time},
          {"energy", error.energy},
          {"truncation", error.truncation},
          {"rounding", error.rounding},
          {"share_of_rounding", error.share_of_rounding()}};
}

Json order_json(const PrecisionOutcome& outcome) {
  const auto time = outcome.order_changes();
  Json json = {{"changes_at", or_null(time)}, {"tie", nullptr}};
  if (outcome.tie) {
    json["tie"] = {{"time", outcome.tie->time}, {"first", outcome.tie->first}, {"second", outcome.tie->second}};
  }
  return json;
}

}  // namespace

const char* precision_verdict(const PrecisionOutcome& outcome) {
  if (outcome.difference) return "differs";
  return outcome.complete && outcome.windows > 0 ? "same" : "undecided";
}

report::Answer precision_answer(const PrecisionOutcome& outcome) {
  const auto changes = outcome.order_changes();
  const bool compared = !outcome.energies.empty();
  const double time = compared ? outcome.energies.back().time : 0;
  const auto if_compared = [&](const std::string& text) { return compared ? text : std::string("unknown"); };
  const std::string position = three_digits(greatest_position(outcome.runs.back(), outcome.windows_in_order()));
  report::Answer answer(precision_verdict(outcome),
                        {{"windows", outcome.windows},
                         {"time", three_digits(time)},
                         {"vertices", outcome.vertices},
                         {"events", outcome.events},
                         {"examined", outcome.examined},
                         {"impulses", outcome.impulses},
                         {"bits", outcome.runs.back().arithmetic.bits},
                         {"position", if_compared(position)},
                         {"order_changes", changes ? three_digits(*changes) : if_compared("none")},
                         {"complete", outcome.complete}});
  std::string& text = answer.text;
  if (outcome.difference) {
    text += fmt::format("53 bits differ from double: first the {}, at {} s.\n", outcome.difference->what,
                        digits17(outcome.difference->time));
  }
  const bool in_order = outcome.windows_in_order() == outcome.energies.size();
  text += fmt::format("Double against other precisions, in {} windows{}:\n", outcome.windows_in_order(),
                      in_order ? "" : ", which end before a layer acts in one run only");
  text += table_of_runs(outcome) + order_text(outcome) + energy_text(outcome);
  if (outcome.ended)
    text += fmt::format("The run in double ended after window {}: {}.\n", outcome.windows, *outcome.ended);
  for (const PrecisionRun& run : outcome.runs) {
    if (!run.ended) continue;
    text += fmt::format("{} bits ended after window {}: {}.\n", run.arithmetic.bits, run.drifts.size(), *run.ended);
  }
  return answer;
}

Json precision_json(const PrecisionOutcome& outcome) {
  Json json = {{"verdict", precision_verdict(outcome)},
               {"windows", outcome.windows},
               {"windows_total", outcome.windows_total},
               {"windows_in_order", outcome.windows_in_order()},
               {"complete", outcome.complete},
               {"ended", or_null(outcome.ended)},
               {"vertices", outcome.vertices},
               {"extent", outcome.extent},
               {"events", outcome.events},
               {"examined", outcome.examined},
               {"impulses", outcome.impulses},
               {"difference", nullptr},
               {"order", order_json(outcome)},
               {"energies", Json::array()},
               {"runs", Json::array()}};
  if (outcome.difference) json["difference"] = {{"time", outcome.difference->time}, {"what", outcome.difference->what}};
  for (const EnergyError& error : outcome.energies) json["energies"].push_back(energy_json(error));
  for (const PrecisionRun& run : outcome.runs) json["runs"].push_back(run_json(run, outcome.windows_in_order()));
  return json;
}

}  // namespace noli::audit
