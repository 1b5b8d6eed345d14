// SPDX-License-Identifier: Apache-2.0
#include <noli/simulate.h>

#include <fmt/format.h>

#include <string>
#include <string_view>
#include <utility>

#include <noli/errors.h>
#include "certify/runs/run_log_facts.h"
#include "certify/runs/run_series_reader.h"
#include "certify/simulate/model_run.h"
#include "integrator/contact_extremes.h"
#include "integrator/scene/build_model.h"
#include "integrator/scene/read_scene.h"
#include "trajectory/stop.h"
#include "trajectory/write_file.h"

namespace noli {
namespace {

void tell(const ReproduceRequest& request, std::string_view work, double share) {
  if (request.progress) request.progress(work, share);
}

/// A window of the run, and the state at its beginning.
template <int Dim>
struct Found {
  RunWindow window;
  std::uint64_t halvings = 0;
  integrator::Snapshot<double, Dim> before;
};

template <int Dim>
Found<Dim> find_window(const ReproduceRequest& request) {
  SeriesReader reader = open_run(request.run);
  Found<Dim> found;
  while (auto window = reader.next_window()) {
    end_if_stopped();
    tell(request, "read", static_cast<double>(window->index + 1) / static_cast<double>(request.window));
    if (window->index + 1 == request.window) {
      found.window = std::move(*window);
      found.halvings = reader.row().halvings;
      return found;
    }
    found.before = snapshot_of<Dim>(*window, reader.state());
  }
  throw InputError(
      request.run.string(), "",
      fmt::format("has {} windows, counted from 1; expected one of them, found {}", reader.windows(), request.window));
}

template <int Dim>
void run_window(integrator::Simulation<double, Dim>& simulation, integrator::Recording<double, Dim>& recording,
                const ReproduceRequest& request) {
  integrator::Books<double, Dim> books;
  const auto stop = [] { return stop_asked().has_value(); };
  try {
    if (!stop() && simulation.run_window(recording, books, stop)) return;
    throw Stopped(stop_asked().value_or(StopReason::interrupted),
                  fmt::format("{}: window {}", request.run.string(), request.window));
  } catch (const integrator::ContactLimit& limit) {
    throw InputError(trajectory_path(request.run).string(), "",
                     fmt::format("window {}: integrated again, a pair needs more layers than allowed at {:.17g} s: the "
                                 "run has been changed, or another version of noli wrote it (`noli info` says which)",
                                 request.window, limit.time));
  }
}

template <int Dim>
ReproduceOutcome reproduce(const ReproduceRequest& request, const integrator::Scene& scene) {
  const Found<Dim> found = find_window<Dim>(request);
  const auto built = integrator::build_model<Dim>(scene);
  if (built.model.x.size() != found.window.positions.size()) {
    throw InputError(request.run.string(), "",
                     "has a different number of vertices from the scene; expected the run's scene");
  }
  auto simulation = simulation_at<Dim>(built.model, found.before, found.halvings);
  integrator::Recording<double, Dim> recording;
  tell(request, "integrate", 0);
  run_window(simulation, recording, request);
  tell(request, "integrate", 1);
  const WorldLines lines = integrator::world_lines<Dim>(recording, built.model.x.size());
  ReproduceOutcome outcome;
  outcome.breakpoints = recording.stream().size();
  outcome.expected = found.window.lines ? lines_hash(Dim, *found.window.lines) : found.window.lines_hash;
  outcome.found = lines_hash(Dim, lines);
  outcome.same = outcome.expected == outcome.found;
  if (!request.output) return outcome;
  std::string block;
  put_lines_block(Dim, lines, [&block](std::string_view bytes) { block += bytes; });
  replace_file(*request.output, block);
  return outcome;
}

}  // namespace

ReproduceOutcome run_reproduce(const ReproduceRequest& request) {
  if (request.window == 0) throw UsageError("window 0: windows count from 1");
  const StopOfThread stop_of_thread(request.stop);
  const auto form = request.brief ? integrator::Form::brief : integrator::Form::full;
  const integrator::Scene scene = integrator::read_scene(request.scene, form);
  return scene.dimension == 2 ? reproduce<2>(request, scene) : reproduce<3>(request, scene);
}

}  // namespace noli
