// SPDX-License-Identifier: Apache-2.0
#include "audit/numerics/precision.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>

#include <noli/errors.h>
#include "audit/numerics/replay.h"
#include "audit/numerics/sampled_run.h"
#include "kernel/parallel.h"

namespace noli::audit {
namespace {

/// The precision for differences between runs. Differences of doubles are exact in it; only their squares may round.
constexpr Arithmetic measuring{MpfrNumber::most_bits, false};

template <int Dim>
class Audit {
 public:
  Audit(const integrator::Model<double, Dim>& model, const PrecisionRequest& request)
      : request_(request), engine_(model) {
    if (request.arithmetics.empty()) throw std::invalid_argument("no arithmetic to compare with");
    for (const Arithmetic& arithmetic : request.arithmetics) {
      replays_.push_back(std::make_unique<Replay<Dim>>(arithmetic, replays_.empty(), model));
      outcome_.runs.push_back({arithmetic, {}, {}, {}});
    }
    outcome_.vertices = model.x.size();
    outcome_.extent = integrator::extent<Dim>(model.x);
    outcome_.windows_total = request.windows;
    take_clocks(model);
  }

  PrecisionOutcome operator()() {
    while (outcome_.windows < request_.windows && !stopped() && run_window()) {
      ++outcome_.windows;
      request_.progress(static_cast<double>(outcome_.windows) / static_cast<double>(request_.windows));
    }
    outcome_.complete = outcome_.windows == request_.windows;
    outcome_.events = engine_.events();
    outcome_.difference = replays_.front()->comparison().difference();
    for (std::size_t i = 0; i < replays_.size(); ++i) outcome_.runs[i].changes = replays_[i]->comparison().changes();
    return std::move(outcome_);
  }

 private:
  using State = integrator::State<double, Dim>;

  bool stopped() const {
    return audit::stopped(request_.stop) ||
           (request_.deadline && std::chrono::steady_clock::now() >= *request_.deadline);
  }

  // --- A window ------------------------------------------------------------------------------------------------------

  /// False if the window was not run to its end; then it does not count.
  bool run_window() {
    const integrator::Stop stop = [this] { return stopped(); };
    const double begin = engine_.time();
    log_.clear();
    try {
      if (!engine_.run_window(log_, books_, stop)) return false;
    } catch (const integrator::ContactLimit&) {
      return end("a pair of features needs more layers of contact than allowed");
    } catch (const noli::Stopped&) {  // in the search for what is near
      return false;
    }
    if (!finite()) return end("a number is not finite");
    const State state = integrator::Ledger<double, Dim>(engine_).state();
    log_active_pairs();
    parallel_for(replays_.size(), request_.threads, [&](std::size_t i) { replay(i, stop); });
    if (stopped()) return false;
    compare_bits(state);
    for (std::size_t i = 0; i < replays_.size(); ++i) measure(i, state);
    measure_energy(state);
    outcome_.examined += log_.examined().size();
    for (const Examined& examined : log_.examined()) outcome_.impulses += examined.course.acts ? 1 : 0;
    if (!outcome_.tie) find_tie(begin);
    return true;
  }

  bool end(const std::string& why) {
    outcome_.ended = why;
    return false;
  }

  bool finite() const {
    return std::ranges::all_of(engine_.particles(), [](const auto& p) { return p.x.allFinite() && p.v.allFinite(); });
  }

  void log_active_pairs() {
    if (engine_.contact() == nullptr) return;
    engine_.contact()->for_each_active([&](const auto& pairs, std::uint16_t material, std::uint32_t l) {
      const auto& contact = *engine_.contact();
      log_.add_active({contact.terms_of(material, l), contact.step_of(material, l), {pairs.begin(), pairs.end()}});
    });
  }

  void replay(std::size_t i, const integrator::Stop& stop) {
    if (outcome_.runs[i].ended) return;
    try {
      replays_[i]->run_window(log_, stop);
    } catch (const integrator::ContactLimit&) {
      outcome_.runs[i].ended = "a pair of features is at distance 0";
    }
  }

  // --- The first run must equal double, bit for bit ------------------------------------------------------------------

  void compare_bits(const State& state) {
    Replay<Dim>& replay = *replays_.front();
    Comparison<Dim>& comparison = replay.comparison();
    const double t = engine_.time();
    for (std::size_t i = 0; i < engine_.particles().size(); ++i) {
      const auto& a = engine_.particles()[i];
      const auto& b = replay.particles()[i];
      if (a.t != b.t || !all_same_bits(a.x, b.x)) comparison.differ(t, static_cast<VertexId>(i));
      if (!all_same_bits(a.v, b.v)) comparison.differ(t, "velocity of vertex " + std::to_string(i));
    }
    const auto& other = replay.state();
    for (std::size_t k = 0; k < integrator::force_kinds; ++k) {
      if (same_bits(state.potential[k], other.potential[k])) continue;
      comparison.differ(t, "potential of " + std::string(name(static_cast<integrator::ForceKind>(k))));
    }
    if (!same_bits(state.kinetic, other.kinetic) || !same_bits(state.kinetic_mean, other.kinetic_mean)) {
      comparison.differ(t, "kinetic energy");
    }
    if (!same_bits(books_.given(), replay.given()) || !same_bits(state.held_ahead, other.held_ahead)) {
      comparison.differ(t, "work of damping, friction, restitution or scripts");
    }
    if (!all_same_bits(state.momentum, other.momentum)) comparison.differ(t, "momentum");
    if (!all_same_bits(state.angular_momentum, other.angular_momentum)) comparison.differ(t, "angular momentum");
  }

  // --- Distance between runs -----------------------------------------------------------------------------------------

