// SPDX-License-Identifier: Apache-2.0
//
// Measures the integrator's error against its run time over step sizes, compared with the usual alternatives.
//
// Methods
//   own       this integrator, a step for each force
//   grouped   this integrator, steps rounded down to a few groups
//   verlet    Verlet's method with the shortest step of any force for all forces: a plain loop (plain_loop.h). Scenes
//             with damping, scripts or contact, which the loop lacks, use this integrator with all steps equal, those
//             of first layers too
//   euler     the implicit Euler method (implicit_euler.h), for comparison; not for damping, scripts, contact
// Each method runs with the scene's steps, then with halves, quarters, ... of them. `euler` runs with the window and
// quarters, sixteenths, ... of it, as often, but with no step below h.
//
// Notation
//   h          the least step of a force, rounded down to that of a group [s]; n the number of halvings
//   r          h / 2^(n + 1)
//   reference  Verlet's method with r and with r/2, extrapolated: (4 x(r/2) - x(r)) / 3, because its error is a series
//              in h^2 (Hairer, Lubich, Wanner 2003, section 1). Its momenta are those of r/2, which conserves them.
//              Where `verlet` is this integrator, the reference is the run with r/2, without extrapolation
// Errors are the largest at the ends of windows:
//   energy      |E - E_ref| over the largest kinetic energy of the reference
//   momentum, angular momentum   |p - p_ref| over the reference's largest sum of m |v|, m |x| |v|
//   trajectory  root of the mass-weighted mean of |x - x_ref|^2 over the free vertices [m]
//
// Trajectories of chaotic motion soon diverge. Errors below `uncertainty` are the reference's own.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "integrator/scene/scene.h"

namespace noli::audit {

struct IntegratorOptions {
  int halvings = 3;
  int windows = 20;  ///< at most as many as the scene has
  bool euler = true;
  const std::atomic<bool>* stop = nullptr;
  /// Called before each run; must not be empty.
  std::function<void(const std::string& method, double factor)> begun = [](const std::string&, double) {};
};

struct IntegratorErrors {
  double energy = 0, momentum = 0, angular_momentum = 0;
  double trajectory = 0;  ///< [m]
};

struct IntegratorPoint {
  double factor = 1;         ///< by which the method's steps are scaled
  double least_step = 0;     ///< [s]
  std::uint64_t events = 0;  ///< forces fired, or evaluated
  bool finite = true;        ///< if false, `errors` is not set
  bool converged = true;
  IntegratorErrors errors;
  double seconds = 0;  ///< CPU time of the thread, the median over the passes; short runs make several
};

struct MethodResult {
  std::string method;
  std::vector<IntegratorPoint> points;  ///< from the longest steps to the shortest
};

struct IntegratorResult {
  std::string title;
  int dimension = 3;
  std::size_t vertices = 0;
  std::uint64_t forces = 0;
  double shortest_step = 0, longest_step = 0;  ///< of forces [s]
  int windows = 0;
  double window_length = 0;  ///< [s]
  bool plain = true;         ///< `verlet` is the plain loop (plain_loop.h)
  IntegratorErrors uncertainty;
  std::vector<MethodResult> methods;
  bool reference_finite = true;  ///< if false, `methods` is empty
  bool complete = true;          ///< false if it was stopped

  /// True if a run of this integrator or of Verlet's method produced a value that is not finite.
  bool has_finding() const;
};

/// Precondition: options.halvings >= 0, options.windows >= 1. Throws InputError as build_model does.
IntegratorResult audit_integrator(const integrator::Scene& scene, const IntegratorOptions& options);

/// The default scenes, as texts of scene files: a sheet whose cells all have one size, and one whose cells are smaller
/// in one place.
std::vector<std::string> integrator_scenes();

}  // namespace noli::audit
