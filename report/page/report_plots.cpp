// SPDX-License-Identifier: Apache-2.0
#include "report/page/report_plots.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "integrator/force.h"

namespace noli::report {
namespace {

constexpr std::size_t most_points = 2000;

/// Rows that are one point.
using Rows = std::span<const SeriesRow>;
using Value = std::function<std::optional<double>(Rows)>;

class Plots {
 public:
  explicit Plots(Rows rows) {
    const std::size_t together = (rows.size() + most_points - 1) / most_points;
    for (std::size_t i = 0; i < rows.size(); i += together) {
      points_.push_back(rows.subspan(i, std::min(together, rows.size() - i)));
      times_.push_back(points_.back().back().time);
    }
  }

  void begin(const std::string& title, const std::string& y, bool log) {
    plots_.push_back(
        {{"title", title}, {"x", "time [s]"}, {"y", y}, {"log", log}, {"times", times_}, {"series", Json::array()}});
  }
  /// A series of which no value is there, or not 0, is left out.
  void add(const std::string& name, const Value& value) {
    Json values = Json::array();
    bool any = false;
    for (const Rows point : points_) {
      const std::optional<double> number = value(point);
      any = any || (number && *number != 0);
      values.push_back(number && std::isfinite(*number) ? Json(*number) : Json(nullptr));
    }
    if (any) plots_.back()["series"].push_back({{"name", name}, {"values", values}});
  }
  /// Those that have a series.
  Json take() {
    std::erase_if(plots_, [](const Json& plot) { return plot["series"].empty(); });
    return std::move(plots_);
  }

 private:
  std::vector<Rows> points_;
  std::vector<double> times_;
  std::vector<Json> plots_;
};

/// Of the last row.
template <class Of>
Value last(const Of& of) {
  return [of](Rows rows) { return std::optional<double>(of(rows.back())); };
}

/// The least one that is above 0.
template <class Of>
Value least(const Of& of) {
  return [of](Rows rows) {
    std::optional<double> result;
    for (const SeriesRow& row : rows) {
      const double x = of(row);
      if (x > 0 && (!result || x < *result)) result = x;
    }
    return result;
  };
}

template <class Of>
Value sum(const Of& of) {
  return [of](Rows rows) {
    double result = 0;
    for (const SeriesRow& row : rows) result += of(row);
    return std::optional<double>(result);
  };
}

void add_energy(Plots& plots) {
  plots.begin("Energy", "energy [J]", false);
  plots.add("all", last([](const SeriesRow& r) { return r.kinetic_mean + r.potential_in_all(); }));
  plots.add("kinetic", last([](const SeriesRow& r) { return r.kinetic_mean; }));
  for (std::size_t k = 0; k < integrator::force_kinds; ++k) {
    plots.add(std::string(name(static_cast<integrator::ForceKind>(k))),
              last([k](const SeriesRow& r) { return r.potential[k]; }));
  }
}

void add_momentum(Plots& plots) {
  constexpr std::array axes = {"x", "y", "z"};
  plots.begin("Momentum", "momentum [N s]", false);
  for (std::size_t k = 0; k < 3; ++k) plots.add(axes[k], last([k](const SeriesRow& r) { return r.momentum[k]; }));
}

void add_gap(Plots& plots) {
  plots.begin("Nearest at an impulse of contact", "distance [m]", true);
  plots.add("distance", least([](const SeriesRow& r) { return r.nearest.layer > 0 ? r.nearest.distance : 0; }));
  plots.begin("Deepest layer of contact", "layer", false);
  plots.add("layer", [](Rows rows) {
    double deepest = 0;
    for (const SeriesRow& row : rows) deepest = std::max(deepest, static_cast<double>(row.deepest.layer));
    return std::optional(deepest);
  });
}

void add_steps(Plots& plots) {
  plots.begin("Smallest step of a free vertex", "step [s]", true);
  plots.add("step", least([](const SeriesRow& r) { return r.steps.smallest; }));
}

void add_events(Plots& plots) {
  plots.begin("Events", "events", true);
  for (std::size_t k = 0; k < integrator::force_kinds; ++k) {
    plots.add(std::string(name(static_cast<integrator::ForceKind>(k))),
              sum([k](const SeriesRow& r) { return static_cast<double>(r.events[k]); }));
  }
}

}  // namespace

Json report_plots(std::span<const SeriesRow> rows) {
  Plots plots(rows);
  add_energy(plots);
  add_gap(plots);
  add_steps(plots);
  add_momentum(plots);
  add_events(plots);
  return plots.take();
}

}  // namespace noli::report