  template <class A, class B>
  static MpfrNumber squared_distance(const A& a, const B& b) {
    MpfrNumber sum(0);
    for (Eigen::Index k = 0; k < a.size(); ++k) {
      const MpfrNumber difference = MpfrNumber(a[k]) - b[k];
      sum += difference * difference;
    }
    return sum;
  }

  template <class A, class B>
  static double distance(const A& a, const B& b) {
    return static_cast<double>(sqrt(squared_distance(a, b)));
  }

  /// E.
  template <class Number>
  static MpfrNumber energy(const integrator::State<Number, Dim>& state) {
    MpfrNumber sum(state.kinetic_mean);
    for (const Number& potential : state.potential) sum += MpfrNumber(potential);
    return sum + MpfrNumber(state.held_ahead);
  }

  void measure(std::size_t i, const State& state) {
    PrecisionRun& run = outcome_.runs[i];
    if (run.ended) return;
    const MpfrScope scope(measuring);
    const Replay<Dim>& replay = *replays_[i];
    Drift drift;
    drift.time = engine_.time();
    MpfrNumber greatest(-1), sum(0);
    for (std::size_t v = 0; v < outcome_.vertices; ++v) {
      const MpfrNumber squared = squared_distance(engine_.particles()[v].x, replay.particles()[v].x);
      sum += squared;
      if (!(squared > greatest)) continue;
      greatest = squared;
      drift.vertex = static_cast<VertexId>(v);
    }
    if (!sum.finite()) {
      run.ended = "a number is not finite";
      return;
    }
    if (outcome_.vertices > 0) {
      drift.position = static_cast<double>(sqrt(greatest));
      drift.position_rms = static_cast<double>(sqrt(sum / MpfrNumber(static_cast<double>(outcome_.vertices))));
    }
    drift.energy = static_cast<double>(energy(state) - energy(replay.state()));
    drift.momentum = distance(state.momentum, replay.state().momentum);
    drift.angular_momentum = distance(state.angular_momentum, replay.state().angular_momentum);
    run.drifts.push_back(drift);
  }

  /// Compares double with the last run, the most precise one.
  void measure_energy(const State& state) {
    if (outcome_.runs.back().ended) return;
    const MpfrScope scope(measuring);
    const Replay<Dim>& replay = *replays_.back();
    const MpfrNumber own = energy(state), gained = own - MpfrNumber(books_.given()),
                     exact = energy(replay.state()) - replay.given();
    if (outcome_.energies.empty()) first_ = {gained, exact};
    const MpfrNumber truncation = exact - first_.second;
    outcome_.energies.push_back({engine_.time(), static_cast<double>(own), static_cast<double>(truncation),
                                 static_cast<double>(gained - first_.first - truncation)});
  }

  // --- Times ---------------------------------------------------------------------------------------------------------

  /// Forces before layers of contact, as in Engine::run_next, and a window's end last.
  void take_clocks(const integrator::Model<double, Dim>& model) {
    std::uint64_t rank = 0;
    for (const auto& group : engine_.groups()) {
      const std::string kind(name(group.kind));
      const bool one_rank = model.clocks == integrator::Clocks::own && !clocks_.empty() && clocks_.back().name == kind;
      clocks_.push_back({group.step, kind, one_rank ? rank : ++rank});
    }
    clocks_.push_back({model.window_length, "window", std::numeric_limits<std::uint64_t>::max()});
  }

  void find_tie(double begin) {
    std::vector<TimedEvent> events;
    for (const TimedClock& clock : clocks_) add_events(clock, begin, engine_.time(), events);
    std::vector<TimedClock> layers;
    layers.reserve(log_.firings().size());
    for (const LoggedFiring& logged : log_.firings()) {
      const integrator::Firing& f = logged.firing;
      if (!(f.time > 0)) continue;
      const std::uint64_t material = f.terms.material, layer = f.terms.layer;
      layers.push_back({f.h, "layer " + std::to_string(layer), (material + 1) << 32 | layer});
      events.push_back({f.time, static_cast<std::uint64_t>(std::llround(f.time / f.h)), &layers.back()});
    }
    outcome_.tie = first_tie(events);
  }

  const PrecisionRequest& request_;
  integrator::Engine<double, Dim> engine_;
  integrator::Books<double, Dim> books_;
  EventLog<Dim> log_;
  std::vector<std::unique_ptr<Replay<Dim>>> replays_;
  std::vector<TimedClock> clocks_;
  std::pair<MpfrNumber, MpfrNumber> first_;  ///< E - W at the end of the first window, of double and of the last run
  PrecisionOutcome outcome_;
};

}  // namespace

double EnergyError::share_of_rounding() const {
  const double both = std::abs(rounding) + std::abs(truncation);
  return both > 0 ? std::abs(rounding) / both : 0;
}

std::optional<double> PrecisionOutcome::order_changes() const {
  std::optional<double> time;
  if (tie) time = tie->time;
  const auto& acts = runs.back().changes.acts.first;
  if (acts && (!time || acts->time < *time)) time = acts->time;
  return time;
}

std::size_t PrecisionOutcome::windows_in_order() const {
  const auto& acts = runs.back().changes.acts.first;
  const auto in_order = [&](const EnergyError& window) { return !acts || window.time < acts->time; };
  return static_cast<std::size_t>(std::count_if(energies.begin(), energies.end(), in_order));
}

PrecisionOutcome audit_precision(const integrator::Model<double, 2>& model, const PrecisionRequest& request) {
  return Audit<2>(model, request)();
}

PrecisionOutcome audit_precision(const integrator::Model<double, 3>& model, const PrecisionRequest& request) {
  return Audit<3>(model, request)();
}

}  // namespace noli::audit
