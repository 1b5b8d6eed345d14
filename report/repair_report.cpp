// SPDX-License-Identifier: Apache-2.0
#include "report/repair_report.h"

#include <fmt/format.h>

#include <algorithm>

#include <noli/errors.h>
#include "certify/body_names.h"
#include "certify/contact_report.h"
#include "report/input_report.h"
#include "report/verify_place.h"
#include "trajectory/text.h"

namespace noli::report {
namespace {

const RepairedStep* largest_change(const RepairOutcome& outcome) {
  const auto found = std::ranges::max_element(outcome.changed, {}, &RepairedStep::largest);
  return found == outcome.changed.end() ? nullptr : &*found;
}

Json changed_json(const RepairOutcome& outcome) {
  Json list = Json::array();
  for (const RepairedStep& step : outcome.changed) {
    list.push_back({{"step", step.step},
                    {"inserted", step.inserted},
                    {"moved", step.moved},
                    {"largest", step.largest},
                    {"rms", step.rms},
                    {"vertex", step.vertex},
                    {"deepest_layer", step.deepest}});
  }
  return list;
}

Json bodies_json(const RepairOutcome& outcome) {
  Json list = Json::array();
  for (std::size_t i = 0; i < outcome.by_body.size(); ++i) {
    const RepairedBody& moved = outcome.by_body[i];
    const FrameBody& body = outcome.bodies[i];
    list.push_back({{"name", body.name},
                    {"still", body.still},
                    {"fixed", moved.fixed},
                    {"first_vertex", body.first_vertex},
                    {"vertices", body.vertices},
                    {"moved", moved.moved},
                    {"largest", moved.largest},
                    {"rms", moved.rms}});
  }
  return list;
}

Json outputs_json(const RepairOutcome& outcome) {
  Json list = Json::array();
  for (const RepairedFrame& frame : outcome.written) {
    list.push_back({{"file", frame.facts.file},
                    {"time", frame.time},
                    {"what", frame.what},
                    {"bytes", frame.facts.bytes},
                    {"sha256", hex(frame.facts.sha256)}});
  }
  return list;
}

Json obstacle_json(const RepairOutcome& outcome) {
  if (!outcome.obstacle) return nullptr;
  const RepairObstacle& obstacle = *outcome.obstacle;
  Json json = {{"step", obstacle.step}, {"time", obstacle.time}};
  if (obstacle.cells) {
    json["cells"] = {obstacle.vertices[0], obstacle.vertices[1]};
    json["names"] = obstacle.names;
  } else {
    json.update(contact_json(FeatureContact{obstacle.kind, obstacle.vertices, {}}));
  }
  return json;
}

std::string obstacle_pair(const RepairOutcome& outcome) {
  const RepairObstacle& obstacle = *outcome.obstacle;
  if (obstacle.cells) return obstacle.names[0] + " × " + obstacle.names[1];
  return names_of_frames(outcome.bodies).pair(obstacle.kind, obstacle.vertices, "×");
}

/// "0.012 (0.4 mean edges)".
std::string distance_text(double distance, const RepairOutcome& outcome) {
  if (!(outcome.mean_edge > 0)) return digits4(distance);
  return fmt::format("{} ({:.2g} mean edges)", digits4(distance), distance / outcome.mean_edge);
}

/// Of the steps that were changed, from `first` on.
std::string rows_of_steps(const RepairOutcome& outcome, std::size_t first, std::size_t end) {
  std::string text;
  for (std::size_t i = first; i < end; ++i) {
    const RepairedStep& step = outcome.changed[i];
    text += fmt::format("{:>6}  {:>8}  {:>10}  {:>10}  {:>8}  {:>13}\n", step.step, step.moved, digits4(step.largest),
                        digits4(step.rms), step.inserted, step.deepest);
  }
  return text;
}

/// What was aimed at, what moved as given, and where the times and the motion are.
std::string files_and_settings(const RepairRequest& request, const RepairOutcome& outcome) {
  std::string text =
      fmt::format("Aimed at: a gap of {} where cells are largest. ", distance_text(outcome.thickness, outcome));
  if (outcome.fixed > 0) {
    text += fmt::format("{} of {} vertices move as given. ", outcome.fixed, outcome.vertices);
  }
  text += "Times of the frames: " + on_one_line(outcome.times.string());
  if (outcome.run_begun) text += ". Their motion: " + on_one_line(request.run->string());
  return text + '\n';
}

/// The files that were written.
std::string rows_of_frames(const RepairOutcome& outcome) {
  std::string text = fmt::format("{:>10}  {:>8}  file\n", "time", "what");
  for (const RepairedFrame& frame : outcome.written) {
    text += fmt::format("{:>10}  {:>8}  {}\n", digits4(frame.time), frame.what, on_one_line(frame.facts.file));
  }
  return text;
}

constexpr std::size_t most_steps = 12;

/// The table of the first steps, and what stands below it.
void put_steps(const RepairOutcome& outcome, Answer& answer) {
  if (outcome.changed.empty()) {
    if (outcome.end == RepairEnd::done) answer.text += "No step touches; all frames are as given.\n";
    return;
  }
  const std::size_t shown = std::min(most_steps, outcome.changed.size());
  answer.text += fmt::format("{:>6}  {:>8}  {:>10}  {:>10}  {:>8}  {:>13}\n", "step", "vertices", "largest", "rms",
                             "inserted", "deepest layer");
  answer.text += rows_of_steps(outcome, 0, shown);
  if (outcome.changed.size() > shown)
    answer.text += fmt::format("  ... and {} more (-v)\n", outcome.changed.size() - shown);
  for (const RepairedBody& body : outcome.by_body) {
    if (body.moved == 0) continue;
    answer.text += fmt::format("{}: moved by {} at most, root mean square {}.\n", on_one_line(body.name),
                               distance_text(body.largest, outcome), digits4(body.rms));
  }
  const RepairedStep& most_changed = *largest_change(outcome);
  const std::string vertex = on_one_line(names_of_frames(outcome.bodies).vertex(most_changed.vertex));
  answer.text += fmt::format("Moved most: vertex {} in step {}, by {}.\n", vertex, most_changed.step,
                             distance_text(most_changed.largest, outcome));
  answer.details += rows_of_steps(outcome, shown, outcome.changed.size());
}

std::string repair_place(const RepairOutcome& outcome) {
  const auto at = [&outcome] {
    const RepairObstacle& obstacle = *outcome.obstacle;
    return obstacle.step == 0
               ? "first frame  " + obstacle_pair(outcome)
               : fmt::format("step {}  t = {}  {}", obstacle.step, digits4(obstacle.time), obstacle_pair(outcome));
  };
  const auto settled = [&outcome] {
    const VerifyOutcome& verified = *outcome.verified;
    if (verified.verdict == Verdict::undecided) {
      return std::string("all are written, but the last check was cut short") +
             (verified.proof_begun ? ", and the proof with it" : "");
    }
    const std::string stated = nothing_touches_text(verified);
    if (!verified.checker) return stated + " (decided exactly, not checked)";
    return fmt::format("{} (accepted by {} {})", stated, verified.checker->name, verified.checker->version);
  };
  const std::string so_far = fmt::format("{} of {} steps repaired", outcome.steps, outcome.steps_total);
  switch (outcome.end) {
    case RepairEnd::done:
      return fmt::format("{} frames ({} inserted, {} as given), {} of {} steps changed: {}", outcome.frames,
                         outcome.inserted, outcome.as_given, outcome.changed.size(), outcome.steps_total, settled());
    case RepairEnd::start_touches: return at() + ": they touch from the beginning";
    case RepairEnd::blocked: return at() + ": both move as given";
    case RepairEnd::undecided:
      return so_far + "; " + (outcome.obstacle ? at() + " are too close for double precision" : "no way was found");
    case RepairEnd::interrupted: return so_far + " (interrupted)";
    case RepairEnd::out_of_time: return so_far + " (time limit)";
  }
  return "";
}

/// Contact alone tears a mesh where a body went far into it.
bool is_deep(const RepairOutcome& outcome) {
  constexpr double edges = 2;
  return outcome.mean_edge > 0 && !outcome.changed.empty() &&
         largest_change(outcome)->largest > edges * outcome.mean_edge;
}

std::string repair_advice(const RepairRequest& request, const RepairOutcome& outcome) {
  const std::string spread = request.spread == 0 && is_deep(outcome)
                                 ? "--spread 5 also moves the surroundings of contacts, and is often faster."
                                 : "";
  switch (outcome.end) {
    case RepairEnd::done:
      return outcome.verified->verdict == Verdict::undecided ? "noli verify decides the new frames." : spread;
    case RepairEnd::start_touches:
      return "separate them in the first frame, or let them pass through each other: --only-new for all that "
             "intersects there, --ignore for groups of vertices.";
    case RepairEnd::blocked:
      return "let fewer vertices be fixed (--fixed, --fixed-first), or leave the pair out with --ignore.";
    case RepairEnd::undecided:
      return spread.empty() ? "try another --thickness or --restitution, or let fewer vertices be fixed." : spread;
    case RepairEnd::interrupted:
    case RepairEnd::out_of_time:
      return "--resume continues after the last complete step; with --force it replaces results of the same names.";
  }
  return "";
}

}  // namespace

const char* repair_verdict(const RepairOutcome& outcome) {
  switch (outcome.end) {
    case RepairEnd::start_touches:
    case RepairEnd::blocked: return "cannot_be";
    case RepairEnd::done: return name(outcome.verified->verdict).data();
    default: return "undecided";
  }
}

Json repair_json(const RepairRequest& request, const RepairOutcome& outcome) {
  Json json = {{"verdict", repair_verdict(outcome)}, {"end", name(outcome.end)}};
  json["pattern"] = request.pattern;
  json["times"] = outcome.times.string();
  json["run"] = outcome.run_begun ? Json(request.run->string()) : Json(nullptr);
  json["dimension"] = outcome.dimension;
  json["vertices"] = outcome.vertices;
  json["cells"] = outcome.cells;
  json["points"] = request.points;
  json["fixed"] = outcome.fixed;
  json["fixed_first"] = request.fixed_first;
  json["baseline"] = request.only_new ? Json(outcome.baseline) : Json(nullptr);
  json["thickness"] = outcome.thickness;
  json["restitution"] = request.restitution;
  json["friction"] = request.friction;
  json["spread"] = request.spread;
  json["mean_edge"] = outcome.mean_edge;
  json["steps"] = outcome.steps;
  json["steps_before"] = outcome.steps_before;
  json["steps_total"] = outcome.steps_total;
  json["frames"] = outcome.frames;
  json["inserted"] = outcome.inserted;
  json["as_given"] = outcome.as_given;
  json["copied"] = outcome.copied;
  json["changed"] = changed_json(outcome);
  json["bodies"] = bodies_json(outcome);
  json["momentum_into_fixed"] = outcome.momentum_into_fixed;
  json["obstacle"] = obstacle_json(outcome);
  const bool checked = outcome.verified && outcome.verified->checker;
  json["checker"] = checked ? Json({{"name", outcome.verified->checker->name},
                                    {"version", outcome.verified->checker->version},
                                    {"commit", outcome.verified->checker->commit}})
                            : Json(nullptr);
  const bool stated = outcome.verified && outcome.verified->verdict != Verdict::undecided;
  json["stated"] = stated ? Json(nothing_touches_text(*outcome.verified)) : Json(nullptr);
  const bool proof = request.proof && outcome.verified && outcome.verified->proof_begun;
  json["proof"] = proof ? Json(request.proof->string()) : Json(nullptr);
  json["inputs"] = inputs_json(outcome.inputs);
  json["outputs"] = outputs_json(outcome);
  json["notes"] = outcome.notes;
  json["timing"] = {{"seconds", outcome.seconds}};
  return json;
}

Answer repair_answer(const RepairRequest& request, const RepairOutcome& outcome) {
  Answer answer(repair_json(request, outcome),
                {"end", "steps", "steps_total", "frames", "inserted", "copied", "changed", "thickness"});
  for (const std::string& note : outcome.notes) answer.text += fmt::format("Note: {}.\n", on_one_line(note));
  if (outcome.steps_before > 0) {
    answer.text += fmt::format("Earlier calls repaired {} of {} steps.\n", outcome.steps_before, outcome.steps_total);
  }
  if (outcome.end != RepairEnd::start_touches && outcome.thickness > 0) {
    put_steps(outcome, answer);
    answer.text += files_and_settings(request, outcome);
    answer.details += rows_of_frames(outcome);
  }
  answer.next = repair_advice(request, outcome);
  answer.place = repair_place(outcome);
  return answer;
}

}  // namespace noli::report
