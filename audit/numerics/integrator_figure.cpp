// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include <noli/errors.h>
#include "audit/numerics/integrator_report.h"
#include "report/figures/figure_axes.h"
#include "report/figures/svg.h"

namespace noli::audit {
namespace {

using report::Anchor;
using report::logarithmic_scale;
using report::logarithmic_ticks;
using report::LogScale;
using report::Svg;
using report::Tick;

constexpr const char* axis_grey = "#444444";
constexpr double panel_size_x = 380, panel_size_y = 300, gap_x = 110, gap_y = 110, margin_left = 96, margin_top = 84;

constexpr std::size_t panel_columns = 2;

struct ErrorPanel {
  const char* words;
  double IntegratorErrors::*error;
};
constexpr std::array<ErrorPanel, 4> error_panels = {
    {{"error of the trajectory [m]", &IntegratorErrors::trajectory},
     {"error of energy / largest kinetic", &IntegratorErrors::energy},
     {"error of momentum / largest", &IntegratorErrors::momentum},
     {"error of angular momentum / largest", &IntegratorErrors::angular_momentum}}};

struct MethodLook {
  const char *method, *colour, *words;
};

/// Precondition: the method is one of the four below.
const MethodLook& look_of(const MethodResult& result) {
  static constexpr MethodLook looks[] = {{"own", "#2e8b57", "a step for each force"},
                                         {"grouped", "#1b6ca8", "steps in groups"},
                                         {"verlet", "#c8553d", "Verlet, one step for all"},
                                         {"euler", "#c99a1c", "implicit Euler"}};
  return *std::ranges::find(looks, result.method, &MethodLook::method);
}

void axes(Svg& svg, const LogScale& x, const LogScale& y, const char* words) {
  for (const Tick& tick : logarithmic_ticks(x.low, x.high)) {
    svg.line({x(tick.value), y.to}, {x(tick.value), y.from}, "#eeeeee");
    svg.line({x(tick.value), y.from}, {x(tick.value), y.from + 5}, axis_grey);
    svg.text({x(tick.value), y.from + 20}, tick.words, Anchor::middle);
  }
  for (const Tick& tick : logarithmic_ticks(y.low, y.high)) {
    svg.line({x.from, y(tick.value)}, {x.to, y(tick.value)}, "#eeeeee");
    svg.line({x.from - 5, y(tick.value)}, {x.from, y(tick.value)}, axis_grey);
    svg.text({x.from - 9, y(tick.value) + 4.5}, tick.words, Anchor::end);
  }
  svg.frame({x.from, y.to}, {x.to - x.from, y.from - y.to}, axis_grey);
  svg.text({0.5 * (x.from + x.to), y.from + 42}, "run time [s]", Anchor::middle);
  svg.text({x.from - 68, 0.5 * (y.from + y.to)}, words, Anchor::middle, true);
}

void panel(Svg& svg, const IntegratorResult& result, const ErrorPanel& quantity, Svg::Point corner) {
  std::vector<double> times, errors;
  for (const MethodResult& method : result.methods) {
    for (const IntegratorPoint& point : method.points) {
      if (!point.finite) continue;
      times.push_back(point.seconds);
      errors.push_back(point.errors.*quantity.error);
    }
  }
  const LogScale x = logarithmic_scale(times, corner[0], corner[0] + panel_size_x);
  const LogScale y = logarithmic_scale(errors, corner[1] + panel_size_y, corner[1]);
  axes(svg, x, y, quantity.words);
  for (const MethodResult& method : result.methods) {
    std::vector<Svg::Point> points;
    for (const IntegratorPoint& point : method.points) {
      if (point.finite) points.push_back({x(point.seconds), y(point.errors.*quantity.error)});
    }
    const char* const colour = look_of(method).colour;
    svg.polyline(points, colour, 1.6);
    for (const Svg::Point& at : points) svg.rectangle({at[0] - 3.5, at[1] - 3.5}, {7, 7}, colour);
  }
}

void legend(Svg& svg, const IntegratorResults& results) {
  double x = margin_left;
  for (const MethodResult& method : results.front().methods) {
    svg.rectangle({x, 42}, {9, 9}, look_of(method).colour);
    svg.text({x + 15, 51}, look_of(method).words);
    x += 215;
  }
}

}  // namespace

std::string integrator_svg(const IntegratorResults& results) {
  const std::string title = "Integration: error against run time";
  const std::size_t rows = (error_panels.size() + panel_columns - 1) / panel_columns;  // per scene
  Svg svg(margin_left + static_cast<double>(panel_columns) * (panel_size_x + gap_x) - gap_x + 30,
          margin_top + static_cast<double>(rows * results.size()) * (panel_size_y + gap_y), title);
  svg.text({margin_left, 28}, title);
  if (!results.empty()) legend(svg, results);
  for (std::size_t i = 0; i < results.size(); ++i) {
    const double y = margin_top + static_cast<double>(rows * i) * (panel_size_y + gap_y);
    svg.text({margin_left, y - 8}, on_one_line(results[i].title));
    for (std::size_t k = 0; k < error_panels.size(); ++k) {
      const std::size_t whole_rows = k / panel_columns;
      const auto column = static_cast<double>(k % panel_columns), row = static_cast<double>(whole_rows);
      panel(svg, results[i], error_panels[k],
            {margin_left + column * (panel_size_x + gap_x), y + row * (panel_size_y + gap_y)});
    }
  }
  return svg.finish();
}

}  // namespace noli::audit
