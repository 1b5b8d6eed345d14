// SPDX-License-Identifier: Apache-2.0
//
// Exact changes of a query that keep its answer, so that what was constructed in a special position is not seen in it;
// and the step from whole numbers to doubles.
#pragma once

#include <array>

#include "audit/fuzz/queries/recipes.h"

namespace noli::audit {

/// A query with doubles, and its answer where the construction implies it.
struct Generated {
  AnyQuery query;
  std::optional<ContactKind> truth;
};

/// Exponents of the powers of two with which the axes are multiplied.
using AxisExponents = std::array<int, 3>;

/// Sheared and turned (whole_query.h), its points renamed (the other edge first, the corners of the face in another
/// order), and each axis multiplied by a power of two. Preconditions: what comes out is exactly a double;
/// coordinates below 2^53 even after that. Throws std::logic_error when a whole number is too large.
Generated finish(Made made, Random& random, const AxisExponents& exponents);

/// The same with one power of two between 2^-40 and 1 for all axes.
Generated finish(Made made, Random& random);

}  // namespace noli::audit
