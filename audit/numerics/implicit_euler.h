// SPDX-License-Identifier: Apache-2.0
//
// The implicit Euler method, for context: what many write for cloth, as it bears steps of any length.
//
// Notation
//   h        step [s], which divides the window
//   x', v'   at the end of a step: M (x' - x - h v) / h^2 = M g - grad V(x'), v' = (x' - x) / h
//   K        sum over forces and measures of c grad s grad s^T (force.h): their stiffness without that of stress, never
//            indefinite; each correction of x' solves (M / h^2 + K) dx = -residual by conjugate gradients
//   solved   a step whose last correction moves nothing by more than 1e-9 of the size of the scene, within 200
// (Baraff, Witkin, "Large steps in cloth simulation", 1998, take one correction; with it the error would be that of the
// solver too.)
//
// What this does not do: no damping, no scripts, no contact; and it is not made fast: no solver of its own for the
// sizes here. What its times say is their order of magnitude.
#pragma once

#include "audit/numerics/sampled_run.h"

namespace noli::audit {

/// Precondition: step divides the window; plain_enough(model).
template <int Dim>
SampledRun<Dim> run_implicit_euler(const integrator::Model<double, Dim>& model, double step, int windows,
                                   const std::atomic<bool>* stop = nullptr);

}  // namespace noli::audit
