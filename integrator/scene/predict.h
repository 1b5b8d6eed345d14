// SPDX-License-Identifier: Apache-2.0
//
// Computes the numbers of an explanation: groups, rates, bytes, resonances. explain.h defines them.
#pragma once

#include "integrator/scene/explain.h"

namespace noli::integrator {

/// Fills in groups, windows, events, breakpoints, bytes, resonances.
template <int Dim>
void predict(const Scene& scene, Model<double, Dim> model, Explanation& explanation);

}  // namespace noli::integrator
