// SPDX-License-Identifier: Apache-2.0
//
// Whether the energy of a run stays: whether steps are so long, or so much in time with an oscillation
// (integrator/resonance.h), that they create or destroy energy.
//
// Notation
//   K, V      kinetic energy and the sum of all potentials at a window's end
//   B         K + V less what damping, friction and scripts gave since the beginning: stable steps leave it within a
//             few hundredths where it was
//   scale     the greatest K + V seen, without the potential of gravity, whose zero means nothing, or at least K at the
//             beginning; and all that was given, whatever its sign; and what rounding may create
//
// Asynchronous variational integrators keep a nearby energy and not this one (Harmon et al. 2009, section 3), so B
// trembles. It has gone astray where it is off by more than a twentieth of the scale, either way.
//
// Where restitution takes energy, forces that press on layers are booked for energy that the layers take back before
// the next kick (docs/contact.md, section 6): restitution and damping are booked for more than things have lost. There
// B is K + V less what scripts gave alone, and has gone astray only above its beginning.
//
// What this does not do: between the ends of windows nobody looks. Where restitution takes energy, what steps create
// is not seen as long as damping, friction and restitution take more.
#pragma once

#include <optional>

#include <noli/run.h>
#include "certify/json.h"

namespace noli {

class EnergyWatch {
 public:
  /// How far B may go, in parts of the scale.
  static constexpr double most = 0.05;

  /// `kinetic`: K at the beginning [J]. `rounding`: the energy that rounding may create [J].
  explicit EnergyWatch(double kinetic = 0, double rounding = 0) : rounding_(rounding), greatest_(kinetic) {}

  /// The next window.
  void add(const SeriesRow& row);

  /// Of the windows so far; nothing if B stays. What is no number has gone astray.
  std::optional<EnergyAstray> astray() const;

  /// What finite steps did so far [J].
  double integration() const { return integration_; }

 private:
  /// Where B was farthest from its beginning.
  struct Farthest {
    double off = 0, change = 0, time = 0;

    /// `off`: what counts of the change.
    void add(double off_now, double change_now, double time_now);
  };

  double rounding_;
  double greatest_;
  std::optional<double> begin_;  ///< K + V
  double integration_ = 0;
  double dissipated_ = 0;  ///< work of damping, friction and restitution
  double restitution_ = 0;
  double moved_ = 0;          ///< what was given, whatever its sign
  Farthest either_way_, up_;  ///< of the two forms of B
};

/// {"begin": J, "there": J, "time": s}; null for what is no number.
Json energy_json(const EnergyAstray& energy);

}  // namespace noli
