// SPDX-License-Identifier: Apache-2.0
//
// The ways in which two features that move can meet: weights of their vertices, as polynomials in the time.
//
// Notation
//   dependency  weights of vertices of P, and of Q, with equal sums, such that the weighted sums of their positions
//               agree in some of the coordinates
//   condition   a polynomial that vanishes when they agree in all of them
//
// Where two hulls meet, they do so in a point that has just one set of weights, all of them positive, if few enough of
// the vertices are taken: m of them, which then span m - 2 dimensions. So m - 2 coordinates are enough to find the
// weights, by Cramer's rule, as minors of degree m - 2. At a first contact inside a step the condition of such a
// dependency is not identically 0: else the weights would have been positive before, too. So one of those that are
// tried here is right for each first contact that is not at a breakpoint.
#pragma once

#include <functional>

#include "proofs/prover/witness/feature_sides.h"
#include "proofs/prover/witness/integer_motion.h"

namespace noli::witness {

struct Dependency {
  FeatureSides sides;
  std::vector<Poly> weights;  ///< of sides.both()
  Poly condition;

  /// The greatest one of the weights.
  std::size_t degree() const {
    std::size_t size = 1;
    for (const Poly& weight : weights) size = std::max(size, weight.size());
    return size - 1;
  }
};

/// Tries all vertices first, then fewer, at most four; ends with the first that `take` accepts, and says whether there
/// was one.
bool any_dependency(const FeatureSides& features, const std::function<PolyVector(VertexId)>& position,
                    const std::function<bool(Dependency)>& take);

/// The parts of two features that have no vertex in common, of at most so many vertices; those of most vertices first.
std::vector<FeatureSides> parts_of(const FeatureSides& features, std::size_t most);

}  // namespace noli::witness
