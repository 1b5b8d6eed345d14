// SPDX-License-Identifier: Apache-2.0
//
// Watches the energy of a run: steps that are too long, or in resonance with an oscillation (integrator/resonance.h),
// create or destroy energy.
//
// Notation
//   K, V      kinetic energy and the sum of all potentials at a window's end
//   B         K + V less what damping, friction and scripts gave since the beginning. Stable steps change it by a few
//             hundredths. Damping only takes energy: what that of a kind of force gives since its work was least stays
//             in B, as the steps are then too long for it (integrator/stable_step.h)
//   scale     the sum of three: the greatest K + V seen, without the potential of gravity, whose zero is arbitrary (at
//             least K at the beginning); everything given, in magnitude; the energy that rounding may create
//
// Asynchronous variational integrators conserve a nearby energy and not this one (Harmon et al. 2009, section 3), so B
// fluctuates. It has gone astray if it is off by more than a twentieth of the scale in either direction.
//
// Forces that press on layers are booked for energy that is taken back before their next kick (docs/contact.md, section
// 6). What takes it may be restitution, damping or friction, which are then booked for more than bodies have lost. Once
// a layer has acted, and if together they took energy, B is therefore K + V less only what scripts gave, and has gone
// astray only if it is above its beginning. If the scene allows steps above their limits, this holds for restitution
// only: damping and friction may then take what unstable steps create.
//
// Only the ends of windows are checked. Where B leaves out only what scripts gave, energy that steps create goes
// unnoticed as long as damping, friction and restitution take more.
#pragma once

#include <array>
#include <optional>

#include <noli/run.h>
#include "certify/json.h"

namespace noli {

class EnergyWatch {
 public:
  /// How far B may be off, as a share of the scale.
  static constexpr double most = 0.05;

  /// `kinetic`: K at the beginning [J]. `rounding`: the energy that rounding may create [J]. `stable`: the scene allows
  /// no steps above their limits.
  explicit EnergyWatch(double kinetic = 0, double rounding = 0, bool stable = true)
      : rounding_(rounding), stable_(stable), greatest_(kinetic) {}

  void add(const SeriesRow& row);

  /// Where B has gone astray in the windows so far; nothing if it has not. A NaN counts as astray.
  std::optional<EnergyAstray> astray() const;

  /// What finite steps did so far [J].
  double integration() const { return integration_; }

 private:
  /// Where B was farthest from its beginning.
  struct Farthest {
    double off = 0, change = 0, time = 0;

    /// `off_now`: the part of the change that counts.
    void add(double off_now, double change_now, double time_now);
  };

  double rounding_;
  bool stable_;
  double greatest_;
  std::optional<double> begin_;  ///< K + V
  double integration_ = 0;
  std::array<double, force_kinds> damping_{}, least_damping_{};  ///< work of damping so far, and its least
  double dissipated_ = 0;                                        ///< work of damping, friction and restitution
  double restitution_ = 0;
  bool contact_ = false;      ///< a layer has acted
  double moved_ = 0;          ///< everything given, in magnitude
  Farthest either_way_, up_;  ///< of the two forms of B
};

/// {"begin": J, "there": J, "time": s}; null for a NaN or an infinity.
Json energy_json(const EnergyAstray& energy);

}  // namespace noli
