// SPDX-License-Identifier: Apache-2.0
//
// Integrates the windows of a run one after another, and can go back to the beginning of a refused one. retries.h
// decides what is tried again.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "certify/runs/run_series.h"
#include "certify/simulate/model_run.h"
#include "certify/simulate/retries.h"
#include "integrator/contact_extremes.h"
#include "integrator/simulation.h"
#include "trajectory/stop.h"

namespace noli {

template <int Dim>
struct IntegratedWindow {
  std::uint64_t index = 0;
  integrator::Snapshot<double, Dim> before;
  double energy_before = 0;  ///< [J]
  std::unique_ptr<const WorldLines> lines;
  std::vector<Position> velocities;
  std::vector<integrator::Anchor<double>> anchors;  ///< at its end
  SeriesRow row;
  std::uint32_t deepest = 0;  ///< the deepest layer that was active so far
};

template <int Dim>
class WindowIntegrator {
 public:
  using Model = integrator::Model<double, Dim>;
  using Snapshot = integrator::Snapshot<double, Dim>;

  /// The arguments must outlive this. `fixed`: by vertex, nonzero if it is pinned or scripted.
  WindowIntegrator(const Model& model, std::span<const std::uint8_t> fixed, integrator::Activity& activity)
      : model_(model), fixed_(fixed), activity_(activity) {}

  /// Begins at time 0. Throws Stopped.
  void begin() { go_on(Snapshot{}, 0, Retry{}); }
  /// Begins at the end of an existing window, with this energy [J]. Throws Stopped.
  void go_on(const Snapshot& last, double energy, const Retry& how) {
    simulation_.emplace(simulation_at<Dim>(model_, last, how.halvings, how.least_layers));
    simulation_->show(activity_);
    energy_ = energy;
    halvings_ = how.halvings;
  }
  /// Goes back to the beginning of a refused window. Throws Stopped.
  void go_back(const IntegratedWindow<Dim>& window, const Retry& how) {
    const CertificateCounts counts = simulation_->certificates();
    go_on(window.before, window.energy_before, how);
    gone_ += counts;
  }

  /// The end of the last window that was integrated [s].
  double time() const { return simulation_->time(); }
  std::uint32_t deepest() const { return simulation_->certificates().deepest; }
  CertificateCounts certificates() const {
    CertificateCounts all = gone_;
    if (simulation_) all += simulation_->certificates();
    return all;
  }

  /// The next window. Nothing if it was stopped, or the run ends within it: limit(), finite().
  std::optional<IntegratedWindow<Dim>> next(const integrator::Stop& stop) {
    before_ = simulation_->snapshot();
    const bool first = before_.windows == 0;
    if (first) energy_ = simulation_->state().energy();
    finite_ = true;
    limit_.reset();
    recording_.clear();
    integrator::Books<double, Dim> books;
    try {
      if (!simulation_->run_window(recording_, books, stop)) return std::nullopt;
    } catch (const Stopped&) {
      stop();
      return std::nullopt;
    } catch (const integrator::ContactLimit& limit) {
      finite_ = simulation_->finite();
      if (finite_) limit_ = limit;
      return std::nullopt;
    }
    if (!simulation_->finite()) {
      finite_ = false;
      return std::nullopt;
    }
    if (first) energy_ += simulation_->contact_at_start();
    return integrated(books);
  }

  // --- Why there is no next window -----------------------------------------------------------------------------------

  const std::optional<integrator::ContactLimit>& limit() const { return limit_; }
  /// All numbers of the window are finite.
  bool finite() const { return finite_; }
  bool in_first_window() const { return before_.windows == 0; }
  /// Runs the window again to find the first NaN or infinity. Nothing if it was stopped.
  std::optional<NotFinite> find_not_finite(const integrator::Stop& stop) const {
    try {
      return simulation_at<Dim>(model_, before_, halvings_).find_not_finite(stop);
    } catch (const Stopped&) {
      stop();
      return std::nullopt;
    }
  }

  /// Frees most of its memory. After that it must not integrate.
  void end() {
    recording_ = {};
    if (simulation_) gone_ += simulation_->certificates();
    simulation_.reset();
  }

 private:
  IntegratedWindow<Dim> integrated(const integrator::Books<double, Dim>& books) {
    IntegratedWindow<Dim> window;
    window.index = before_.windows;
    window.before = before_;
    window.energy_before = energy_;
    window.deepest = deepest();
    const integrator::PhaseScope recording(activity_, integrator::Phase::recording);
    window.lines = std::make_unique<const WorldLines>(world_lines<Dim>(recording_, model_.x.size()));
    const Snapshot after = simulation_->snapshot();
    window.velocities = positions_of<Dim>(after.v);
    window.anchors = after.anchors;
    window.row = series_row<Dim>(*simulation_, books, recording_.stream().size(), *window.lines, fixed_, energy_);
    window.row.halvings = halvings_;
    energy_ = window.row.energy();
    return window;
  }

  const Model& model_;
  std::span<const std::uint8_t> fixed_;
  integrator::Activity& activity_;
  std::optional<integrator::Simulation<double, Dim>> simulation_;
  integrator::Recording<double, Dim> recording_;
  Snapshot before_;    ///< at the beginning of the last window that was begun
  double energy_ = 0;  ///< at the current time, between windows [J]
  std::uint64_t halvings_ = 0;
  CertificateCounts gone_;  ///< of earlier simulations
  std::optional<integrator::ContactLimit> limit_;
  bool finite_ = true;
};

}  // namespace noli
