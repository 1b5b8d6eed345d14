// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <functional>

#include "report/figures/figure_axes.h"
#include "report/figures/run_figure.h"

namespace noli::report {
namespace {

using integrator::ForceKind;
using Point = Svg::Point;

constexpr double page_width = 900, field_left = 96, field_right = 700;
constexpr std::size_t most_columns = 600;  ///< about one for each pixel

/// A page with its title.
Svg begin_page(const FigureData& data, const std::string& what, double height) {
  const std::string title = data.title.empty() ? what : data.title + ": " + what;
  Svg svg(page_width, height, title);
  svg.text({field_left, 30}, title);
  return svg;
}

Scale time_scale(const FigureData& data) {
  return {data.windows.front().begin, data.windows.back().row.time, field_left, field_right};
}

// --- steps -----------------------------------------------------------------------------------------------------------

/// Windows that are drawn as one.
struct Column {
  double begin, end;
  StepHistogram steps;
};

std::vector<Column> columns_of(const FigureData& data) {
  const std::size_t stride = (data.windows.size() + most_columns - 1) / most_columns;
  std::vector<Column> columns;
  for (std::size_t i = 0; i < data.windows.size(); ++i) {
    const auto& [begin, row] = data.windows[i];
    if (i % stride == 0) columns.push_back({begin, row.time, {}});
    columns.back().end = row.time;
    columns.back().steps.add(row.steps);
  }
  return columns;
}

/// How many per cent of the time of free vertices are in this bin and those below it.
double percent_up_to(const StepHistogram& steps, std::int64_t bin) {
  std::uint64_t sum = 0;
  for (const auto& b : steps.bins) sum += b.number <= bin ? b.ticks : 0;
  return steps.bins.empty() ? 0 : 100 * (static_cast<double>(sum) / static_cast<double>(steps.ticks()));
}

/// The bins that have a colour each. What is below the first of them is nowhere as much as a pixel, and drawn with it.
struct Shown {
  std::int64_t first = 0, last = 0;

  explicit Shown(const std::vector<Column>& columns) {
    constexpr double visible = 0.1;  // per cent
    StepHistogram all;
    for (const Column& column : columns) all.add(column.steps);
    if (all.bins.empty()) return;
    last = all.bins.back().number;
    first = last;
    for (const Column& column : columns) {
      while (percent_up_to(column.steps, first - 1) > visible) --first;
    }
  }

