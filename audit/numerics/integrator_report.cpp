// SPDX-License-Identifier: Apache-2.0
#include "audit/numerics/integrator_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include <noli/errors.h>
#include "audit/ccd/audit_report.h"

namespace noli::audit {
namespace {

// --- JSON ------------------------------------------------------------------------------------------------------------

Json errors_json(const IntegratorErrors& errors) {
  return {{"energy", errors.energy},
          {"momentum", errors.momentum},
          {"angular_momentum", errors.angular_momentum},
          {"trajectory", errors.trajectory}};
}

Json point_json(const IntegratorPoint& point) {
  return {{"factor", point.factor},       {"least_step", point.least_step},
          {"events", point.events},       {"finite", point.finite},
          {"converged", point.converged}, {"errors", point.finite ? errors_json(point.errors) : Json(nullptr)}};
}

Json result_json(const IntegratorResult& result) {
  Json json = {{"title", result.title},
               {"dimension", result.dimension},
               {"vertices", result.vertices},
               {"forces", result.forces},
               {"shortest_step", result.shortest_step},
               {"longest_step", result.longest_step},
               {"windows", result.windows},
               {"window_length", result.window_length},
               {"plain_loop", result.plain},
               {"reference_finite", result.reference_finite},
               {"complete", result.complete},
               {"uncertainty", errors_json(result.uncertainty)}};
  json["methods"] = Json::array();
  for (const MethodResult& method : result.methods) {
    Json points = Json::array();
    for (const IntegratorPoint& point : method.points) points.push_back(point_json(point));
    json["methods"].push_back({{"method", method.method}, {"points", points}});
  }
  return json;
}

Json timing_json(const IntegratorResult& result) {
  Json json = {{"title", result.title}, {"methods", Json::array()}};
  for (const MethodResult& method : result.methods) {
    Json seconds = Json::array();
    for (const IntegratorPoint& point : method.points) seconds.push_back(point.seconds);
    json["methods"].push_back({{"method", method.method}, {"seconds", seconds}});
  }
  return json;
}

// --- text ------------------------------------------------------------------------------------------------------------

std::string two_digits(double x) { return fmt::format("{:.2g}", x); }

/// The observed order: the ratio of successive trajectory errors as a power of the ratio of steps.
std::string order(const MethodResult& method, std::size_t i) {
  if (i == 0 || !method.points[i].finite || !method.points[i - 1].finite) return "-";
  const IntegratorPoint &before = method.points[i - 1], &now = method.points[i];
  if (before.errors.trajectory == 0 || now.errors.trajectory == 0) return "-";
  return fmt::format("{:.1f}",
                     std::log(before.errors.trajectory / now.errors.trajectory) / std::log(before.factor / now.factor));
}

void append_rows(const MethodResult& method, std::vector<TableRow>& rows) {
  for (std::size_t i = 0; i < method.points.size(); ++i) {
    const IntegratorPoint& point = method.points[i];
    const auto of = [&](double error) { return point.finite ? two_digits(error) : std::string("not finite"); };
    rows.push_back({method.method + (point.converged ? "" : " (not solved)"), fmt::format("{:g}", point.factor),
                    two_digits(point.least_step), std::to_string(point.events), of(point.errors.trajectory),
                    order(method, i), of(point.errors.energy), of(point.errors.momentum),
                    of(point.errors.angular_momentum), fmt::format("{:.3g}", point.seconds)});
  }
}

void append_result(const IntegratorResult& result, std::string& text) {
  const auto out = std::back_inserter(text);
  fmt::format_to(out, "{}: {} vertices, {} forces with steps from {:.2g} to {:.2g} s; {} windows of {:g} s\n",
                 result.title.empty() ? "A scene" : on_one_line(result.title), result.vertices, result.forces,
                 result.shortest_step, result.longest_step, result.windows, result.window_length);
  if (!result.reference_finite) text += "The reference, Verlet's method with short steps, is not finite.\n";
  std::vector<TableRow> rows = {{"method", "steps", "least [s]", "forces fired", "trajectory [m]", "order", "energy",
                                 "momentum", "angular", "seconds"}};
  for (const MethodResult& method : result.methods) append_rows(method, rows);
  text += table_text(rows, 1);
  const IntegratorErrors& u = result.uncertainty;
  fmt::format_to(out, "The reference itself is uncertain by: trajectory {} m, energy {}, momentum {}, angular {}.\n",
                 two_digits(u.trajectory), two_digits(u.energy), two_digits(u.momentum),
                 two_digits(u.angular_momentum));
  if (!result.plain) {
    text +=
        "With damping, scripts or contact `verlet` is this integrator with one step for all forces, "
        "and `euler` is left out.\n";
  }
}

}  // namespace

const char* integrator_verdict(const IntegratorResults& results) {
  if (std::ranges::any_of(results, &IntegratorResult::has_finding)) return "finding";
  return !results.empty() && std::ranges::all_of(results, &IntegratorResult::complete) ? "measured" : "undecided";
}

report::Answer integrator_answer(const IntegratorResults& results) {
  std::size_t runs = 0;
  for (const IntegratorResult& result : results) {
    for (const MethodResult& method : result.methods) runs += method.points.size();
  }
  report::Answer answer(integrator_verdict(results), {{"scenes", results.size()}, {"runs", runs}});
  for (const IntegratorResult& result : results) append_result(result, answer.text);
  return answer;
}

Json integrator_json(const IntegratorResults& results) {
  Json json = {{"verdict", integrator_verdict(results)}, {"scenes", Json::array()}};
  Json times = Json::array();
  for (const IntegratorResult& result : results) {
    json["scenes"].push_back(result_json(result));
    times.push_back(timing_json(result));
  }
  json["timing"] = {{"scenes", times}};
  return json;
}

}  // namespace noli::audit
