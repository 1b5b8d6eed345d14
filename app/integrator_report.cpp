// SPDX-License-Identifier: Apache-2.0
#include "noli/app/integrator_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "noli/app/audit_report.h"
#include "noli/app/figure_axes.h"
#include "noli/trajectory/error.h"

namespace noli::app {
namespace {

using audit::IntegratorErrors;
using audit::IntegratorPoint;
using audit::IntegratorResult;
using audit::MethodResult;

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

std::string number(double x) { return fmt::format("{:.2g}", x); }

/// How many times smaller the error of the trajectory became, as a power of the step's factor.
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
    const auto of = [&](double error) { return point.finite ? number(error) : std::string("not finite"); };
    rows.push_back({method.method + (point.converged ? "" : " (not solved)"), fmt::format("{:g}", point.factor),
                    number(point.least_step), std::to_string(point.events), of(point.errors.trajectory),
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
                 number(u.trajectory), number(u.energy), number(u.momentum), number(u.angular_momentum));
  if (!result.plain) {
    text += "With damping, scripts or contact `verlet` is this integrator with one step for all forces.\n";
  }
}

// --- picture ---------------------------------------------------------------------------------------------------------

constexpr const char* grey = "#444444";
constexpr double panel_width = 380, panel_height = 300, gap_x = 110, gap_y = 110, left = 96, top = 84;

struct Quantity {
  const char* words;
  double IntegratorErrors::*error;
};
constexpr std::array<Quantity, 2> quantities = {{{"error of the trajectory [m]", &IntegratorErrors::trajectory},
                                                 {"error of energy / largest kinetic", &IntegratorErrors::energy}}};

const char* colour_of(const std::string& method) {
  if (method == "own") return "#2e8b57";
  if (method == "grouped") return "#1b6ca8";
  return method == "verlet" ? "#c8553d" : "#c99a1c";
}

const char* words_of(const std::string& method) {
  if (method == "own") return "a step for each force";
  if (method == "grouped") return "steps in groups";
  return method == "verlet" ? "Verlet, one step for all" : "implicit Euler";
}

void axes(Svg& svg, const LogScale& x, const LogScale& y, const char* words) {
  for (const Tick& tick : logarithmic_ticks(x.low, x.high)) {
    svg.line({x(tick.value), y.to}, {x(tick.value), y.from}, "#eeeeee");
    svg.line({x(tick.value), y.from}, {x(tick.value), y.from + 5}, grey);
    svg.text({x(tick.value), y.from + 20}, tick.words, Anchor::middle);
  }
  for (const Tick& tick : logarithmic_ticks(y.low, y.high)) {
    svg.line({x.from, y(tick.value)}, {x.to, y(tick.value)}, "#eeeeee");
    svg.line({x.from - 5, y(tick.value)}, {x.from, y(tick.value)}, grey);
    svg.text({x.from - 9, y(tick.value) + 4.5}, tick.words, Anchor::end);
  }
  svg.frame({x.from, y.to}, {x.to - x.from, y.from - y.to}, grey);
  svg.text({0.5 * (x.from + x.to), y.from + 42}, "run time [s]", Anchor::middle);
  svg.text({x.from - 68, 0.5 * (y.from + y.to)}, words, Anchor::middle, true);
}

void panel(Svg& svg, const IntegratorResult& result, const Quantity& quantity, Svg::Point corner) {
  std::vector<double> times, errors;
  for (const MethodResult& method : result.methods) {
    for (const IntegratorPoint& point : method.points) {
      if (!point.finite) continue;
      times.push_back(point.seconds);
      errors.push_back(point.errors.*quantity.error);
    }
  }
  const LogScale x = logarithmic_scale(times, corner[0], corner[0] + panel_width);
  const LogScale y = logarithmic_scale(errors, corner[1] + panel_height, corner[1]);
  axes(svg, x, y, quantity.words);
  for (const MethodResult& method : result.methods) {
    std::vector<Svg::Point> points;
    for (const IntegratorPoint& point : method.points) {
      if (point.finite) points.push_back({x(point.seconds), y(point.errors.*quantity.error)});
    }
    svg.polyline(points, colour_of(method.method), 1.6);
    for (const Svg::Point& at : points) svg.rectangle({at[0] - 3.5, at[1] - 3.5}, {7, 7}, colour_of(method.method));
  }
}

void legend(Svg& svg, const IntegratorResults& results) {
  double x = left;
  for (const MethodResult& method : results.front().methods) {
    svg.rectangle({x, 42}, {9, 9}, colour_of(method.method));
    svg.text({x + 15, 51}, words_of(method.method));
    x += 215;
  }
}

}  // namespace

const char* integrator_verdict(const IntegratorResults& results) {
  const auto finding = [](const IntegratorResult& result) { return result.has_finding(); };
  const auto complete = [](const IntegratorResult& result) { return result.complete; };
  if (std::any_of(results.begin(), results.end(), finding)) return "finding";
  return std::all_of(results.begin(), results.end(), complete) && !results.empty() ? "measured" : "undecided";
}

std::string integrator_text(const IntegratorResults& results) {
  std::size_t runs = 0;
  for (const IntegratorResult& result : results) {
    for (const MethodResult& method : result.methods) runs += method.points.size();
  }
  std::string text = fmt::format("verdict {} scenes {} runs {}\n", integrator_verdict(results), results.size(), runs);
  for (const IntegratorResult& result : results) append_result(result, text);
  return text;
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

std::string integrator_svg(const IntegratorResults& results) {
  const std::string title = "Integration: error against run time";
  const double rows = static_cast<double>(results.size());
  Svg svg(left + 2 * panel_width + gap_x + 30, top + rows * (panel_height + gap_y), title);
  svg.text({left, 28}, title);
  if (!results.empty()) legend(svg, results);
  for (std::size_t i = 0; i < results.size(); ++i) {
    const double y = top + static_cast<double>(i) * (panel_height + gap_y);
    svg.text({left, y - 8}, on_one_line(results[i].title));
    for (std::size_t k = 0; k < quantities.size(); ++k) {
      panel(svg, results[i], quantities[k], {left + static_cast<double>(k) * (panel_width + gap_x), y});
    }
  }
  return svg.finish();
}

}  // namespace noli::app
