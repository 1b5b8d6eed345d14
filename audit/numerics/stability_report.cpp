// SPDX-License-Identifier: Apache-2.0
#include "audit/numerics/stability_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <string>
#include <vector>

#include <noli/errors.h>
#include "audit/ccd/audit_report.h"

namespace noli::audit {
namespace {

const char* stability_verdict(const StabilityReport& report) {
  if (report.findings() > 0) return "finding";
  return report.complete ? "no_finding" : "undecided";
}

Json stability_point_json(const StabilityPoint& point) {
  return {{"value", point.value},
          {"exit_code", point.exit_code},
          {"holds", point.gives.empty()},
          {"gives", point.gives.empty() ? Json(nullptr) : Json(point.gives)},
          {"message", point.message},
          {"energy_error", or_null(point.energy_error)},
          {"momentum_error", or_null(point.momentum_error)},
          {"findings", point.findings},
          {"saved", point.saved.empty() ? Json(nullptr) : Json(point.saved.string())}};
}

Json stability_row_json(const StabilityResult& row) {
  Json json = {{"row", row.name}, {"varied", row.varied}, {"contact", row.contact}};
  const std::size_t first = row.first_to_give();
  json["holds_up_to"] = first > 0 ? Json(row.points[first - 1].value) : Json(nullptr);
  json["gives_first"] = first < row.points.size() ? Json(row.points[first].gives) : Json(nullptr);
  json["at"] = first < row.points.size() ? Json(row.points[first].value) : Json(nullptr);
  json["exit_code"] = first < row.points.size() ? Json(row.points[first].exit_code) : Json(nullptr);
  json["points"] = Json::array();
  for (const StabilityPoint& point : row.points) json["points"].push_back(stability_point_json(point));
  return json;
}

std::string stability_table(const StabilityReport& report) {
  std::vector<TableRow> rows = {{"row", "varied", "up to", "energy", "momentum", "gives first", "at", "exit"}};
  for (const StabilityResult& row : report.rows) {
    const std::size_t first = row.first_to_give();
    const bool gives = first < row.points.size();
    double energy = 0, momentum = 0;
    for (std::size_t i = 0; i < first; ++i) {
      energy = std::max(energy, row.points[i].energy_error.value_or(0));
      momentum = std::max(momentum, row.points[i].momentum_error.value_or(0));
    }
    rows.push_back({row.name, row.varied, first > 0 ? fmt::format("{:g}", row.points[first - 1].value) : "-",
                    energy > 0 ? fmt::format("{:.1e}", energy) : "-",
                    momentum > 0 ? fmt::format("{:.0e}", momentum) : "-", gives ? row.points[first].gives : "-",
                    gives ? fmt::format("{:g}", row.points[first].value) : "-",
                    gives ? std::to_string(row.points[first].exit_code) : "-"});
  }
  return table_text(rows, 2);
}

}  // namespace

Json stability_json(const StabilityReport& report, double seconds) {
  Json json = {{"verdict", stability_verdict(report)},
               {"points", report.points()},
               {"held", report.held()},
               {"findings", report.findings()},
               {"complete", report.complete},
               {"most_energy_error", most_energy_error},
               {"most_momentum_error", most_momentum_error}};
  json["rows"] = Json::array();
  Json times = Json::array();
  for (const StabilityResult& row : report.rows) {
    json["rows"].push_back(stability_row_json(row));
    Json of_points = Json::array();
    for (const StabilityPoint& point : row.points) of_points.push_back(point.seconds);
    times.push_back({{"row", row.name}, {"seconds", of_points}});
  }
  json["timing"] = {{"seconds", seconds}, {"rows", times}};
  return json;
}

report::Answer stability_answer(const Json& json, const StabilityReport& report, double seconds) {
  report::Answer answer(json, {"rows", "points", "held", "findings", "complete"});
  std::string& text = answer.text;
  text += stability_table(report);
  const auto out = std::back_inserter(text);
  for (const StabilityResult& row : report.rows) {
    for (const StabilityPoint& point : row.points) {
      if (!point.gives.empty()) {
        fmt::format_to(out, "{}, {:g}: {}, exit {}: {}\n", row.name, point.value, point.gives, point.exit_code,
                       point.message);
      }
      for (const std::string& words : point.findings) {
        fmt::format_to(out, "finding: {}, {:g}: {}; its input is in {}\n", row.name, point.value, words,
                       on_one_line(point.saved.string()));
      }
    }
  }
  fmt::format_to(out, "Time: {:.1f} s.\n", seconds);
  return answer;
}

}  // namespace noli::audit
