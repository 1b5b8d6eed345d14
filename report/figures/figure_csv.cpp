// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "certify/json.h"
#include "report/figures/run_figure.h"

namespace noli::report {
namespace {

using integrator::ForceKind;

/// Numbers in columns: those that a window puts into them, one after the other.
class Table {
 public:
  void name(const std::string& column) { out_ += (out_.empty() ? "" : ",") + column; }
  void begin_line() { out_ += '\n'; }
  void number(double x) { out_ += (out_.back() == '\n' ? "" : ",") + digits17(x); }
  std::string finish() { return std::move(out_) + '\n'; }

 private:
  std::string out_;
};

std::string of(const char* what, std::size_t kind) {
  return fmt::format("{}_{} [J]", what, name(static_cast<ForceKind>(kind)));
}

std::string steps_table(const FigureData& data) {
  StepHistogram all;
  for (const auto& window : data.windows) all.add(window.row.steps);
  Table table;
  for (const char* column : {"begin [s]", "end [s]", "smallest_step [s]", "percentile_1_step [s]", "median_step [s]"})
    table.name(column);
  for (const auto& bin : all.bins) {
    table.name(fmt::format("{:.4g}..{:.4g} s [%]", bin_begin(bin.number), bin_begin(bin.number + 1)));
  }
  for (const auto& window : data.windows) {
    const StepHistogram& here = window.row.steps;
    table.begin_line();
    table.number(window.begin);
    table.number(window.row.time);
    table.number(here.smallest);
    for (const double share : {0.01, 0.5}) table.number(here.bins.empty() ? 0 : here.quantile(share));
    const double ticks = static_cast<double>(here.ticks());
    auto next = here.bins.begin();
    for (const auto& bin : all.bins) {
      const bool there = next != here.bins.end() && next->number == bin.number;
      table.number(there ? 100 * (static_cast<double>((next++)->ticks) / ticks) : 0);
    }
  }
  return table.finish();
}

std::string energy_table(const FigureData& data) {
  Table table;
  for (const char* column : {"time [s]", "kinetic [J]", "kinetic_mean [J]"}) table.name(column);
  for (const char* what : {"potential", "work", "damping_work", "held_work"}) {
    for (std::size_t k = 0; k < integrator::force_kinds; ++k) table.name(of(what, k));
  }
  for (const char* column : {"restitution_work [J]", "held_ahead [J]", "integration [J]"}) table.name(column);
  const SeriesRow& first = data.windows.front().row;
  for (std::size_t m = 0; m < first.contact_work.size(); ++m) {
    for (const char* what : {"work", "friction_work", "restitution_work"}) {
      table.name(fmt::format("{}_of_material_{} [J]", what, m));
    }
  }
  for (std::size_t s = 0; s < first.script_work.size(); ++s) table.name(fmt::format("script_work_{} [J]", s));
  table.name("total [J]");
  for (const auto& [begin, row] : data.windows) {
    table.begin_line();
    for (const double x : {row.time, row.kinetic, row.kinetic_mean}) table.number(x);
    for (const auto* list : {&row.potential, &row.work, &row.damping_work, &row.held_work}) {
      for (const double x : *list) table.number(x);
    }
    for (const double x : {row.restitution_work, row.held_ahead, row.integration}) table.number(x);
    for (const ContactWork& m : row.contact_work) {
      for (const double x : {m.potential, m.friction, m.restitution}) table.number(x);
    }
    for (const double x : row.script_work) table.number(x);
    table.number(row.kinetic_mean + row.potential_in_all());
  }
  return table.finish();
}

std::string momentum_table(const FigureData& data) {
  Table table;
  table.name("time [s]");
  for (const char* what : {"momentum", "angular_momentum"}) {
    for (const char* axis : {"x", "y", "z"}) {
      table.name(fmt::format("{}_{} [N {}s]", what, axis, what[0] == 'm' ? "" : "m "));
    }
  }
  for (const auto& window : data.windows) {
    table.begin_line();
    table.number(window.row.time);
    for (const double x : window.row.momentum) table.number(x);
    for (const double x : window.row.angular_momentum) table.number(x);
  }
  return table.finish();
}

}  // namespace

FigureWriters csv_writers() { return {steps_table, energy_table, momentum_table}; }

}  // namespace noli::report
