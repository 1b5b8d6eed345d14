// SPDX-License-Identifier: Apache-2.0
#include "certify/simulate/energy_watch.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace noli {
namespace {

double without_gravity(const SeriesRow& row) {
  return row.kinetic_mean + row.potential_in_all() - row.potential[static_cast<std::size_t>(ForceKind::gravity)];
}

}  // namespace

void EnergyWatch::Farthest::add(double off_now, double change_now, double time_now) {
  if (!std::isfinite(off) || (std::isfinite(change_now) && off_now <= off)) return;
  off = std::isfinite(change_now) ? off_now : std::numeric_limits<double>::infinity();
  change = change_now;
  time = time_now;
}

void EnergyWatch::add(const SeriesRow& row) {
  if (!begin_) begin_ = row.energy_before();
  const double damping = row.damping_in_all(), held = row.held_in_all();
  integration_ += row.integration;
  double created = 0;
  for (std::size_t k = 0; k < force_kinds; ++k) {
    if (k == static_cast<std::size_t>(ForceKind::contact)) continue;  // its anchors give back what they have taken
    damping_[k] += row.damping_work[k];
    least_damping_[k] = std::min(least_damping_[k], damping_[k]);
    created += damping_[k] - least_damping_[k];
  }
  dissipated_ += damping + row.restitution_work;
  restitution_ += row.restitution_work;
  contact_ = contact_ || row.events[static_cast<std::size_t>(ForceKind::contact)] > 0;
  moved_ += std::abs(damping) + std::abs(held) + std::abs(row.restitution_work);
  greatest_ = std::max(greatest_, without_gravity(row));
  for (const double made : {integration_, integration_ + created}) either_way_.add(std::abs(made), made, row.time);
  up_.add(integration_ + dissipated_, integration_ + dissipated_, row.time);
}

std::optional<EnergyAstray> EnergyWatch::astray() const {
  const bool may_fall = restitution_ < 0 || (stable_ && contact_ && dissipated_ < 0);
  const Farthest& farthest = may_fall ? up_ : either_way_;
  const double scale = greatest_ + moved_ + rounding_;
  if (farthest.off <= most * scale && std::isfinite(farthest.off)) return std::nullopt;
  return EnergyAstray{*begin_, *begin_ + farthest.change, farthest.time, scale, may_fall};
}

Json energy_json(const EnergyAstray& energy) {
  return {{"begin", energy.begin}, {"there", energy.there}, {"time", energy.time}};
}

}  // namespace noli
