// SPDX-License-Identifier: Apache-2.0
//
// Whether the energy of a run stays, where its steps may be unstable: longer than what is known to be safe
// (`allow_unstable`), or in time with an oscillation (integrator/resonance.h).
//
// Notation
//   K, V   kinetic energy and the sum of all potentials, at the beginning or at the end of a window
//   D      what damping and friction have taken from the beginning to there, not positive
//   B      K + V - D, which forces that are potentials, and stable steps, leave within a few hundredths where it was
//   scale  the greatest K + V seen, without the potential of gravity, whose zero means nothing
//
// Asynchronous variational integrators keep a nearby energy and not this one (Harmon et al. 2009, section 3), so B
// trembles. It has gone astray where it is off by more than a twentieth of the scale, either way; only upwards where
// restitution below 1 takes energy that no book has.
//
// What this does not do: scripts put work in that no book has, so a scene with scripts cannot be watched. Between the
// ends of windows nobody looks.
#pragma once

#include <array>
#include <optional>

#include <noli/run.h>
#include "certify/json.h"
#include "certify/runs/run_series.h"
#include "integrator/scene/explain.h"
#include "integrator/scene/scene.h"

namespace noli {

class EnergyWatch {
 public:
  /// How far B may go, in parts of the scale.
  static constexpr double most = 0.05;

  using Potential = std::array<double, integrator::force_kinds>;

  /// Of the beginning. `losses`: restitution is below 1 somewhere.
  EnergyWatch(double kinetic, const Potential& potential, bool losses);

  /// The next window.
  void add(const SeriesRow& row);

  /// Of the windows so far; nothing if B stays. What is no number has gone astray.
  std::optional<EnergyAstray> astray() const;

 private:
  bool losses_;
  double begin_;
  double taken_ = 0;  ///< D
  double worst_ = 0;  ///< of the distances from begin_ that count
  EnergyAstray found_;
};

/// {"begin": J, "there": J, "time": s}; null for what is no number.
Json energy_json(const EnergyAstray& energy);

/// Whether a scene has steps that may be unstable, and nothing that hides what they do.
bool wants_watch(const integrator::Scene& scene, const integrator::Explanation& explanation);

/// Whether contact takes energy that no book has.
bool loses_by_restitution(const std::optional<integrator::ContactSettings>& contact);

}  // namespace noli
