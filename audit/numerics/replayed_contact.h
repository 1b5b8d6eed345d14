// SPDX-License-Identifier: Apache-2.0
//
// Replays contact: layers fire at the times and for the pairs of a logged run, with the formulas of
// integrator/layer_fire.h in numbers of type S. This run's own positions decide whether a layer acts, between which
// points, whether restitution counts, whether friction exceeds Coulomb's bound, and where anchors are.
//
// Times, thicknesses, stiffnesses and steps are the doubles of the logged run. There are no certificates, so a pair
// that comes near only in this run is not seen.
#pragma once

#include <limits>
#include <span>
#include <vector>

#include "audit/numerics/event_log.h"
#include "integrator/contact_settings.h"
#include "integrator/falling.h"
#include "integrator/layer_fire.h"
#include "integrator/phase.h"

namespace noli::audit {

/// Replaces integrator::Contact in an Engine<S, Dim, ReplayedContact<S, Dim>>.
template <class S, int Dim>
class ReplayedContact {
 public:
  using Scalar = S;
  using Particles = std::vector<integrator::Particle<S, Dim>>;

  ReplayedContact(const integrator::ContactSettings& settings, const Mesh&, Particles& particles,
                  const std::vector<double>&, double)
      : particles_(particles), layer_fire_(settings.inclusion_exclusion) {}
  ReplayedContact(const ReplayedContact&) = delete;
  ReplayedContact& operator=(const ReplayedContact&) = delete;

  /// Sets the log of the next window. Keep it unchanged until the window and all queries about its end are done.
  void follow(const EventLog<Dim>& log) {
    log_ = &log;
    next_ = 0;
  }

  std::vector<integrator::Anchor<S>> anchors(double t) const { return layer_fire_.anchors().after(t); }
  void restore(std::span<const integrator::Anchor<S>> anchors) { layer_fire_.anchors().restore(anchors); }

  bool started() const { return started_; }
  void start(double) { started_ = true; }
  void show(integrator::Activity&) {}
  void forget_extremes() {}
  void look(VertexId, double) {}
  double next_certificate() const { return never; }
  void run_certificate() {}

  double next_layer() const { return next_ < log_->firings().size() ? log_->firings()[next_].firing.time : never; }

  template <class Recorder>
  std::size_t fire_next(Recorder& record, integrator::Books<S, Dim>& books, integrator::ScriptBook<S, Dim>& scripts,
                        integrator::Falling<S, Dim>& falling) {
    const LoggedFiring& logged = log_->firings()[next_++];
    const integrator::Firing& firing = logged.firing;
    const integrator::Kicked<S, Dim, Recorder> now{particles_, record, firing.time, &scripts};
    record.layer_fires(firing);
    record.reserve(4 * (logged.end - logged.begin));
    integrator::Account<S, Dim>& account = books.contact[firing.terms.material];
    std::size_t acted = 0;
    pairs_.clear();
    for (const Examined& examined : log_->examined().subspan(logged.begin, logged.end - logged.begin)) {
      pairs_.push_back(examined.pair);
    }
    layer_fire_(
        now, pairs_, firing.terms, firing.h, account,
        [&](std::size_t i, const integrator::Approach<S, Dim>& approach, const integrator::Course& course) {
          record.examined(pairs_[i], approach.with_corners(course));
          if (course.acts) ++acted;
        },
        [this](const certificates::Stencil& pair, const certificates::Closest<Dim, S>& closest) {
          integrator::for_each_struck<S, Dim>(pair, closest, [this](VertexId v) { struck_.push_back(v); });
        });
    account.events += acted;
    for (const VertexId i : struck_) falling.strike(i, firing.terms.material, firing.time);
    struck_.clear();
    return acted;
  }

  /// The firings of time 0: nothing else happens then.
  template <class Recorder>
  void fire_halves(Recorder& record, integrator::Books<S, Dim>& books, integrator::ScriptBook<S, Dim>& scripts,
                   integrator::Falling<S, Dim>& falling) {
    while (next_layer() <= 0) fire_next(record, books, scripts, falling);
  }

  /// Like Contact::for_each_acting, for the pairs that are active in the log.
  template <class Each>
  void for_each_acting(Each&& each) const {
    const auto position = [this](VertexId v) { return particles_[v].x; };
    for (const ActiveLayer& active : log_->active()) {
      layer_fire_.for_each_acting(active.pairs, active.terms, position,
                                  [&](const auto& pair, const auto& closest, const S& g, const S& weight) {
                                    each(pair, closest, g, S(weight * S(active.terms.stiffness)), active.step);
                                  });
    }
  }

 private:
  static constexpr double never = std::numeric_limits<double>::infinity();

  Particles& particles_;
  const EventLog<Dim>* log_ = nullptr;
  std::size_t next_ = 0;
  integrator::LayerFire<S, Dim> layer_fire_;
  std::vector<certificates::Stencil> pairs_;  ///< for which a layer fires
  std::vector<VertexId> struck_;              ///< by that layer; may repeat
  bool started_ = false;
};

}  // namespace noli::audit
