// SPDX-License-Identifier: Apache-2.0
#include "audit/numerics/integrator_audit.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "audit/numerics/implicit_euler.h"
#include "audit/numerics/one_step.h"
#include "audit/numerics/sampled_run.h"
#include "certify/json.h"
#include "integrator/scene/build_model.h"

namespace noli::audit {
namespace {

using integrator::Model;

/// Passes shorter than `short_pass` [s] of CPU time in total are repeated, up to `most_repetitions` in all.
constexpr double short_pass = 0.1;
constexpr int most_repetitions = 5;

struct Interrupted {};
struct NotFinite {};

template <int Dim>
class Reference {
 public:
  /// If `coarse` is null, the reference is the fine run itself.
  Reference(const Model<double, Dim>& model, const SampledRun<Dim>& fine, const SampledRun<Dim>* coarse)
      : model_(model), free_(free_vertices(model)) {
    for (std::size_t i = 0; i < fine.samples.size(); ++i) {
      Sample<Dim> sample = fine.samples[i];
      if (coarse != nullptr) extrapolate(sample.x, coarse->samples[i].x);
      if (coarse != nullptr) extrapolate(sample.v, coarse->samples[i].v);
      Mechanics<Dim> m = mechanics(model, sample);
      // The fine run conserves its momenta up to rounding; products of extrapolated values do not.
      const Mechanics<Dim> kept = mechanics(model, fine.samples[i]);
      m.momentum = kept.momentum;
      m.angular_momentum = kept.angular_momentum;
      mechanics_.push_back(m);
      kinetic_ = std::max(kinetic_, m.kinetic);
      speeds_ = std::max(speeds_, m.speeds);
      moments_ = std::max(moments_, m.moments);
      samples_.push_back(std::move(sample));
    }
  }

  const std::vector<Sample<Dim>>& samples() const { return samples_; }

  IntegratorErrors errors(const std::vector<Sample<Dim>>& samples) const {
    IntegratorErrors worst;
    for (std::size_t i = 0; i < samples.size(); ++i) {
      const Mechanics<Dim> m = mechanics(model_, samples[i]), &r = mechanics_[i];
      worst.energy = std::max(worst.energy, part(std::abs(m.energy() - r.energy()), kinetic_));
      worst.momentum = std::max(worst.momentum, part((m.momentum - r.momentum).norm(), speeds_));
      worst.angular_momentum =
          std::max(worst.angular_momentum, part((m.angular_momentum - r.angular_momentum).norm(), moments_));
      worst.trajectory = std::max(worst.trajectory, distance(samples[i], samples_[i]));
    }
    return worst;
  }

 private:
  static void extrapolate(std::vector<integrator::Vec<double, Dim>>& fine,
                          const std::vector<integrator::Vec<double, Dim>>& coarse) {
    for (std::size_t v = 0; v < fine.size(); ++v) fine[v] += (fine[v] - coarse[v]) / 3;
  }

  /// A scene that does not move has nothing to measure an error against, and no error.
  static double part(double error, double scale) { return scale > 0 ? error / scale : 0; }

  double distance(const Sample<Dim>& a, const Sample<Dim>& b) const {
    double sum = 0, mass = 0;
    for (std::size_t v = 0; v < free_.size(); ++v) {
      if (!free_[v]) continue;
      sum += model_.mass[v] * (a.x[v] - b.x[v]).squaredNorm();
      mass += model_.mass[v];
    }
    return mass > 0 ? std::sqrt(sum / mass) : 0;
  }

  const Model<double, Dim>& model_;
  std::vector<bool> free_;
  std::vector<Sample<Dim>> samples_;
  std::vector<Mechanics<Dim>> mechanics_;
  double kinetic_ = 0, speeds_ = 0, moments_ = 0;
};

template <int Dim>
class Audit {
 public:
  Audit(const integrator::Scene& scene, const IntegratorOptions& options)
      : options_(options), model_(integrator::build_model<Dim>(scene).model), least_(audit::least_step(model_)) {
    const double all = std::ceil(scene.duration / model_.window_length - 1e-9);
    result_.title = scene.title;
    result_.dimension = Dim;
    result_.vertices = model_.x.size();
    result_.windows = static_cast<int>(std::min<double>(options.windows, std::max(1.0, all)));
    result_.window_length = model_.window_length;
    result_.plain = plain_enough(model_);
    result_.shortest_step = std::numeric_limits<double>::infinity();
    for_each_list(model_, [this](auto& list) {
      result_.forces += list.forces.size();
      for (const double h : list.steps) {
        result_.shortest_step = std::min(result_.shortest_step, h);
        result_.longest_step = std::max(result_.longest_step, h);
      }
    });
    if (result_.forces == 0) result_.shortest_step = 0;
  }

  IntegratorResult run() {
    try {
      const Reference<Dim> reference = make_reference();
      asynchronous("own", integrator::Clocks::own, reference);
      asynchronous("grouped", integrator::Clocks::grouped, reference);
      halved("verlet", reference, [this](double factor) { return verlet(factor * least_); });
      if (result_.plain && options_.euler) euler(reference);
    } catch (const Interrupted&) {
      result_.complete = false;
    } catch (const NotFinite&) {
      result_.reference_finite = false;
    }
    return std::move(result_);
  }

