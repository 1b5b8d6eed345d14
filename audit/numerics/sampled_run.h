// SPDX-License-Identifier: Apache-2.0
//
// Runs one model by several methods and samples positions and velocities at the ends of windows, and the run time, so
// that they can be compared (integrator_audit.h).
//
// Notation
//   W         the model's window; samples are at the times 0, W, 2 W, ...
//   v         the velocity at exactly that time: leapfrog's velocities, half a step off, are corrected
//   free      vertices that are neither pinned nor scripted; energies and momenta count only these
#pragma once

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <ctime>
#include <vector>

#include "audit/numerics/one_step.h"
#include "audit/numerics/plain_loop.h"
#include "integrator/simulation.h"

namespace noli::audit {

template <int Dim>
struct Sample {
  std::vector<integrator::Vec<double, Dim>> x, v;
  double contact = 0;  ///< potential energy of layers of contact [J]
};

template <int Dim>
struct SampledRun {
  std::vector<Sample<Dim>> samples;
  std::uint64_t events = 0;    ///< forces fired, layers of contact among them
  std::uint64_t impulses = 0;  ///< only those of layers of contact
  double seconds = 0;          ///< CPU time of the method's thread
  bool finite = true;          ///< if false, the last sample is the last finite one
  bool converged = true;       ///< implicit methods: every step was solved
};

/// The quantities that the motion conserves, or should conserve.
template <int Dim>
struct Mechanics {
  double kinetic = 0, potential = 0;  ///< [J]
  integrator::Vec<double, Dim> momentum = integrator::Vec<double, Dim>::Zero();
  integrator::Moment<double, Dim> angular_momentum = integrator::Moment<double, Dim>::Zero();  ///< about the origin
  double speeds = 0, moments = 0;  ///< sums of m |v| and m |x| |v|, to measure momenta against

  double energy() const { return kinetic + potential; }
};

/// For each vertex: whether forces move it.
template <int Dim>
std::vector<bool> free_vertices(const integrator::Model<double, Dim>& model) {
  std::vector<bool> free(model.x.size(), true);
  for (const VertexId v : model.pinned) free[v] = false;
  for (const auto& script : model.scripts) free[script.vertex] = false;
  return free;
}

template <int Dim>
Mechanics<Dim> mechanics(const integrator::Model<double, Dim>& model, const Sample<Dim>& sample) {
  Mechanics<Dim> result;
  const std::vector<bool> free = free_vertices(model);
  for (std::size_t i = 0; i < free.size(); ++i) {
    if (!free[i]) continue;
    const double m = model.mass[i], speed = std::sqrt(sample.v[i].squaredNorm());
    result.kinetic += 0.5 * m * sample.v[i].squaredNorm();
    if (model.gravity) result.potential -= m * model.gravity->acceleration.dot(sample.x[i]);
    result.momentum += m * sample.v[i];
    result.angular_momentum += m * integrator::moment<double, Dim>(sample.x[i], sample.v[i]);
    result.speeds += m * speed;
    result.moments += m * speed * std::sqrt(sample.x[i].squaredNorm());
  }
  for_each_list(model, [&](const auto& list) {
    using F = typename std::decay_t<decltype(list.forces)>::value_type;
    integrator::VertexVectors<double, Dim, F::size> x;
    for (const F& force : list.forces) {
      for (std::size_t i = 0; i < F::size; ++i) x[i] = sample.x[force.vertices[i]];
      result.potential += force.energy(x);
    }
  });
  result.potential += sample.contact;
  return result;
}

template <int Dim>
bool is_finite(const Sample<Dim>& sample) {
  double sum = 0;
  for (std::size_t i = 0; i < sample.x.size(); ++i) sum += 0 * sample.x[i].sum() + 0 * sample.v[i].sum();
  return sum == 0;
}

inline bool stopped(const std::atomic<bool>* stop) { return stop != nullptr && stop->load(std::memory_order_relaxed); }

/// The CPU time of this thread, which other work on the machine disturbs least [s].
inline double thread_seconds() {
  struct timespec time = {};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// Calls `advance` once for each window and samples with `look`. Ends early at a sample that is not finite, or on
/// `stop`.
template <int Dim, class Advance, class Look>
void sample_windows(SampledRun<Dim>& run, int windows, const std::atomic<bool>* stop, const Advance& advance,
                    const Look& look) {
  run.samples.push_back(look());
  for (int i = 0; i < windows && !stopped(stop) && run.finite; ++i) {
    const double begin = thread_seconds();
    advance();
    run.seconds += thread_seconds() - begin;
    Sample<Dim> sample = look();
    run.finite = is_finite(sample);
    if (run.finite) run.samples.push_back(std::move(sample));
  }
}

/// This project's integrator, with the model's clocks and steps.
template <int Dim>
SampledRun<Dim> run_with_clocks(const integrator::Model<double, Dim>& model, int windows,
                                const std::atomic<bool>* stop = nullptr) {
  integrator::Simulation<double, Dim> simulation(model);
  integrator::Books<double, Dim> books;
  SampledRun<Dim> run;
  sample_windows<Dim>(
      run, windows, stop, [&] { simulation.run_window(books); },
      [&] {
        const auto potential = simulation.state().potential;
        return Sample<Dim>{simulation.snapshot().x, simulation.mean_velocities(),
                           potential[static_cast<std::size_t>(integrator::ForceKind::contact)]};
      });
  run.events = simulation.events();
  run.impulses = books.of(integrator::ForceKind::contact).events;
  return run;
}

/// Verlet's method as a plain loop. Precondition: step divides the window; plain_enough(model).
template <int Dim>
SampledRun<Dim> run_plain(const integrator::Model<double, Dim>& model, double step, int windows,
                          const std::atomic<bool>* stop = nullptr) {
  PlainLoop<Dim> loop(model, step);
  loop.start();
  const auto steps = static_cast<std::uint64_t>(std::llround(model.window_length / step));
  SampledRun<Dim> run;
  sample_windows<Dim>(
      run, windows, stop,
      [&] {
        for (std::uint64_t i = 0; i < steps; ++i) loop.step();
      },
      [&] {
        return run.samples.empty() ? Sample<Dim>{model.x, model.v}
                                   : Sample<Dim>{loop.positions(), loop.mean_velocities()};
      });
  run.events = loop.forces() * (steps * static_cast<std::uint64_t>(windows) + 1);
  return run;
}

/// True if a loop without damping, scripts and contact can run the model.
template <int Dim>
bool plain_enough(const integrator::Model<double, Dim>& model) {
  bool damped = false;
  for_each_list(model, [&](const auto& list) {
    for (const auto& force : list.forces) damped = damped || force.damping != 0;
  });
  return !damped && model.scripts.empty() && !model.contact;
}

/// The largest difference between the energy at the end of a window and at the beginning of the run, relative to the
/// latter.
template <int Dim>
double energy_error(const integrator::Model<double, Dim>& model, const SampledRun<Dim>& run) {
  const double begin = mechanics(model, run.samples.front()).energy();
  double worst = 0;
  for (const Sample<Dim>& sample : run.samples) {
    worst = std::max(worst, std::abs(mechanics(model, sample).energy() - begin));
  }
  return worst / begin;
}

}  // namespace noli::audit
