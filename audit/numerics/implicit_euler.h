// SPDX-License-Identifier: Apache-2.0
//
// Implements the implicit Euler method, for comparison: many use it for cloth because it is stable for steps of any
// length.
//
// Notation
//   h        step [s], which divides the window
//   x', v'   at the end of a step: M (x' - x - h v) / h^2 = M g - grad V(x'), v' = (x' - x) / h
//   K        sum over forces and measures of c grad s grad s^T (integrator/force.h): the stiffness without the stress
//            term, so positive semidefinite; each correction of x' solves (M / h^2 + K) dx = -residual by conjugate
//            gradients
//   solved   a step whose last correction moves no vertex by more than 1e-9 of the size of the scene, within 200
// (Baraff, Witkin, "Large steps in cloth simulation", 1998, make one correction; that would add the solver's error.)
//
// There is no damping, no scripts and no contact. The code is not tuned for speed; its run times are only meaningful to
// an order of magnitude.
#pragma once

#include "audit/numerics/sampled_run.h"

namespace noli::audit {

/// Precondition: step divides the window; plain_enough(model).
template <int Dim>
SampledRun<Dim> run_implicit_euler(const integrator::Model<double, Dim>& model, double step, int windows,
                                   const std::atomic<bool>* stop = nullptr);

}  // namespace noli::audit