 private:
  SampledRun<Dim> checked(SampledRun<Dim> run) const {
    if (stopped(options_.stop)) throw Interrupted();
    return run;
  }

  SampledRun<Dim> verlet(double step) const {
    if (result_.plain) return run_plain(model_, step, result_.windows, options_.stop);
    Model<double, Dim> model = model_;
    model.clocks = integrator::Clocks::grouped;
    scale_steps(model, step / least_);
    set_steps(model, step);
    return run_with_clocks(model, result_.windows, options_.stop);
  }

  Reference<Dim> make_reference() {
    const double r = std::ldexp(least_, -options_.halvings - 1);
    options_.begun("reference", r / least_);
    const SampledRun<Dim> coarse = checked(verlet(r)), fine = checked(verlet(r / 2));
    if (!coarse.finite || !fine.finite) throw NotFinite();
    Reference<Dim> reference(model_, fine, result_.plain ? &coarse : nullptr);
    if (!result_.plain) {
      result_.uncertainty = reference.errors(coarse.samples);
      return reference;
    }
    const SampledRun<Dim> coarser = checked(verlet(2 * r));
    if (!coarser.finite) throw NotFinite();
    const Reference<Dim> other(model_, coarse, &coarser);
    result_.uncertainty = reference.errors(other.samples());
    return reference;
  }

  void asynchronous(const char* name, integrator::Clocks clocks, const Reference<Dim>& reference) {
    halved(name, reference, [&](double factor) {
      Model<double, Dim> model = model_;
      model.clocks = clocks;
      scale_steps(model, factor);
      return run_with_clocks(model, result_.windows, options_.stop);
    });
  }

  template <class Run>
  void halved(const char* name, const Reference<Dim>& reference, const Run& run) {
    result_.methods.push_back({name, {}});
    for (int i = 0; i <= options_.halvings; ++i) {
      const double factor = std::ldexp(1.0, -i);
      point(factor, factor * (std::string(name) == "own" ? result_.shortest_step : least_), reference,
            [&] { return run(factor); });
    }
  }

  void euler(const Reference<Dim>& reference) {
    result_.methods.push_back({"euler", {}});
    for (int i = 0; i <= options_.halvings; ++i) {
      const double factor = std::ldexp(1.0, -2 * i), step = factor * model_.window_length;
      if (step < least_) break;
      point(factor, step, reference, [&] { return run_implicit_euler(model_, step, result_.windows, options_.stop); });
    }
  }

  template <class Run>
  void point(double factor, double step, const Reference<Dim>& reference, const Run& run) {
    MethodResult& method = result_.methods.back();
    options_.begun(method.method, factor);
    std::vector<double> seconds;
    SampledRun<Dim> last;
    double sum = 0;
    do {
      last = checked(run());
      seconds.push_back(last.seconds);
      sum += last.seconds;
    } while (sum < short_pass && seconds.size() < most_repetitions);
    std::sort(seconds.begin(), seconds.end());
    IntegratorPoint point{factor, step, last.events, last.finite, last.converged, {}, seconds[seconds.size() / 2]};
    if (last.finite) point.errors = reference.errors(last.samples);
    method.points.push_back(point);
  }

  const IntegratorOptions& options_;
  Model<double, Dim> model_;
  double least_;
  IntegratorResult result_;
};

}  // namespace

bool IntegratorResult::has_finding() const {
  return !reference_finite || std::ranges::any_of(methods, [](const MethodResult& method) {
    return method.method != "euler" && !std::ranges::all_of(method.points, &IntegratorPoint::finite);
  });
}

IntegratorResult audit_integrator(const integrator::Scene& scene, const IntegratorOptions& options) {
  if (scene.dimension == 2) return Audit<2>(scene, options).run();
  return Audit<3>(scene, options).run();
}

std::vector<std::string> integrator_scenes() {
  const std::string uniform = R"({
  "noli_scene": 1,
  "title": "Uniform sheet",
  "about": "A free plate, twisted and stretched a little, that is let go, flies and spins; all cells are of one size.",
  "duration": 0.08,
  "window": 0.01,
  "bodies": [
    {
      "name": "sheet",
      "mesh": {"grid": {"size": [0.5, 0.5], "cells": [12, 12]}},
      "deform": {"stretch": [1.002, 0.999, 1], "twist": 20},
      "perturb": 0.00001,
      "velocity": [0.3, 0.2, 0.1],
      "spin": [0.2, 0.3, 2],
      "material": {"young": 1e5, "poisson": 0.3, "density": 300, "thickness": 0.01}
    }
  ]
}
)";
  Json graded = Json::parse(uniform);
  graded["title"] = "Graded sheet";
  graded["about"] = "The same plate, but in one place its cells are sixteen times smaller.";
  graded["bodies"][0]["mesh"]["grid"]["refine"] = {{"at", {0.1, 0.05}}, {"factor", 16}, {"radius", 0.001}};
  return {uniform, graded.dump()};
}

}  // namespace noli::audit
