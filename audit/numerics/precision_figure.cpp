// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "audit/numerics/precision_report.h"
#include "report/figures/figure_axes.h"
#include "report/figures/svg.h"

namespace noli::audit {
namespace {

using report::Anchor;
using report::linear_ticks;
using report::Scale;
using report::Svg;
using report::Tick;

using Point = Svg::Point;

constexpr double left = 96, right = 700;
constexpr double first_top = 50, panel_height = 200, panel_stride = 270;
constexpr std::size_t most_columns = 600;  ///< about one per pixel
constexpr const char* grey = "#444444";

/// Absolute values, one for each window. The figure shows the greatest of each column.
struct Curve {
  std::string name;
  std::vector<double> values;
};

/// Maps times and decimal logarithms of values to pixels. The axis ends at whole powers of ten.
struct LogField {
  Scale time, power;

  LogField(const std::vector<double>& times, const std::vector<Curve>& curves, double bottom, double top)
      : time{0, times.back(), left, right}, power{0, 1, bottom, top} {
    double low = HUGE_VAL, high = 0;
    for (const Curve& curve : curves) {
      for (const double x : curve.values) {
        if (!(x > 0)) continue;
        low = std::min(low, x);
        high = std::max(high, x);
      }
    }
    if (high == 0) return;
    power.low = std::floor(std::log10(low));
    power.high = std::max(std::ceil(std::log10(high)), power.low + 1);
  }

  void axes(Svg& svg, const std::string& words) const {
    const double stride = std::max(1.0, std::ceil((power.high - power.low) / 8));
    for (double p = power.low; p <= power.high; p += stride) {
      svg.line({left, power(p)}, {right, power(p)}, "#eeeeee");
      svg.line({left - 5, power(p)}, {left, power(p)}, grey);
      svg.text({left - 9, power(p) + 4.5}, fmt::format("1e{:g}", p), Anchor::end);
    }
    for (const Tick& tick : linear_ticks(time.low, time.high, 8)) {
      svg.line({time(tick.value), power.from}, {time(tick.value), power.from + 5}, grey);
      svg.text({time(tick.value), power.from + 20}, tick.words, Anchor::middle);
    }
    svg.frame({left, power.to}, {right - left, power.from - power.to}, grey);
    svg.text({0.5 * (left + right), power.from + 42}, "time [s]", Anchor::middle);
    svg.text({left - 68, 0.5 * (power.from + power.to)}, words, Anchor::middle, true);
  }
};

/// Zero has no logarithm: the line begins at the first value that is not zero, and later zeros lie on the border.
std::vector<Point> points_of(const LogField& field, const std::vector<double>& times, const Curve& curve) {
  const std::size_t n = curve.values.size(), stride = (n + most_columns - 1) / most_columns;
  std::vector<Point> points;
  for (std::size_t begin = 0; begin < n; begin += stride) {
    const auto first = curve.values.begin() + static_cast<std::ptrdiff_t>(begin);
    const auto greatest =
        std::max_element(first, curve.values.begin() + static_cast<std::ptrdiff_t>(std::min(n, begin + stride)));
    if (!(*greatest > 0) && points.empty()) continue;
    const double power = *greatest > 0 ? std::log10(*greatest) : field.power.low;
    points.push_back(
        {field.time(times[static_cast<std::size_t>(greatest - curve.values.begin())]), field.power(power)});
  }
  return points;
}

struct Panel {
  std::string words;
  std::vector<Curve> curves;
};

void draw(Svg& svg, const std::vector<double>& times, const Panel& panel, double top) {
  static constexpr const char* colours[] = {"#1b6ca8", "#c8553d", "#2e8b57", "#8e5ea2", "#c99a1c", "#5f6b73"};
  const LogField field(times, panel.curves, top + panel_height, top);
  field.axes(svg, panel.words);
  for (std::size_t i = 0; i < panel.curves.size(); ++i) {
    const char* const stroke = colours[i % std::size(colours)];
    const std::vector<Point> points = points_of(field, times, panel.curves[i]);
    if (!points.empty()) svg.polyline(points, stroke, 1.6);
    const double y = top + 14 + 20 * static_cast<double>(i);
    svg.line({right + 20, y - 4}, {right + 44, y - 4}, stroke);
    svg.text({right + 52, y}, panel.curves[i].name + (points.empty() ? ": 0" : ""));
  }
}

/// A quantity in which double differs from the other precisions.
struct Quantity {
  const char* words;
  double Drift::*drift;
};
constexpr Quantity quantities[] = {{"position, greatest [m]", &Drift::position},
                                   {"energy [J]", &Drift::energy},
                                   {"momentum [N s]", &Drift::momentum},
                                   {"angular mom. [N m s]", &Drift::angular_momentum}};

/// A curve for each precision except the first, which is double itself.
Panel drifts(const PrecisionOutcome& outcome, const Quantity& quantity) {
  Panel panel{quantity.words, {}};
  for (std::size_t i = 1; i < outcome.runs.size(); ++i) {
    const std::vector<Drift>& drifts = outcome.runs[i].drifts;
    Curve curve{fmt::format("double - {} bits", outcome.runs[i].arithmetic.bits), {}};
    for (std::size_t k = 0; k < std::min(drifts.size(), outcome.energies.size()); ++k) {
      curve.values.push_back(std::abs(drifts[k].*quantity.drift));
    }
    panel.curves.push_back(std::move(curve));
  }
  return panel;
}

Panel energy_errors(const PrecisionOutcome& outcome) {
  Curve truncation{"truncation", {}}, rounding{"rounding", {}};
  for (const EnergyError& error : outcome.energies) {
    truncation.values.push_back(std::abs(error.truncation));
    rounding.values.push_back(std::abs(error.rounding));
  }
  return {"energy error [J]", {truncation, rounding}};
}

}  // namespace

std::string precision_svg(const PrecisionOutcome& outcome, const std::string& title) {
  const std::string words = title + ": double against other precisions";
  std::vector<Panel> panels;
  for (const Quantity& quantity : quantities) panels.push_back(drifts(outcome, quantity));
  panels.push_back(energy_errors(outcome));
  Svg svg(900, first_top + static_cast<double>(panels.size()) * panel_stride, words);
  svg.text({left, 30}, words);
  std::vector<double> times;
  for (const EnergyError& error : outcome.energies) times.push_back(error.time);
  if (times.empty()) return svg.finish();
  const auto& acts = outcome.runs.back().changes.acts.first;
  double top = first_top;
  for (const Panel& panel : panels) {
    draw(svg, times, panel, top);
    if (acts) {
      const double x = Scale{0, times.back(), left, right}(acts->time);
      svg.line({x, top + panel_height}, {x, top}, grey, "2 4");
    }
    top += panel_stride;
  }
  if (acts) {
    svg.text({right + 20, first_top + panel_height - 22}, "dotted: the order");
    svg.text({right + 20, first_top + panel_height - 4}, "of events changes");
  }
  return svg.finish();
}

}  // namespace noli::audit
