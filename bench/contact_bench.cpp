// SPDX-License-Identifier: Apache-2.0
//
// What contact costs: certificates where nothing is near and where sheets hang side by side, against the same run
// without them; Algorithm 1 read literally (tests/support/every_pair.h) against cells; an impulse of a layer, with all
// that follows from it; and stacks of ten sheets that fall onto each other and onto a pinned one, larger and larger.
//
// Each pair of runs is of the same scene over the same windows, in turn, median of the passes.
#include <fmt/format.h>

#include <cstdio>

#include "bench/bench.h"
#include "bench/report.h"
#include "bench/timing.h"
#include "integrator/scene/build_model.h"
#include "integrator/scene/read_scene.h"
#include "integrator/simulation.h"
#include "tests/support/literal_simulation.h"

namespace noli::bench {
namespace {

using integrator::ForceKind;
using Model = integrator::Model<double, 3>;

/// Sheets of cells x cells squares of 1 cm that hang side by side, so many edges apart, or lie above each other and
/// fall onto the lowest, which is pinned.
Model sheets(int cells, int count, double edges_apart, bool fall) {
  const double edge = 0.01, size = edge * cells;
  const std::string turn = fall ? "" : R"("rotate": {"axis": [1, 0, 0], "degrees": 90}, )";
  const std::string along =
      fall ? fmt::format("[0, 0, {}]", edges_apart * edge) : fmt::format("[0, {}, 0]", edges_apart * edge);
  const std::string counts = fall ? fmt::format("[1, 1, {}]", count) : fmt::format("[1, {}, 1]", count);
  const std::string body = R"({{"name": "{}", "mesh": {{"grid": {{"size": [{}, {}], "cells": [{}, {}]}}}},
    "transform": {{{}"translate": [{}, 0, {}]}}, "perturb": 1e-5, {}
    "material": {{"young": 2e4, "poisson": 0.3, "density": 200, "thickness": 0.001, "bending": 20}}{}}})";
  std::string bodies =
      fmt::format(fmt::runtime(body), "sheets", size, size, cells, cells, turn, 0, 0,
                  fmt::format(R"("array": {{"counts": {}, "spacing": {}}},)", counts, along),
                  fall ? "" : fmt::format(R"(, "pin": [{}, {}])", cells * (cells + 1), (cells + 1) * (cells + 1) - 1));
  if (fall) {
    bodies += ", " + fmt::format(fmt::runtime(body), "floor", size, size, cells, cells, "", 0.003, -edges_apart * edge,
                                 "", R"(, "pin": ["all"])");
  }
  const std::string text = fmt::format(R"({{"noli_scene": 1, "duration": 1, "window": 0.01, "gravity": [0, 0, -9.81],
    "bodies": [{}], "contact": {{"thickness": 0.0015, "stiffness": 50}}}})",
                                       bodies);
  return integrator::build_model<3>(integrator::parse_scene(text, "bench")).model;
}

struct Cost {
  double seconds = 0;
  std::uint64_t breakpoints = 0, impulses = 0;
};

template <class Simulation = integrator::Simulation<double, 3>>
Cost run_windows(const Model& model, int first, int count) {
  Simulation simulation(model);
  integrator::Books<double, 3> books;
  integrator::Recording<double, 3> recording;  // has its room, as in a long run, when the clock starts
  for (int w = 0; w < first; ++w) {
    recording.clear();
    simulation.run_window(recording, books);
  }
  books = {};
  Cost cost;
  for (int w = 0; w < count; ++w) {
    recording.clear();
    const double begin = seconds();
    simulation.run_window(recording, books);
    cost.seconds += seconds() - begin;
    cost.breakpoints += recording.stream().size();
  }
  cost.impulses = books.of(ForceKind::contact).events;
  return cost;
}

Model without_contact(Model model) {
  model.contact.reset();
  return model;
}

struct Pair {
  Cost with, without;
};

template <class With = integrator::Simulation<double, 3>>
Pair measure(const Model& with, const Model& without, int first, int count) {
  std::vector<double> a, b;
  Pair pair;
  for (int i = 0; i < passes; ++i) {
    pair.without = run_windows(without, first, count);
    pair.with = run_windows<With>(with, first, count);
    a.push_back(pair.with.seconds);
    b.push_back(pair.without.seconds);
  }
  pair.with.seconds = median(a);
  pair.without.seconds = median(b);
  return pair;
}

void add_certificates(Table& table, const char* name, const Model& model) {
  const Pair pair = measure(model, without_contact(model), 4, 8);
  table.row({name, fmt::format("{}", model.x.size()), fmt::format("{:.2f}", pair.with.seconds / pair.without.seconds)});
}

/// Seconds that certificates add to a kick.
template <class With = integrator::Simulation<double, 3>>
double per_kick(const Model& with) {
  const Pair pair = measure<With>(with, without_contact(with), 0, 2);
  return (pair.with.seconds - pair.without.seconds) / static_cast<double>(pair.without.breakpoints);
}

void add_layers(Table& table, int cells, int count) {
  const Model model = sheets(cells, count, 0.3, true);
  const Cost cost = run_windows(model, 2, 4);
  const Cost bare = run_windows(without_contact(model), 2, 4);
  table.row({fmt::format("{} sheets of {} vertices", count, (cells + 1) * (cells + 1)),
             fmt::format("{}", cost.impulses),
             fmt::format("{:.2f}", 1e6 * (cost.seconds - bare.seconds) / static_cast<double>(cost.impulses))});
}

/// Some ten kicks of each layer, after the first ones: layers of all sheets act.
void add_stack(Table& table, int cells) {
  Model model = sheets(cells, 10, 0.14, true);
  model.window_length /= 256;
  const Cost cost = run_windows(model, 1, 2);
  const auto vertices = static_cast<double>(model.x.size());
  table.row({fmt::format("{:.0f}", vertices), fmt::format("{:.1f}", static_cast<double>(cost.impulses) / vertices),
             fmt::format("{:.1f}", 1e6 * cost.seconds / vertices)});
}

}  // namespace

bool run() {
  Table certificates({"certificates", "vertices", "with / without"});
  add_certificates(certificates, "a sheet, nothing near", sheets(99, 1, 1, false));
  add_certificates(certificates, "two sheets 1.2 edges apart", sheets(70, 2, 1.2, false));
  Model small = sheets(5, 2, 1.2, false);
  const double cells = per_kick(small);
  const double literal = per_kick<test::LiteralSimulation<3>>(small);
  Table layers({"falling onto a pinned one", "impulses of layers", "us each, all included"});
  for (const int n : {15, 31}) add_layers(layers, n, 3);
  Table stacks({"stack of ten sheets on a pinned one, vertices", "impulses a vertex", "us a vertex"});
  for (const int n : {9, 31, 94}) add_stack(stacks, n);
  std::fputs(
      fmt::format("\n{}\nAlgorithm 1 read literally, 72 vertices: {:.0f} ns a kick for certificates, cells {:.0f} "
                  "ns\n\n{}\n{}\n",
                  certificates.text(), 1e9 * literal, 1e9 * cells, layers.text(), stacks.text())
          .c_str(),
      stdout);
  return true;
}

}  // namespace noli::bench
