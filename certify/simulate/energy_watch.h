// SPDX-License-Identifier: Apache-2.0
//
// Whether the energy of a run stays: whether steps are so long, or so much in time with an oscillation
// (integrator/resonance.h), that they make energy of nothing.
//
// Notation
//   K, V      kinetic energy and the sum of all potentials at a window's end
//   B         K + V less what damping, friction and scripts gave since the beginning: stable steps leave it within a
//             few hundredths where it was
//   scale     the greatest K + V seen, without the potential of gravity, whose zero means nothing; and all that was
//             given, whatever its sign; and the least energy that is more than rounding's
//
// Asynchronous variational integrators keep a nearby energy and not this one (Harmon et al. 2009, section 3), so B
// trembles. It has gone astray where it is off by more than a twentieth of the scale, either way.
//
// Where restitution takes energy, layers of contact jerk what they hold, at times that no force shares. Damping takes
// that up, and what it and restitution are booked for is more than things have really lost. There B is K + V less what
// scripts gave alone. It has to fall, so it is astray only if it rises.
//
// What this does not do: between the ends of windows nobody looks.
#pragma once

#include <optional>

#include <noli/run.h>
#include "certify/json.h"

namespace noli {

class EnergyWatch {
 public:
  /// How far B may go, in parts of the scale.
  static constexpr double most = 0.05;

  /// `least`: the energy that rounding may make of nothing [J].
  explicit EnergyWatch(double least = 0) : least_(least) {}

  /// The next window.
  void add(const SeriesRow& row);

  /// Of the windows so far; nothing if B stays. What is no number has gone astray.
  std::optional<EnergyAstray> astray() const;

  /// What finite steps did so far [J].
  double integration() const { return integration_; }

 private:
  double least_;
  bool any_ = false;
  double integration_ = 0;
  double dissipated_ = 0;  ///< work of damping, friction and restitution
  double restitution_ = 0;
  double moved_ = 0;  ///< what was given, whatever its sign
  double greatest_ = 0;
  double worst_ = 0;  ///< of the distances of B from its beginning that count
  EnergyAstray found_;
};

/// {"begin": J, "there": J, "time": s}; null for what is no number.
Json energy_json(const EnergyAstray& energy);

}  // namespace noli
