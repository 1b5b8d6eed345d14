// SPDX-License-Identifier: Apache-2.0
//
// The ways in which two moving features can meet: weights of their vertices, as polynomials in time.
//
// Notation
//   dependency  weights of vertices of P, and of Q, with equal sums, such that the weighted sums of their positions
//               agree in some of the coordinates
//   condition   a polynomial that vanishes when they agree in all of them
//
// If two hulls meet, they meet in a point that has exactly one set of weights, all of them positive, for a small enough
// subset of the vertices: m of them, which span m - 2 dimensions. So m - 2 coordinates are enough to find the weights,
// by Cramer's rule, as minors of degree m - 2. At a first contact inside a step the condition of such a dependency is
// not identically 0: otherwise the weights would have been positive before, too. So for each first contact that is not
// at a breakpoint, one of the dependencies tried here is right.
#pragma once

#include <functional>

#include "kernel/distance_parts.h"
#include "proofs/prover/witness/feature_sides.h"

namespace noli::witness {

/// A position, as polynomials in time.
using PolynomialPosition = distance::Vector<3>;

struct Dependency {
  FeatureSides sides;
  std::vector<Polynomial> weights;  ///< of sides.both()
  Polynomial condition;
};

/// Tries all vertices first, then fewer, at most four. Stops at the first dependency that `take` accepts; returns
/// whether there was one.
bool any_dependency(const FeatureSides& features, const std::function<PolynomialPosition(VertexId)>& position,
                    const std::function<bool(Dependency)>& take);

/// The parts of two features that have no vertex in common, of at most `most` vertices; those with most vertices first.
std::vector<FeatureSides> parts_of(const FeatureSides& features, std::size_t most);

}  // namespace noli::witness
