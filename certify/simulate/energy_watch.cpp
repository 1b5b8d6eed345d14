// SPDX-License-Identifier: Apache-2.0
#include "certify/simulate/energy_watch.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace noli {
namespace {

double sum(const EnergyWatch::Potential& parts) { return std::accumulate(parts.begin(), parts.end(), 0.0); }

double without_gravity(double kinetic, EnergyWatch::Potential potential) {
  potential[static_cast<std::size_t>(integrator::ForceKind::gravity)] = 0;
  return kinetic + sum(potential);
}

}  // namespace

EnergyWatch::EnergyWatch(double kinetic, const Potential& potential, bool losses)
    : losses_(losses), begin_(kinetic + sum(potential)) {
  found_ = {begin_, begin_, 0, without_gravity(kinetic, potential)};
}

void EnergyWatch::add(const SeriesRow& row) {
  taken_ += sum(row.damping_work);
  const double there = row.kinetic_mean + sum(row.potential) - taken_;
  const double scale = without_gravity(row.kinetic_mean, row.potential);
  found_.scale = std::max(found_.scale, scale);
  const double off = losses_ ? there - begin_ : std::abs(there - begin_);
  if (off <= worst_ || std::isnan(worst_)) return;
  worst_ = off;
  found_.there = there;
  found_.time = row.time;
}

std::optional<EnergyAstray> EnergyWatch::astray() const {
  if (worst_ <= most * found_.scale && std::isfinite(worst_)) return std::nullopt;
  return found_;
}

Json energy_json(const EnergyAstray& energy) {
  return {{"begin", energy.begin}, {"there", energy.there}, {"time", energy.time}};
}

bool wants_watch(const integrator::Scene& scene, const integrator::Explanation& explanation) {
  if (!scene.scripts.empty()) return false;
  return scene.allow_unstable || !explanation.resonances.empty();
}

bool loses_by_restitution(const std::optional<integrator::ContactSettings>& contact) {
  return contact && std::ranges::any_of(contact->materials, [](const auto& m) { return m.restitution < 1; });
}

}  // namespace noli
