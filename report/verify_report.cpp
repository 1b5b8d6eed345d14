// SPDX-License-Identifier: Apache-2.0
#include "report/verify_report.h"

#include <fmt/format.h>

#include <string>
#include <utility>

#include <noli/errors.h>
#include "certify/contact_report.h"
#include "certify/process/this_program.h"
#include "certify/proofs/claim.h"
#include "kernel/parallel.h"
#include "report/input_report.h"
#include "report/verify_statement.h"

namespace noli::report {
namespace {

Json first_json(const VerifyOutcome& outcome) { return outcome.first ? contact_json(*outcome.first) : Json(nullptr); }

Json reports_json(const VerifyOutcome& outcome) {
  Json list = Json::array();
  for (const ListedContact& listed : outcome.reports) list.push_back(contact_json(listed));
  return {{"listed", outcome.reports.size()},
          {"left_out", outcome.contact_count() - outcome.reports.size()},
          {"contacts", list}};
}

Json initial_reports_json(const VerifyOutcome& outcome) {
  Json list = Json::array();
  for (const ListedInitial& listed : outcome.initial_reports) {
    const InitialIntersection& pair = listed.pair;
    list.push_back({{"cells", {pair.first_cell, pair.second_cell}}, {"names", listed.names}, {"step", listed.step}});
  }
  const auto listed = outcome.initial_reports.size();
  return {{"listed", listed}, {"left_out", outcome.initial_intersections - listed}, {"intersections", list}};
}

/// The pairs of cells that are not compared because they intersect in the first frame.
Json baseline_json(const VerifyOutcome& outcome) {
  Json list = Json::array();
  for (const InitialIntersection& pair : outcome.baseline) list.push_back({pair.first_cell, pair.second_cell});
  return list;
}

Json steps_json(const VerifyOutcome& outcome) {
  Json json = Json::array();
  for (const StepCounts& step : outcome.steps) {
    json.push_back({{"contacts", counts_json(step.contacts)},
                    {"initial_intersections", step.initial_intersections},
                    {"goes_on", step.goes_on},
                    {"first_time", step.first ? Json(step.first->time) : Json(nullptr)}});
  }
  return json;
}

Json near_json(const VerifyOutcome& outcome) {
  if (!outcome.near) return nullptr;
  const TooNear& pair = outcome.near->pair;
  return {{"cells", {pair.first_cell, pair.second_cell}},
          {"names", outcome.near->names},
          {"step", outcome.near->step},
          {"part_of_step", pair.time},
          {"witnessed", outcome.near->witnessed}};
}

Json proof_json(const VerifyRequest& request, const VerifyOutcome& outcome) {
  return {{"file", request.proof ? Json(request.proof->string()) : Json(nullptr)},
          {"witnesses", outcome.witnesses},
          {"checked", or_null(outcome.checked)},
          {"not_checked", or_null(outcome.not_checked)}};
}

/// The claim, and what weakens it.
Json asked_json(const Claim& claim) {
  if (claim.cells.empty()) return nullptr;
  Json json = claim_json(claim);
  json["weaker"] = weakenings(claim);
  return json;
}

Json run_json(const RunEnding& ending) {
  return {{"end", or_null(ending.why)},
          {"time", ending.time},
          {"windows_total", or_null(ending.windows_total)},
          {"duration", or_null(ending.duration)}};
}

/// Of a run: how far it went, and how far it was to go.
void add_ending(const RunEnding& ending, Answer& answer) {
  answer.add({"run.end", ending.why.value_or("none")});
  answer.add({"run.time", ending.time});
  answer.add({"run.duration", ending.duration ? fmt::format("{}", *ending.duration) : "none"});
  answer.add({"run.windows_total", ending.windows_total ? std::to_string(*ending.windows_total) : "none"});
}

/// For machines.
void add_pairs(const VerifyRequest& request, const VerifyOutcome& outcome, Answer& answer) {
  for (const FeaturePair pair : all_feature_pairs) {
    answer.add({fmt::format("contacts.{}", name(pair)), outcome.contacts[static_cast<std::size_t>(pair)]});
  }
  answer.add({"initial_intersections", outcome.initial_intersections});
  answer.add({"first_time", outcome.first ? digits17(outcome.first->time) : "none"});
  answer.add({"steps", outcome.steps.size()});
  answer.add({"steps_total", outcome.steps_total});
  answer.add({"faces", outcome.faces});
  answer.add({"complete", outcome.complete});
  answer.add({"excluded", statement_json(request, outcome)["excluded"].size()});
  answer.add({"empty", outcome.claim.cells.empty() ? "none" : outcome.claim.empty ? "true" : "false"});
  if (outcome.ending) add_ending(*outcome.ending, answer);
}

}  // namespace

Json work_json(const VerifyOutcome& outcome) {
  Json json = stages_json(outcome.stages);
  json["obligations"] = outcome.obligations;
  json["cell_pairs"] = outcome.cell_pairs;
  return json;
}

int threads_used(const VerifyRequest& request) { return request.threads > 0 ? request.threads : hardware_threads(); }

Json verify_json(const VerifyRequest& request, const VerifyOutcome& outcome) {
  Json json = {{"verdict", name(outcome.verdict)}, {"complete", outcome.complete}};
  json["statement"] = statement_json(request, outcome);
  json["inputs"] = inputs_json(outcome.inputs);
  json["notes"] = outcome.notes;
  json["contacts"] = counts_json(outcome.contacts);
  json["initial_intersections"] = outcome.initial_intersections;
  json["first_time"] = outcome.first ? Json(outcome.first->time) : Json(nullptr);
  json["first"] = first_json(outcome);
  json["reports"] = reports_json(outcome);
  json["initial_reports"] = initial_reports_json(outcome);
  if (request.only_new) json["baseline"] = baseline_json(outcome);
  if (outcome.ending) {
    json["run"] = run_json(*outcome.ending);
    json["reproduced"] = outcome.reproduced;
  }
  json["steps"] = outcome.steps.size();
  json["steps_total"] = outcome.steps_total;
  json["per_step"] = steps_json(outcome);
  json["vertices"] = outcome.vertices;
  json["faces"] = outcome.faces;
  json["edges"] = outcome.edges;
  json["points"] = outcome.points;
  json["stages"] = work_json(outcome);
  json["near"] = near_json(outcome);
  json["first_frame"] = nullptr;
  if (outcome.largest_distance) {
    json["first_frame"] = {{"allowed", outcome.largest_distance->allowed}, {"not", outcome.largest_distance->limit}};
  }
  if (request.open_proof) json["proof"] = proof_json(request, outcome);
  json["claim"] = asked_json(outcome.claim);
  json["checker"] = outcome.checker ? checker_json(*outcome.checker) : Json();
  json["timing"] = {{"seconds", outcome.seconds},
                    {"read_seconds", outcome.read_seconds},
                    {"reproduce_seconds", outcome.reproduce_seconds},
                    {"proof_seconds", outcome.proof_seconds},
                    {"check_seconds", outcome.check_seconds},
                    {"threads", threads_used(request)},
                    {"peak_memory_bytes", peak_memory_bytes()}};
  return json;
}

Answer verify_answer(const VerifyRequest& request, const VerifyOutcome& outcome, TextOptions wanted) {
  Answer answer(name(outcome.verdict));
  add_pairs(request, outcome, answer);
  put_text(request, outcome, std::move(wanted), answer);
  return answer;
}

}  // namespace noli::report
