// SPDX-License-Identifier: Apache-2.0
//
// What asynchrony saves: a soft plate with an inset of four per cent of its elements whose steps are a hundred times
// shorter (scenes/stiff_inset.json, without gravity), the inset struck so that what it does is what there is to get
// right. Beside it synchronous Verlet, with the step that the inset needs: its energy from the same integrator with all
// steps equal, its time from the plain loop (audit/numerics/plain_loop.h), which writes nothing down.
//
// Energy error: the largest difference from the beginning at the ends of windows, in parts of the beginning.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <random>

#include "audit/numerics/one_step.h"
#include "audit/numerics/sampled_run.h"
#include "bench/bench.h"
#include "bench/report.h"
#include "bench/timing.h"
#include "integrator/scene/build_model.h"
#include "integrator/scene/read_scene.h"
#include "trajectory/text.h"

namespace noli::bench {
namespace {

using integrator::Model;

constexpr int windows = 5;

/// Gives the vertices of the forces with short steps velocities that depend on nothing but their order.
void strike_inset(Model<double, 3>& model, double short_step) {
  constexpr double speed = 0.1;
  std::vector<bool> struck(model.x.size(), false);
  audit::for_each_list(model, [&](auto& list) {
    for (std::size_t i = 0; i < list.forces.size(); ++i) {
      if (list.steps[i] > short_step) continue;
      for (const VertexId v : list.forces[i].vertices) struck[v] = true;
    }
  });
  std::mt19937_64 random(1);
  const auto number = [&] { return speed * (static_cast<double>(random() >> 11) * 0x1p-52 - 1); };
  for (std::size_t v = 0; v < struck.size(); ++v) {
    if (struck[v]) model.v[v] = {number(), number(), number()};
  }
}

Model<double, 3> plate() {
  const auto file = std::filesystem::path(NOLI_SOURCE_DIR) / "scenes/stiff_inset.json";
  const auto scene = integrator::parse_scene(read_whole_file(file), file.string());
  Model<double, 3> model = integrator::build_model<3>(scene).model;
  model.gravity.reset();
  strike_inset(model, 2 * audit::least_step(model));
  return model;
}

struct Measured {
  audit::SampledRun<3> run;
  double seconds, energy_error;
};

Measured measured(const Model<double, 3>& model, audit::SampledRun<3> run, const std::vector<double>& seconds) {
  const double error = audit::energy_error(model, run);
  return {std::move(run), median(seconds), error};
}

void add_row(Table& table, const char* name, const Measured& method, double least) {
  table.row({name, fmt::format("{:.2e}", least), fmt::format("{}", method.run.events),
             fmt::format("{:.2f}", method.seconds), fmt::format("{:.1e}", method.energy_error)});
}

}  // namespace

bool run() {
  Model<double, 3> own = plate(), equal = own;
  const double least = audit::least_step(own);
  audit::set_steps(equal, least);
  std::vector<double> asynchronous, synchronous;
  audit::SampledRun<3> run;
  for (int i = 0; i < passes; ++i) {
    run = audit::run_with_clocks(own, windows);
    asynchronous.push_back(run.seconds);
    synchronous.push_back(audit::run_plain(equal, least, windows).seconds);
  }
  const Measured a = measured(own, run, asynchronous);
  const Measured s = measured(equal, audit::run_with_clocks(equal, windows), synchronous);
  Table table({"plate with a stiff inset", "least step, s", "forces fired", "s", "energy error"});
  add_row(table, "asynchronous", a, least);
  add_row(table, "synchronous Verlet", s, least);
  std::fputs(fmt::format("\n{}\n{:.1f} times fewer forces, {:.1f} times less time, {:.2f} of the energy error\n",
                         table.text(), static_cast<double>(s.run.events) / static_cast<double>(a.run.events),
                         s.seconds / a.seconds, a.energy_error / s.energy_error)
                 .c_str(),
             stdout);
  return true;
}

}  // namespace noli::bench
