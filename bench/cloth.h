// SPDX-License-Identifier: Apache-2.0
//
// Sheets of cloth for the benchmarks of the integrator: springs along the edges, hinges between the faces, pinned at
// two corners, in calm motion. Bending is so stiff that hinges fire about as often as springs: a synchronous loop,
// which fires all of them equally often, is then a fair measure for one that does not.
#pragma once

#include "integrator/model.h"

namespace noli::bench {

/// A sheet of (cells + 1)^2 vertices whose triangles differ in size by up to `grading`, so that steps differ. Steps are
/// those of integrator/stable_step.h.
integrator::Model<double, 3> cloth(int cells, double grading, integrator::Clocks clocks);

}  // namespace noli::bench
