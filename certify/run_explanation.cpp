// SPDX-License-Identifier: Apache-2.0
#include "certify/run_explanation.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include <noli/errors.h>
#include "certify/runs/run_folder.h"
#include "certify/runs/run_series_reader.h"
#include "certify/simulate/exact_gap.h"
#include "trajectory/stop.h"

namespace noli {
namespace {

constexpr std::size_t most_worst = 5;

class Explaining {
 public:
  explicit Explaining(const std::filesystem::path& run) : run_(run), log_(read_log(run)), reader_(open_run(run, log_)) {
    result_.title = title_of(run);
    result_.dimension = reader_.header().dimension;
    result_.full = reader_.header().record == RecordMode::full;
  }

  RunExplanation operator()() {
    while (auto window = reader_.next_window()) {
      end_if_stopped();
      add(std::move(*window));
    }
    result_.log = std::move(log_);
    result_.open_window = reader_.open_window().has_value();
    if (nearest_lines_) find_gap();
    return std::move(result_);
  }

 private:
  void find_gap() {
    const auto& [window, nearest] = *result_.nearest;
    try {
      result_.gap = exact_gap(*nearest_lines_, static_cast<int>(result_.dimension), nearest.pair, nearest.vertices);
    } catch (const std::range_error&) {
      throw InputError(
          trajectory_path(run_).string(), "",
          fmt::format("window {}: the pair that came nearest is farther apart than the greatest double", window));
    }
  }

  void add(RunWindow window) {
    const SeriesRow& row = reader_.row();
    ++result_.windows;
    result_.time = row.time;
    result_.breakpoints += row.breakpoints;
    result_.halvings = row.halvings;
    for (std::size_t k = 0; k < row.events.size(); ++k) result_.events[k] += row.events[k];
    if (row.steps.smallest > 0 && (result_.smallest_step == 0 || row.steps.smallest < result_.smallest_step)) {
      result_.smallest_step = row.steps.smallest;
    }
    add_energy(row);
    if (row.deepest.layer > 0) add_layers(result_.windows, row);
    if (result_.nearest && result_.nearest->window == result_.windows && window.lines) {
      nearest_lines_ = std::move(*window.lines);
    }
  }

  void add_energy(const SeriesRow& row) {
    const double total = row.kinetic_mean + row.potential_in_all();
    if (!result_.energy) {
      result_.energy.emplace();
      result_.energy->begin = row.energy_before();
      result_.energy->first = result_.energy->least = result_.energy->greatest = total;
      result_.energy->materials.resize(row.contact_work.size());
      result_.energy->scripts.resize(row.script_work.size());
    }
    EnergySummary& energy = *result_.energy;
    energy.last = total;
    energy.least = std::min(energy.least, total);
    energy.greatest = std::max(energy.greatest, total);
    add_works(row, energy);
  }

  /// The lists have the same lengths in every row (certify/runs/run_series_reader.cpp).
  static void add_works(const SeriesRow& row, EnergySummary& energy) {
    for (std::size_t k = 0; k < force_kinds; ++k) {
      energy.damping_work += row.damping_work[k];
      energy.held_work += row.held_work[k];
      energy.kinds[k].potential += row.work[k];
      energy.kinds[k].damping += row.damping_work[k];
      energy.kinds[k].held += row.held_work[k];
    }
    energy.restitution_work += row.restitution_work;
    energy.integration += row.integration;
    for (std::size_t m = 0; m < energy.materials.size(); ++m) {
      energy.materials[m].potential += row.contact_work[m].potential;
      energy.materials[m].friction += row.contact_work[m].friction;
      energy.materials[m].restitution += row.contact_work[m].restitution;
    }
    for (std::size_t s = 0; s < energy.scripts.size(); ++s) energy.scripts[s] += row.script_work[s];
  }

  void add_layers(std::uint64_t window, const SeriesRow& row) {
    const ActingMoment deepest{window, row.deepest}, nearest{window, row.nearest};
    if (!result_.deepest || deepest.action.layer > result_.deepest->action.layer) result_.deepest = deepest;
    if (!result_.nearest || nearest.action.distance < result_.nearest->action.distance) result_.nearest = nearest;
    auto& worst = result_.worst;
    const auto place =
        std::upper_bound(worst.begin(), worst.end(), deepest,
                         [](const ActingMoment& a, const ActingMoment& b) { return a.action.layer > b.action.layer; });
    worst.insert(place, deepest);
    if (worst.size() > most_worst) worst.pop_back();
  }

  const std::filesystem::path& run_;
  LogFacts log_;
  SeriesReader reader_;
  std::optional<WorldLines> nearest_lines_;  ///< of the window with the nearest pair
  RunExplanation result_;
};

}  // namespace

std::optional<double> RunExplanation::bound() const {
  if (!log.has_contact || log.thicknesses.empty() || log.windows < windows) return std::nullopt;
  const double thickness = *std::min_element(log.thicknesses.begin(), log.thicknesses.end());
  integrator::ContactMaterial material;
  material.thickness = thickness;
  return layer_thickness(material, log.layers, log.deepest + 1);
}

RunExplanation explain_run(const std::filesystem::path& run) { return Explaining(run)(); }

RunSummary summary_of_run(const std::filesystem::path& run, const std::atomic<bool>* stop) {
  const StopOfThread stop_of_thread(stop);
  return explain_run(run);
}

}  // namespace noli
