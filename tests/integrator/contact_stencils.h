// SPDX-License-Identifier: Apache-2.0
//
// Generates random pairs of near features and computes the effect of impulses on them.
//
// Notation: that of integrator/contact_impulse.h.
#pragma once

#include <cmath>
#include <cstdint>
#include <span>

#include "integrator/books.h"
#include "integrator/contact_impulse.h"
#include "models.h"

namespace noli::integrator::test {

/// A stream of numbers that depends only on the seed.
class Stream {
 public:
  explicit Stream(std::uint64_t seed) : state_(seed * 1000003) {}
  double between(double low, double high) { return low + (high - low) * (0.5 + 0.5 * noise(state_++)); }
  double decades(double low, double high) { return low * std::pow(high / low, between(0, 1)); }
  bool chance(double probability) { return between(0, 1) < probability; }
  template <int Dim>
  Vec<double, Dim> vector(double size) {
    Vec<double, Dim> v;
    for (int k = 0; k < Dim; ++k) v[k] = between(-size, size);
    return v;
  }

 private:
  std::uint64_t state_;
};

template <int Dim>
struct NearFeatures {
  FeaturePair kind;
  std::array<Vec<double, Dim>, 4> x, v;
  std::array<double, 4> inverse_mass{};
  double eta = 0;  ///< the features are nearer than this

  std::size_t size() const { return point_count(kind); }
  std::span<const Vec<double, Dim>> xs() const { return {x.data(), size()}; }
  std::span<const Vec<double, Dim>> vs() const { return {v.data(), size()}; }
  std::span<const double> inverse_masses() const { return {inverse_mass.data(), size()}; }
  certificates::Closest<Dim> closest() const { return certificates::closest<Dim>(kind, xs()); }

  /// The work of impulses on the pair, including its pinned and driven vertices: the sum of J . (v + v') / 2. If those
  /// rest, it is the change of kinetic energy.
  double work(const Impulses<Dim>& impulses) const {
    double sum = 0;
    for (std::size_t i = 0; i < size(); ++i) sum += impulses[i].dot(v[i] + (0.5 * inverse_mass[i]) * impulses[i]);
    return sum;
  }
  /// A bound on the terms of work(), as a scale for rounding.
  double work_scale(const Impulses<Dim>& impulses) const {
    double sum = 0;
    for (std::size_t i = 0; i < size(); ++i) {
      sum += impulses[i].norm() * (v[i].norm() + inverse_mass[i] * impulses[i].norm());
    }
    return sum;
  }

  void give(const Impulses<Dim>& impulses) {
    for (std::size_t i = 0; i < size(); ++i) v[i] += inverse_mass[i] * impulses[i];
  }

  Vec<double, Dim> momentum_of(const Impulses<Dim>& impulses) const {
    Vec<double, Dim> sum = Vec<double, Dim>::Zero();
    for (std::size_t i = 0; i < size(); ++i) sum += impulses[i];
    return sum;
  }
  Moment<double, Dim> angular_momentum_of(const Impulses<Dim>& impulses) const {
    Moment<double, Dim> sum = Moment<double, Dim>::Zero();
    for (std::size_t i = 0; i < size(); ++i) sum += moment<double, Dim>(x[i], impulses[i]);
    return sum;
  }
  double impulse_scale(const Impulses<Dim>& impulses) const {
    double sum = 0;
    for (std::size_t i = 0; i < size(); ++i) sum += impulses[i].norm();
    return sum;
  }
  double moment_scale(const Impulses<Dim>& impulses) const {
    double sum = 0;
    for (std::size_t i = 0; i < size(); ++i) sum += impulses[i].norm() * x[i].norm();
    return sum;
  }
};

/// Random features with edges of length about 1, all regions of closest points, and distances from eta / 10^4 to eta.
/// Some have coincident vertices, sliver faces, or edges that are parallel or nearly so. Some vertices, but not all,
/// are immovable, at rest or driven.
template <int Dim>
NearFeatures<Dim> near_features(FeaturePair kind, std::uint64_t seed) {
  Stream random(seed);
  NearFeatures<Dim> f;
  f.kind = kind;
  const std::size_t n = f.size();
  const double speed = random.decades(1e-3, 1e3);
  const Vec<double, Dim> drift = random.vector<Dim>(10 * speed);
  for (std::size_t i = 0; i < n; ++i) {
    f.x[i] = random.vector<Dim>(1);
    f.v[i] = random.vector<Dim>(speed);
    if (random.chance(0.5)) f.v[i] += drift;
    f.inverse_mass[i] = random.chance(0.2) ? 0 : random.decades(1e-3, 1e3);
    if (f.inverse_mass[i] == 0 && random.chance(0.5)) f.v[i].setZero();
  }
  f.inverse_mass[seed % n] = 1;
  if (n == 4) {
    const double sort = random.between(0, 1), away = random.decades(1e-14, 1);
    if (sort < 0.1) f.x[3] = f.x[2];
    if (sort > 0.9) f.x[3] = f.x[2] + random.between(-2, 2) * (f.x[1] - f.x[0]);
    if (sort > 0.95) f.x[3] += random.vector<Dim>(away);
    if (sort > 0.1 && sort < 0.2) f.x[3] = 0.5 * (f.x[1] + f.x[2]) + random.vector<Dim>(away);
  }
  f.eta = random.decades(1e-4, 0.3);
  const auto c = f.closest();  // unchanged while A moves along r
  if (c.distance() > 0) {
    const double d = f.eta * random.decades(1e-4, 1);
    for (std::size_t i = 0; i < first_size(kind); ++i) f.x[i] -= (1 - d / c.distance()) * c.r;
  }
  return f;
}

}  // namespace noli::integrator::test
