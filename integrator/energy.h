// SPDX-License-Identifier: Apache-2.0
//
// Computes energies and momenta of a simulation at a window's end.
//
// Notation
//   v_mean   the velocity half way through the kicks that act at this time: v less half of each. Forces whose clocks do
//            not strike at the window's end have none; with grouped steps all strike. It is computed, never written
//
// Velocities of leapfrog are those of half a step later; v_mean is of second order at this time (Harmon et al. 2009
// leave it open; see also Hairer, Lubich, Wanner, "Geometric numerical integration illustrated by the Stormer-Verlet
// method", 2003, section 1.4).
//
// v_mean includes everything that damping, friction and restitution have taken up to this time, like the books. The
// work of scripts is booked for whole kicks; the half of it that is still to come is held_ahead.
#pragma once

#include <cmath>

#include "integrator/engine.h"

namespace noli::integrator {

template <class S, int Dim, class Touching = void>
class Ledger {
 public:
  explicit Ledger(const Engine<S, Dim, Touching>& engine) : engine_(engine) {
    for (const auto& p : engine.particles()) v_mean_.push_back(p.v);
    engine_.for_each_division([&](const auto& division) { add_division(division); });
    if (!engine_.falling().empty()) add_gravity();
    if (engine_.contact() != nullptr) add_contact();
    for (std::size_t i = 0; i < v_mean_.size(); ++i) add_particle(i);
  }

  const State<S, Dim>& state() const { return state_; }
  const std::vector<Vec<S, Dim>>& mean_velocities() const { return v_mean_; }

 private:
  bool strikes(double h) const {
    const double t = engine_.time();
    return t > 0 && static_cast<double>(first_after(t, h) - 1) * h == t;
  }

  template <class F>
  void add_division(const Division<F>& division) {
    S potential{};
    for (std::size_t k = 0; k < division.list.forces.size(); ++k) {
      const F& force = division.list.forces[k];
      const double h = division.list.steps[k];
      VertexVectors<S, Dim, F::size> x;
      for (std::size_t i = 0; i < F::size; ++i) x[i] = engine_.particles()[force.vertices[i]].x;
      potential += force.energy(x);
      if (!strikes(h)) continue;
      const VertexVectors<S, Dim, F::size> gradient = force.gradient(x);
      const S half_step = S(0.5) * S(h);
      for (std::size_t i = 0; i < F::size; ++i) {
        const VertexId v = force.vertices[i];
        const Particle<S, Dim>& p = engine_.particles()[v];
        v_mean_[v] += (half_step * p.inverse_mass) * gradient[i];
        if (p.inverse_mass == S(0)) state_.held_ahead += half_step * gradient[i].dot(p.v);
      }
    }
    state_.potential[static_cast<std::size_t>(F::kind)] = potential;
  }

  void add_gravity() {
    const auto& falling = engine_.falling();
    S potential{};
    for (std::size_t i = 0; i < v_mean_.size(); ++i) {
      const auto& p = engine_.particles()[i];
      if (p.inverse_mass == S(0)) continue;
      potential -= engine_.masses()[i] * falling.acceleration().dot(p.x);
      v_mean_[i] -= S(falling.lead(static_cast<VertexId>(i))) * falling.acceleration();
    }
    state_.potential[static_cast<std::size_t>(ForceKind::gravity)] = potential;
  }

  void add_contact() {
    if constexpr (std::is_same_v<S, typename Engine<S, Dim, Touching>::ContactType::Scalar>) {
      S potential{};
      engine_.contact()->for_each_acting([&](const certificates::Stencil& pair, const certificates::Closest<Dim, S>& c,
                                             const S& g, const S& r, double h) {
        potential += S(0.5) * r * g * g;
        if (!strikes(h)) return;
        const auto impulses = normal_impulses<Dim, S>(c, c.distance(), S(-0.5) * S(h) * r * g);
        for (std::size_t i = 0; i < pair.size(); ++i) {
          const VertexId v = pair.vertices[i];
          const Particle<S, Dim>& p = engine_.particles()[v];
          v_mean_[v] -= p.inverse_mass * impulses[i];
          if (p.inverse_mass == S(0)) state_.held_ahead -= impulses[i].dot(p.v);
        }
      });
      state_.potential[static_cast<std::size_t>(ForceKind::contact)] = potential;
    }
  }

  void add_particle(std::size_t i) {
    using std::sqrt;
    const auto& p = engine_.particles()[i];
    if (p.inverse_mass == S(0)) return;
    const S m = engine_.masses()[i];
    state_.kinetic += S(0.5) * m * p.v.squaredNorm();
    state_.kinetic_mean += S(0.5) * m * v_mean_[i].squaredNorm();
    state_.momentum += m * p.v;
    state_.angular_momentum += m * moment<S, Dim>(p.x, p.v);
    const S speed = sqrt(p.v.squaredNorm());
    state_.speeds += m * speed;
    state_.moments += m * speed * sqrt(p.x.squaredNorm());
  }

  const Engine<S, Dim, Touching>& engine_;
  std::vector<Vec<S, Dim>> v_mean_;
  State<S, Dim> state_;
};

}  // namespace noli::integrator
