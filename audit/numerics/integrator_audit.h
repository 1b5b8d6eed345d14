// SPDX-License-Identifier: Apache-2.0
//
// Error against run time of the integrator, over step sizes, beside the methods that one would write instead.
//
// Methods
//   own       this integrator, a step for each force
//   grouped   this integrator, steps rounded down to a few groups
//   verlet    Verlet's method, all forces with the step that the least one needs: a plain loop (plain_loop.h); for what
//             that cannot do (damping, scripts, contact) this integrator with all steps equal, also of first layers
//   euler     the implicit Euler method (implicit_euler.h), for context; not for damping, scripts, contact
// Each is run with its steps as the scene has them, then with halves, quarters, ... of them; `euler` with the window
// and quarters, sixteenths, ... of that, as long as they are no shorter than the least step.
//
// Notation
//   h          the least step of a force, rounded down to that of a group [s]; n the number of halvings
//   r          h / 2^(n + 1)
//   reference  Verlet's method with r and with r/2, extrapolated: (4 x(r/2) - x(r)) / 3, as its error is a series in
//              h^2 (Hairer, Lubich, Wanner 2003, section 1); where it is this integrator, with r/2 as it is. Its
//              momenta are those of r/2, which keeps them
// Errors are the largest at the ends of windows:
//   energy      |E - E_ref| in parts of the largest kinetic energy of the reference
//   momentum, angular momentum   |p - p_ref| in parts of the largest sum of m |v|, m |x| |v| of it
//   trajectory  root of the mass-weighted mean of |x - x_ref|^2 over the free vertices [m]
//
// What this does not do: chaotic motion has no trajectory to compare with for long; `uncertainty` says from where on
// errors are the reference's own.
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
  int windows = 20;  ///< at most those of the scene
  bool euler = true;
  const std::atomic<bool>* stop = nullptr;
  /// Called before each run; not empty.
  std::function<void(const std::string& method, double factor)> begun = [](const std::string&, double) {};
};

struct IntegratorErrors {
  double energy = 0, momentum = 0, angular_momentum = 0;
  double trajectory = 0;  ///< [m]
};

struct IntegratorPoint {
  double factor = 1;         ///< of the method's steps
  double least_step = 0;     ///< [s]
  std::uint64_t events = 0;  ///< forces fired, or evaluated
  bool finite = true;        ///< else there are no errors
  bool converged = true;
  IntegratorErrors errors;
  double seconds = 0;  ///< computed by its thread: the median of its passes, of which short runs have more
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
  bool plain = true;         ///< `verlet` is the plain loop
  IntegratorErrors uncertainty;
  std::vector<MethodResult> methods;
  bool reference_finite = true;  ///< else there are no methods
  bool complete = true;          ///< it was not stopped

  /// A run of this integrator, or of Verlet's method, that left the numbers.
  bool has_finding() const;
};

/// Precondition: options.halvings >= 0, options.windows >= 1. Throws InputError as build_model does.
IntegratorResult audit_integrator(const integrator::Scene& scene, const IntegratorOptions& options);

/// The scenes for those who bring none: a sheet whose cells are all of one size, and one whose cells are smaller in one
/// place. Texts of scene files.
std::vector<std::string> integrator_scenes();

}  // namespace noli::audit
