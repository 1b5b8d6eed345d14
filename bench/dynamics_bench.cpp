// SPDX-License-Identifier: Apache-2.0
//
// The integrator against a plain synchronous loop over the same forces (audit/numerics/plain_loop.h), time for time per
// force fired, in one run: grouped steps, a step for each force, recording, and what certifying the recorded windows
// costs. Beside them the time of one textbook query on armadillo-rollers-vertex-face, where the data is there.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <vector>

#include "audit/numerics/plain_loop.h"
#include "bench/bench.h"
#include "bench/cloth.h"
#include "bench/data.h"
#include "bench/report.h"
#include "bench/textbook.h"
#include "bench/timing.h"
#include "integrator/simulation.h"
#include "proofs/prover/windows/window_verifier.h"

namespace noli::bench {
namespace {

using audit::PlainLoop;
using integrator::Books;
using integrator::Clocks;
using integrator::Recording;
using integrator::Simulation;

constexpr std::uint64_t events_a_pass = 3'000'000;
constexpr int sizes[] = {31, 99, 299};

/// Seconds a force fired of the plain loop.
double time_plain(PlainLoop<3>& loop) {
  const std::uint64_t steps = events_a_pass / loop.forces() + 1;
  const double begin = seconds();
  for (std::uint64_t i = 0; i < steps; ++i) loop.step();
  return (seconds() - begin) / static_cast<double>(steps * loop.forces());
}

/// Runs windows until enough events have passed.
template <class RunWindow>
double time_simulation(const Simulation<double, 3>& simulation, const RunWindow& run_window) {
  const std::uint64_t before = simulation.events();
  const double begin = seconds();
  while (simulation.events() - before < events_a_pass) run_window();
  return (seconds() - begin) / static_cast<double>(simulation.events() - before);
}

std::vector<Position> positions(const integrator::Model<double, 3>& model) {
  std::vector<Position> result;
  for (const auto& x : model.x) result.push_back({x[0], x[1], x[2]});
  return result;
}

struct Costs {
  std::vector<double> plain, grouped, recorded, own, certified, breakpoints;
};

/// One pass of each, in turn.
class Contest {
 public:
  explicit Contest(int cells)
      : mesh_(cloth(cells, 3, Clocks::grouped).mesh),
        verifier_(mesh_, positions(cloth(cells, 3, Clocks::grouped)), {}),
        plain_(cloth(cells, 3, Clocks::grouped), 1e-7),
        grouped_(cloth(cells, 3, Clocks::grouped)),
        recorded_(cloth(cells, 3, Clocks::grouped)),
        own_(cloth(cells, 3, Clocks::own)) {
    for (int i = 0; i < passes + 1; ++i) pass();  // the first warms up
  }

  void row(Table& table) const {
    const auto ns = [](const std::vector<double>& all) { return 1e9 * median({all.begin() + 1, all.end()}); };
    const double plain = ns(costs_.plain), grouped = ns(costs_.grouped), recorded = ns(costs_.recorded);
    table.row({fmt::format("{}", mesh_.vertex_count), fmt::format("{:.1f}", plain), fmt::format("{:.1f}", grouped),
               fmt::format("{:.2f}", grouped / plain), fmt::format("{:.2f}", ns(costs_.own) / plain),
               fmt::format("{:+.0f} %", 100 * (recorded / grouped - 1)),
               fmt::format("{:.2f}", ns(costs_.certified) / recorded), fmt::format("{:.1f}", 1e3 / grouped)});
  }

 private:
  void pass() {
    costs_.plain.push_back(time_plain(plain_));
    costs_.grouped.push_back(time_simulation(grouped_, [this] { grouped_.run_window(books_); }));
    double certifying = 0;
    const double all = time_simulation(recorded_, [&] {
      recording_.clear();
      recorded_.run_window(recording_, books_);
      certifying += certify();
    });
    costs_.own.push_back(time_simulation(own_, [this] { own_.run_window(books_); }));
    const double certified = certifying / static_cast<double>(recorded_events());
    costs_.certified.push_back(certified);
    costs_.recorded.push_back(all - certified);
  }

  /// Forces fired by the recorded simulation since it was asked last.
  std::uint64_t recorded_events() {
    const std::uint64_t before = recorded_before_;
    recorded_before_ = recorded_.events();
    return recorded_before_ - before;
  }

  double certify() {
    const double begin = seconds();
    WindowOptions options;
    options.threads = 1;
    options.initial = false;
    const WindowResult result = verifier_.verify(integrator::world_lines<3>(recording_, mesh_.vertex_count), options);
    contacts_ += result.contact_count();
    return seconds() - begin;
  }

  Mesh mesh_;
  WindowVerifier verifier_;
  PlainLoop<3> plain_;
  Simulation<double, 3> grouped_, recorded_, own_;
  Recording<double, 3> recording_;
  Books<double, 3> books_;
  std::uint64_t recorded_before_ = 0, contacts_ = 0;
  Costs costs_;
};

void print_unit() {
  const auto file = read_query_file("armadillo-rollers-vertex-face");
  if (!file) return;
  const auto work = workload(std::get<std::vector<VertexFace3>>(file->queries));
  std::vector<double> times;
  for (int i = 0; i < passes; ++i) {
    const double begin = seconds();
    benchmark::DoNotOptimize(count_true(work, [](const VertexFace3& q) { return textbook_meet(q); }));
    times.push_back((seconds() - begin) / static_cast<double>(work.size()));
  }
  std::fputs(fmt::format("unit: {:.1f} ns, one textbook query on armadillo-rollers-vertex-face\n", 1e9 * median(times))
                 .c_str(),
             stdout);
}

}  // namespace

bool run() {
  Table table({"vertices", "plain ns/force", "grouped ns/force", "grouped / plain", "own steps / plain", "recording",
               "certifying / simulating", "million forces a second"});
  for (const int cells : sizes) Contest(cells).row(table);
  std::fputs(("\n" + table.text()).c_str(), stdout);
  print_unit();
  return true;
}

}  // namespace noli::bench