  std::string fill(std::int64_t bin) const {
    return graded_colour(first == last ? 0.5 : static_cast<double>(bin - first) / static_cast<double>(last - first));
  }
};

/// The area below a line that has a step at the end of each column.
std::vector<Point> area(const Field& field, const std::vector<Column>& columns, std::int64_t bin) {
  std::vector<Point> points = {{field.x.to, field.y(0)}, {field.x.from, field.y(0)}};
  for (const Column& column : columns) {
    const double y = field.y(percent_up_to(column.steps, bin));
    if (points.back()[1] == y) {
      points.back()[0] = field.x(column.end);
      continue;
    }
    points.push_back({field.x(column.begin), y});
    points.push_back({field.x(column.end), y});
  }
  return points;
}

void colour_bar(Svg& svg, const Shown& shown, const Field& field) {
  const double low = bin_begin(shown.first), high = bin_begin(shown.last + 1);
  const Scale scale{std::log10(low), std::log10(high), field.y.from, field.y.to};
  constexpr double x = field_right + 40, thick = 22;
  for (std::int64_t bin = shown.first; bin <= shown.last; ++bin) {
    const double bottom = scale(std::log10(bin_begin(bin))), top = scale(std::log10(bin_begin(bin + 1)));
    svg.rectangle({x, top}, {thick, bottom - top + (bin > shown.first ? 0.5 : 0)}, shown.fill(bin));
  }
  svg.frame({x, field.y.to}, {thick, field.y.from - field.y.to}, "#444444");
  for (const Tick& tick : logarithmic_ticks(low, high)) {
    const double y = scale(std::log10(tick.value));
    svg.line({x + thick, y}, {x + thick + 5, y}, "#444444");
    svg.text({x + thick + 9, y + 4.5}, tick.words);
  }
  svg.text({x + thick + 86, 0.5 * (field.y.from + field.y.to)}, "step [s]", Anchor::middle, true);
}

std::string steps(const FigureData& data) {
  const std::vector<Column> columns = columns_of(data);
  const bool free = std::any_of(columns.begin(), columns.end(), [](const Column& c) { return !c.steps.bins.empty(); });
  Svg svg = begin_page(data, "steps of vertices", 470);
  const Field field{time_scale(data), {0, 100, 400, 50}};
  if (free) {
    const Shown shown(columns);
    // From the last to the first, so that each covers what is not its own of the one before.
    for (std::int64_t bin = shown.last; bin >= shown.first; --bin) {
      svg.polygon(area(field, columns, bin), shown.fill(bin));
    }
    svg.line({field.x.from, field.y(50)}, {field.x.to, field.y(50)}, "#666666", "2 4");
    colour_bar(svg, shown, field);
  }
  field.axes(svg, "time [s]", "free vertices [%]");
  return svg.finish();
}

// --- curves ----------------------------------------------------------------------------------------------------------

struct Curve {
  std::string name;
  std::vector<double> values;  ///< one for each window
};

/// Where there are more windows than columns, the extremes of each column in their order.
std::vector<Point> points_of(const FigureData& data, const Curve& curve, const Field& field) {
  const std::size_t n = curve.values.size(), stride = (n + most_columns - 1) / most_columns;
  std::vector<Point> points;
  for (std::size_t begin = 0; begin < n; begin += stride) {
    const auto first = curve.values.begin() + static_cast<std::ptrdiff_t>(begin);
    const auto end = curve.values.begin() + static_cast<std::ptrdiff_t>(std::min(n, begin + stride));
    const auto [low, high] = std::minmax_element(first, end);
    for (const auto at : {std::min(low, high), std::max(low, high)}) {
      const double t = data.windows[static_cast<std::size_t>(at - curve.values.begin())].row.time;
      points.push_back({field.x(t), field.y(*at)});
    }
  }
  return points;
}

/// A little room above and below.
Scale value_scale(const std::vector<Curve>& curves, double from, double to) {
  double low = 0, high = 0;
  for (const Curve& curve : curves) {
    const auto [least, greatest] = std::minmax_element(curve.values.begin(), curve.values.end());
    low = std::min(low, *least);
    high = std::max(high, *greatest);
  }
  const double room = high > low ? 0.04 * (high - low) : 1;
  return {low - (low < 0 || high == low ? room : 0), high + room, from, to};
}

void draw(Svg& svg, const FigureData& data, const std::vector<Curve>& curves, const Field& field,
          const std::string& y_words) {
  static constexpr const char* colours[] = {"#1b6ca8", "#c8553d", "#2e8b57", "#8e5ea2", "#c99a1c",
                                            "#5f6b73", "#17a2a2", "#d0679d", "#222222"};
  svg.line({field.x.from, field.y(0)}, {field.x.to, field.y(0)}, "#dddddd");
  for (std::size_t i = 0; i < curves.size(); ++i) {
    const char* const stroke = colours[i % std::size(colours)];
    svg.polyline(points_of(data, curves[i], field), stroke, 1.6);
    const double y = field.y.to + 14 + 20 * static_cast<double>(i);
    svg.line({field_right + 20, y - 4}, {field_right + 44, y - 4}, stroke);
    svg.text({field_right + 52, y}, curves[i].name);
  }
  field.axes(svg, "time [s]", y_words);
}

Curve curve_of(const FigureData& data, const std::string& name, const std::function<double(const SeriesRow&)>& value) {
  Curve curve{name, {}};
  for (const auto& window : data.windows) curve.values.push_back(value(window.row));
  return curve;
}

bool is_zero(const Curve& curve) {
  return std::all_of(curve.values.begin(), curve.values.end(), [](double x) { return x == 0; });
}

/// Those that are there: a scene without hinges has no potential of theirs.
std::vector<Curve> energies(const FigureData& data) {
  std::vector<Curve> curves;
  curves.push_back(
      curve_of(data, "total", [](const SeriesRow& row) { return row.kinetic_mean + row.potential_in_all(); }));
  curves.push_back(curve_of(data, "kinetic", [](const SeriesRow& row) { return row.kinetic_mean; }));
  for (std::size_t k = 0; k < integrator::force_kinds; ++k) {
    Curve curve = curve_of(data, std::string(name(static_cast<ForceKind>(k))),
                           [k](const SeriesRow& row) { return row.potential[k]; });
    if (!is_zero(curve)) curves.push_back(std::move(curve));
  }
  const auto add_sum = [&](const char* name, const auto& of_window) {
    double sum = 0;
    Curve curve = curve_of(data, name, [&](const SeriesRow& row) { return sum += of_window(row); });
    if (!is_zero(curve)) curves.push_back(std::move(curve));
  };
  add_sum("damping and friction", [](const SeriesRow& row) { return row.damping_in_all(); });
  add_sum("restitution", [](const SeriesRow& row) { return row.restitution_work; });
  add_sum("scripts", [](const SeriesRow& row) { return row.held_in_all(); });
  add_sum("integration", [](const SeriesRow& row) { return row.integration; });
  return curves;
}

std::string energy(const FigureData& data) {
  Svg svg = begin_page(data, "energy", 470);
  const std::vector<Curve> curves = energies(data);
  draw(svg, data, curves, {time_scale(data), value_scale(curves, 400, 50)}, "energy [J]");
  return svg.finish();
}

std::string momentum(const FigureData& data) {
  Svg svg = begin_page(data, "momentum", 790);
  std::vector<Curve> linear, angular;
  static constexpr const char* axes[] = {"x", "y", "z"};
  for (std::size_t k = 0; k < 3; ++k) {
    if (k < data.dimension)
      linear.push_back(curve_of(data, axes[k], [k](const SeriesRow& row) { return row.momentum[k]; }));
    if (data.dimension == 2 && k < 2) continue;  // a plane has moments about z alone
    angular.push_back(curve_of(data, axes[k], [k](const SeriesRow& row) { return row.angular_momentum[k]; }));
  }
  draw(svg, data, linear, {time_scale(data), value_scale(linear, 360, 50)}, "momentum [N s]");
  draw(svg, data, angular, {time_scale(data), value_scale(angular, 730, 420)}, "angular momentum [N m s]");
  return svg.finish();
}

}  // namespace

FigureWriters svg_writers() { return {steps, energy, momentum}; }

}  // namespace noli::report
