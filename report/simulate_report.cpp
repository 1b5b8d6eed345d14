// SPDX-License-Identifier: Apache-2.0
#include "report/simulate_report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <noli/errors.h>
#include "certify/contact_report.h"
#include "certify/not_compared.h"
#include "certify/process/run_program.h"
#include "certify/process/this_program.h"
#include "certify/simulate/energy_watch.h"
#include "certify/simulate/phase_clock.h"
#include "kernel/parallel.h"
#include "report/page/report_page.h"
#include "trajectory/blocks/sha256.h"

namespace noli::report {
namespace {

const char* verdict(const SimulateOutcome& outcome) {
  switch (outcome.end) {
    case RunEnd::done: return "no_contact";
    case RunEnd::contact:
    case RunEnd::too_near:
    case RunEnd::not_finite:
    case RunEnd::unstable: return name(outcome.end);
    case RunEnd::interrupted:
    case RunEnd::out_of_time:
    case RunEnd::out_of_memory: return "undecided";
  }
  return "";
}

/// The window that is not part of the run, from 1.
std::uint64_t refused_window(const SimulateOutcome& outcome) { return outcome.windows + 1; }

/// Nothing if there was no contact.
Json first_json(const SimulateOutcome& outcome) {
  if (!outcome.first) return nullptr;
  Json json = contact_json(*outcome.first);
  json.erase("step");
  json["names"] = outcome.first_names;
  json["window"] = refused_window(outcome);
  return json;
}

Json not_finite_json(const SimulateOutcome& outcome) {
  if (!outcome.not_finite) return nullptr;
  const NotFinite& found = *outcome.not_finite;
  return {{"window", refused_window(outcome)},
          {"time", found.time},
          {"force", found.kind ? Json(noli::name(*found.kind)) : Json(nullptr)},
          {"vertices", found.force},
          {"vertex", found.vertex}};
}

Json start_gap_json(const SimulateOutcome& outcome) {
  if (!outcome.start_gap) return nullptr;
  return {{"gap", outcome.start_gap->gap},
          {"thickness", outcome.start_gap->thickness},
          {"last_thickness", outcome.start_gap->last}};
}

Json too_near_json(const SimulateOutcome& outcome) {
  if (!outcome.limit) return nullptr;
  const PairTooNear& pair = *outcome.limit;
  const std::vector<VertexId> vertices(pair.vertices.begin(),
                                       pair.vertices.begin() + static_cast<std::ptrdiff_t>(point_count(pair.kind)));
  return {{"window", refused_window(outcome)}, {"time", outcome.limit->time},
          {"pair", noli::name(pair.kind)},     {"vertices", vertices},
          {"names", outcome.first_names},      {"start", start_gap_json(outcome)}};
}

/// What begins within all layers is no matter of the motion.
std::string too_near_text(const SimulateOutcome& outcome) {
  const std::string pair = on_one_line(outcome.first_names);
  const std::optional<StartGap>& start = outcome.start_gap;
  const std::string begins = start ? fmt::format(
                                         "the scene begins with them {:.6g} m apart, within the thickness of "
                                         "contact, {:.6g} m, whose last layer has {:.6g} m",
                                         start->gap, start->thickness, start->last)
                                   : "";
  if (start && outcome.limit->time == 0) {
    return fmt::format("Too near at the start: {} need more layers of contact than \"most_layers\" allows: {}.", pair,
                       begins);
  }
  return fmt::format(
      "Too near in window {}: {} need more layers of contact than \"most_layers\" allows, at {} s{}. The "
      "window is not part of the run.",
      refused_window(outcome), pair, digits17(outcome.limit->time), start ? "; " + begins : "");
}

/// The time that the committed windows cover.
std::string span(const SimulateOutcome& outcome) { return fmt::format("from 0 to {} s", outcome.time); }

/// All windows are there, and nothing touches in them.
std::string unstable_text(const SimulateOutcome& outcome) {
  const EnergyAstray& energy = *outcome.energy_astray;
  return fmt::format(
      "{} But the energy drifts: from {:.3g} J to {:.3g} J at {} s, without what {} gave. Nothing touches, but the "
      "motion is not that of the scene: its steps are too long, also for damping, or resonate.",
      nothing_touches(outcome.not_compared, span(outcome)), energy.begin, energy.there, digits17(energy.time),
      energy.may_fall ? "scripts" : "damping, friction and scripts");
}

std::string going_on_text(const SimulateOutcome& outcome) {
  return outcome.begun ? "; `--resume` continues after the last window."
                       : " before the run began; nothing was written.";
}

std::string out_of_memory_text(const SimulateOutcome& outcome) {
  return fmt::format(
      "Out of memory in window {}, after the committed ones{} A window takes memory for its breakpoints and for the "
      "layers of contact that pairs have: with fewer \"most_breakpoints\" in the scene it needs less.",
      outcome.windows + 1, going_on_text(outcome));
}

std::string end_text(const SimulateOutcome& outcome) {
  switch (outcome.end) {
    case RunEnd::done:
      if (outcome.windows == 0) return "No window was asked for.";
      return nothing_touches(outcome.not_compared, span(outcome));
    case RunEnd::contact: {
      const ListedContact& first = *outcome.first;
      return fmt::format(
          "Contact in window {}: first {} ({}), {}, at {} s ({} pairs of features in the window). The window is not "
          "part of the run.",
          refused_window(outcome), contact_text(first.contact), on_one_line(outcome.first_names),
          noli::name(first.kind), digits17(first.time), outcome.contact->contact_count());
    }
    case RunEnd::too_near: return too_near_text(outcome);
    case RunEnd::not_finite: {
      const NotFinite& found = *outcome.not_finite;
      const std::string force =
          found.kind ? fmt::format("the {} of vertices {}", noli::name(*found.kind), fmt::join(found.force, ", "))
                     : "free motion";
      return fmt::format(
          "Not finite in window {}: at {} s {} gives vertex {} a velocity or position that is not finite. The window "
          "is not part of the run.",
          refused_window(outcome), digits17(found.time), force, found.vertex);
    }
    case RunEnd::unstable: return unstable_text(outcome);
    case RunEnd::interrupted: return "Interrupted" + going_on_text(outcome);
    case RunEnd::out_of_time: return "Out of time" + going_on_text(outcome);
    case RunEnd::out_of_memory: return out_of_memory_text(outcome);
  }
  return "";
}

/// What has been verified.
std::string statement(const SimulateOutcome& outcome) {
  if (outcome.windows == 0) return "no window was committed: nothing is claimed.";
  std::string text = fmt::format(
      "no two features that share no vertex meet at any time from 0 to {} s. Not compared: two cells whose vertices "
      "are "
      "all scripted or pinned",
      outcome.time);
  for (const auto& pair : outcome.not_compared.excluded) text += "; two cells of " + pair_text(pair);
  return text + ".";
}

std::string committed_text(const SimulateRequest& request, const SimulateOutcome& outcome) {
  const std::string run = on_one_line(request.run.string());
  if (outcome.windows == 0) return fmt::format("No window was committed to {}: nothing is claimed.", run);
  return fmt::format("{} windows committed to {}, each verified exactly: {}", outcome.windows, run, statement(outcome));
}

/// What stands behind the verdict.
std::string place(const SimulateOutcome& outcome) {
  const bool more = outcome.some_ended_early && outcome.windows < outcome.windows_total;
  const std::string committed = fmt::format("{} of {}{} windows, {} s", outcome.windows, more ? "at least " : "",
                                            outcome.windows_total, digits4(outcome.time));
  const std::string at = fmt::format("window {}", outcome.windows + 1);
  switch (outcome.end) {
    case RunEnd::done: return fmt::format("{}: {}", committed, nothing_touches_in_short(outcome.not_compared));
    case RunEnd::contact: {
      const ListedContact& first = *outcome.first;
      return fmt::format("{}  t = {} s  {}", at, digits4(first.time), who_and_where(first, outcome.dimension));
    }
    case RunEnd::too_near:
      return fmt::format("{}  t = {} s  {}", at, digits4(outcome.limit->time), outcome.first_names);
    case RunEnd::not_finite:
      return fmt::format("{}  t = {} s  vertex {}", at, digits4(outcome.not_finite->time), outcome.not_finite->vertex);
    case RunEnd::unstable: return committed + ": nothing touches, but the energy drifts";
    case RunEnd::interrupted: return committed + " (interrupted)";
    case RunEnd::out_of_time: return committed + " (time limit)";
    case RunEnd::out_of_memory: return committed + " (out of memory)";
  }
  return "";
}

/// The command that goes on with the run, or begins it again, with all options that decide what is simulated.
std::string command_to_go_on(const SimulateRequest& request, const SimulateOutcome& outcome, const std::string& run) {
  std::vector<std::string> words = {"noli", "simulate", request.scene.string()};
  if (request.brief) words.emplace_back("--short");
  words.insert(words.end(), {"-o", run});
  if (request.until) words.insert(words.end(), {"--until", fmt::format("{}", *request.until)});
  if (request.past_duration) words.emplace_back("--past-duration");
  if (request.ignore_space) words.emplace_back("--ignore-space");
  if (outcome.begun) {
    words.emplace_back("--resume");
  } else {
    if (!request.prove) words.emplace_back("--no-proof");
    if (request.force) words.emplace_back("--force");
  }
  return shell_words(words);
}

/// `noli explain` refuses steps above their limits unless the scene accepts them; then it names none.
std::string shorten_steps(const SimulateRequest& request, const SimulateOutcome& outcome) {
  const std::string scene = shell_words({request.scene.string()}),
                    explain = fmt::format("noli explain {}{}", scene, request.brief ? " --short" : "");
  if (outcome.allow_unstable) {
    return fmt::format("remove \"allow_unstable\" from {}; {} then names any step that is too long.", scene, explain);
  }
  return fmt::format(
      "{} says where steps are too long for the damping, or resonate; else lower \"step_factor\", or \"stability\" in "
      "\"contact\".",
      explain);
}

std::string make_room(const SimulateRequest& request, const SimulateOutcome& outcome) {
  const std::string scene = shell_words({request.scene.string()});
  if (outcome.start_gap && outcome.limit->time == 0) {
    return fmt::format("let them begin further apart in {}, or lower \"thickness\" in its \"contact\".", scene);
  }
  if (outcome.allow_unstable) return shorten_steps(request, outcome);
  return fmt::format(
      "raise \"stiffness\" or \"thickness\" in \"contact\" of {}; where scripts press things together, leave a gap.",
      scene);
}

/// What a user does now.
std::string next_step(const SimulateRequest& request, const SimulateOutcome& outcome) {
  std::string path = request.run.string();
  while (path.size() > 1 && path.back() == '/') path.pop_back();
  const std::string run = shell_words({path}), page = shell_words({path + ".html"});
  const std::string shown = has_report_page()
                                ? fmt::format("noli report {} -o {}", run, page)
                                : fmt::format("noli export {} -o {}", run, shell_words({path + "_%d.obj"}));
  switch (outcome.end) {
    case RunEnd::contact: return shown + " shows the motion up to there.";
    case RunEnd::unstable:
    case RunEnd::not_finite: return shorten_steps(request, outcome);
    case RunEnd::too_near: return make_room(request, outcome);
    case RunEnd::interrupted:
    case RunEnd::out_of_time:
    case RunEnd::out_of_memory: return command_to_go_on(request, outcome, path);
    case RunEnd::done:
      if (outcome.windows == 0) return "";
      return fmt::format("{} shows the run; noli explain {} says how it went.", shown, run);
  }
  return "";
}

}  // namespace

Json simulate_json(const SimulateRequest& request, const SimulateOutcome& outcome) {
  Json json = {{"verdict", verdict(outcome)}, {"end", name(outcome.end)}};
  json["title"] = outcome.title;
  json["statement"] = statement(outcome);
  json["scripted_or_pinned"] = outcome.not_compared.held;
  json["excluded"] = outcome.not_compared.excluded;
  json["windows"] = outcome.windows;
  json["windows_total"] = outcome.windows_total;
  json["window_length"] = outcome.window_length;
  json["time"] = outcome.time;
  json["first_time"] = outcome.contact && outcome.contact->first ? Json(outcome.contact->first->time) : Json(nullptr);
  json["first"] = first_json(outcome);
  json["contacts"] = counts_json(outcome.contact ? outcome.contact->contacts : ContactCounts{});
  json["not_finite"] = not_finite_json(outcome);
  json["too_near"] = too_near_json(outcome);
  json["energy"] = {{"integration", outcome.integration},
                    {"astray", outcome.energy_astray ? energy_json(*outcome.energy_astray) : Json(nullptr)}};
  json["roll_backs"] = outcome.roll_backs;
  json["proof"] = {{"whole", outcome.proved}, {"ends", or_null(outcome.no_proof)}};
  json["certificate_defects"] = outcome.certificate_defects;
  json["dimension"] = outcome.dimension;
  json["vertices"] = outcome.vertices;
  json["cells"] = outcome.cells;
  json["timing"] = {{"seconds", outcome.seconds},
                    {"simulating_seconds", outcome.simulating_seconds},
                    {"verifying_seconds", outcome.verifying_seconds},
                    {"windows_before", outcome.windows_before},
                    {"events", outcome.events},
                    {"breakpoints", outcome.breakpoints},
                    {"phases", phases_json(outcome.phases)},
                    {"series", name(outcome.series)},
                    {"certificates", certificates_json(outcome.certificates)},
                    {"threads", request.threads > 0 ? request.threads : hardware_threads()},
                    {"peak_memory_bytes", peak_memory_bytes()}};
  return json;
}

Answer simulate_answer(const Json& json, const SimulateRequest& request, const SimulateOutcome& outcome) {
  Answer answer(json, {"end", "windows", "windows_total", "time", "first_time", "excluded", "scripted_or_pinned"});
  answer.place = place(outcome);
  answer.next = next_step(request, outcome);
  std::string& text = answer.text;
  text += end_text(outcome) + "\n";
  if (!outcome.title.empty()) text += on_one_line(outcome.title) + ": ";
  text += committed_text(request, outcome) + "\n";
  if (outcome.no_proof) {
    text += fmt::format("No proof was found: proof.blocks ends before {}.\n", on_one_line(*outcome.no_proof));
  }
  if (outcome.begun && outcome.series == SeriesEnd::stopped) {
    text += "series.h5 was not written: interrupted. `--resume` writes it.\n";
  }
  if (outcome.series == SeriesEnd::unavailable) {
    text +=
        "series.h5 was not written: noli_series is missing. Build with NOLI_WITH_HDF5=ON; `--resume` writes "
        "it.\n";
  }
  answer.details += fmt::format(
      "Time: {:.2f} s, {:.2f} integrating ({:.3g} events a second, {} breakpoints), {:.2f} verifying in "
      "parallel; {:.0f} MB.\n",
      outcome.seconds, outcome.simulating_seconds,
      rate(static_cast<double>(outcome.events), outcome.simulating_seconds), outcome.breakpoints,
      outcome.verifying_seconds, static_cast<double>(peak_memory_bytes()) / 1e6);
  answer.details += fmt::format("Busy with: {}.\n", phases_text(outcome.phases));
  return answer;
}

Json reproduce_json(const ReproduceRequest& request, const ReproduceOutcome& outcome) {
  return {{"verdict", outcome.same ? "same" : "different"},
          {"window", request.window},
          {"breakpoints", outcome.breakpoints},
          {"sha256", hex(outcome.found)},
          {"expected", hex(outcome.expected)}};
}

Answer reproduce_answer(const Json& json, const ReproduceRequest& request) {
  Answer answer(json, {"window", "breakpoints"});
  answer.text = fmt::format("{}, SHA-256 {}, is in {}.\n",
                            json["verdict"] == "same" ? "The window of the run" : "A different window from the run's",
                            json["sha256"].get_ref<const std::string&>(), on_one_line(request.output->string()));
  return answer;
}

}  // namespace noli::report
