// SPDX-License-Identifier: Apache-2.0
#include "certify/simulate/energy_watch.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace noli {
namespace {

double sum(const std::array<double, force_kinds>& parts) { return std::accumulate(parts.begin(), parts.end(), 0.0); }

double without_gravity(const SeriesRow& row) {
  return row.kinetic_mean + row.potential_in_all() - row.potential[static_cast<std::size_t>(ForceKind::gravity)];
}

}  // namespace

void EnergyWatch::add(const SeriesRow& row) {
  if (!any_) found_.begin = found_.there = row.energy() - row.given() - row.integration;
  any_ = true;
  const double damping = sum(row.damping_work), held = sum(row.held_work);
  integration_ += row.integration;
  dissipated_ += damping + row.restitution_work;
  restitution_ += row.restitution_work;
  moved_ += std::abs(damping) + std::abs(held) + std::abs(row.restitution_work);
  greatest_ = std::max(greatest_, without_gravity(row));
  found_.scale = greatest_ + moved_ + least_;
  const double rise = restitution_ < 0 ? integration_ + dissipated_ : integration_;
  const double off = restitution_ < 0 ? rise : std::abs(rise);
  if (off <= worst_ || std::isnan(worst_)) return;
  worst_ = off;
  found_.there = found_.begin + rise;
  found_.time = row.time;
}

std::optional<EnergyAstray> EnergyWatch::astray() const {
  if (worst_ <= most * found_.scale && std::isfinite(worst_)) return std::nullopt;
  return found_;
}

Json energy_json(const EnergyAstray& energy) {
  return {{"begin", energy.begin}, {"there", energy.there}, {"time", energy.time}};
}

}  // namespace noli
