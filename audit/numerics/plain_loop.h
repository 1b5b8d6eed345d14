// SPDX-License-Identifier: Apache-2.0
//
// Implements the baseline for the integrator: the plain loop for forces that all have one step. It uses the same forces
// and formulas, without clocks, energy accounts or recording. It has no damping, no scripts and no contact.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "integrator/model.h"

namespace noli::audit {

template <int Dim>
class PlainLoop {
 public:
  using Vec = integrator::Vec<double, Dim>;

  PlainLoop(integrator::Model<double, Dim> model, double step)
      : forces_(std::move(model.forces)),
        gravity_(std::move(model.gravity)),
        x_(std::move(model.x)),
        v_(std::move(model.v)),
        step_(step) {
    for (const double m : model.mass) inverse_mass_.push_back(1 / m);
    for (const VertexId i : model.pinned) {
      inverse_mass_[i] = 0;
      v_[i].setZero();
    }
  }

  /// Half a kick. Call before the first step() to make the scheme second order from the start.
  void start() { kick_all(0.5 * step_, v_); }

  /// One step of Verlet's method: all vertices drift, then all forces kick.
  [[gnu::flatten]] void step() {
    for (std::size_t i = 0; i < x_.size(); ++i) x_[i] += step_ * v_[i];
    kick_all(step_, v_);
  }

  std::uint64_t forces() const {
    return std::apply([](const auto&... list) { return (list.forces.size() + ...); }, forces_.lists());
  }

  const std::vector<Vec>& positions() const { return x_; }
  /// Velocities halfway through the last kick. If start() was called, they are those of the current time.
  std::vector<Vec> mean_velocities() const {
    std::vector<Vec> v = v_;
    kick_all(-0.5 * step_, v);
    return v;
  }

 private:
  void kick_all(double h, std::vector<Vec>& v) const {
    std::apply([&](const auto&... list) { (kick(list.forces, h, v), ...); }, forces_.lists());
    if (!gravity_) return;
    for (std::size_t i = 0; i < v.size(); ++i) {
      if (inverse_mass_[i] != 0) v[i] += h * gravity_->acceleration;
    }
  }

  template <class F>
  void kick(const std::vector<F>& forces, double h, std::vector<Vec>& v) const {
    integrator::VertexVectors<double, Dim, F::size> x;
    for (const F& force : forces) {
      for (std::size_t i = 0; i < F::size; ++i) x[i] = x_[force.vertices[i]];
      const auto gradient = force.gradient(x);
      for (std::size_t i = 0; i < F::size; ++i) {
        v[force.vertices[i]] -= (h * inverse_mass_[force.vertices[i]]) * gradient[i];
      }
    }
  }

  integrator::Forces<double, Dim> forces_;
  std::optional<integrator::Gravity<double, Dim>> gravity_;
  std::vector<Vec> x_, v_;
  std::vector<double> inverse_mass_;
  double step_;
};

}  // namespace noli::audit
