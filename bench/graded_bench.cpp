// SPDX-License-Identifier: Apache-2.0
//
// What steps of their own save where a mesh is fine in one place and struck there (scenes/graded_sheet.json): a sheet
// whose triangles are fifty times smaller in one place, and two beads that strike it there from both sides. Beside it
// the same with one step for all forces, half of what the smallest ones can bear, and one for all first layers, the
// shortest of theirs: same potentials, same integrator, same certificates. The smallest forces have eight times shorter
// steps in the first run than in the second, as otherwise the larger ones, whose steps are then as long as they can be,
// make it less exact: what is compared is time at the same error.
//
// Energy error: the largest difference from the beginning at the ends of windows, in parts of the beginning.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>

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

using Model = integrator::Model<double, 3>;

constexpr int windows = 8;  ///< 4 ms: both beads strike and rebound

integrator::Scene graded() {
  const auto file = std::filesystem::path(NOLI_SOURCE_DIR) / "scenes/graded_sheet.json";
  return integrator::parse_scene(read_whole_file(file), file.string());
}

Model with_one_step(integrator::Scene scene) {
  scene.step_factor = 0.5;
  Model model = integrator::build_model<3>(scene).model;
  audit::set_steps(model, audit::least_step(model));
  return model;
}

void add_row(Table& table, const char* name, const audit::SampledRun<3>& run, double seconds, double error) {
  table.row({name, fmt::format("{}", run.events), fmt::format("{}", run.impulses), fmt::format("{:.2f}", seconds),
             fmt::format("{:.1e}", error)});
}

}  // namespace

/// The run with one step takes minutes: it is made once, the other one several times.
bool run() {
  const integrator::Scene scene = graded();
  const Model model = integrator::build_model<3>(scene).model;
  const Model one_step = with_one_step(scene);
  const audit::SampledRun<3> one = audit::run_with_clocks(one_step, windows);
  std::vector<double> times;
  audit::SampledRun<3> own;
  for (int i = 0; i < passes; ++i) {
    own = audit::run_with_clocks(model, windows);
    times.push_back(own.seconds);
  }
  const double seconds = median(times), error = audit::energy_error(model, own),
               one_error = audit::energy_error(one_step, one);
  Table table({"graded sheet in contact", "events", "impulses of layers", "s", "energy error"});
  add_row(table, "steps by groups and classes", own, seconds, error);
  add_row(table, "one step for all", one, one.seconds, one_error);
  std::fputs(fmt::format("\n{}\n{:.1f} times less time, {:.2f} of the energy error\n", table.text(),
                         one.seconds / seconds, error / one_error)
                 .c_str(),
             stdout);
  return true;
}

}  // namespace noli::bench
