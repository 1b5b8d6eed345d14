// SPDX-License-Identifier: Apache-2.0
//
// Contact and nearness of two features as conditions on the time.
//
// A point of the hull of some points is a weighted mean of few of them (Caratheodory). So two features are in contact,
// or within a distance, iff the relative interiors of two of their sub-features are, whose mutual closest points are
// unique: those are the solution of the normal equations, by Cramer's rule with the Gram determinant G, and the
// conditions are that G > 0 and that the weights are not negative. Sub-features for which G = 0 are left out: what they
// would add, smaller ones already say. No projection to a plane occurs.
#pragma once

#include <optional>

#include "oracle/condition.h"
#include "oracle/integer_path.h"

namespace noli::oracle {

/// What vanishes in every contact: the determinant of the four points of vertex_face and edge_edge in 3D, of the three
/// of vertex_edge in 2D; nothing for the others.
std::optional<Polynomial> orientation(const Motion& motion, const std::vector<Vector>& x);

/// When two features are in contact.
struct ContactCondition {
  Condition condition;
  /// Positive at a contact that is relatively interior to both features and whose points span a plane (vertex_edge in
  /// 2D: a line). Only for those features that have an orientation.
  std::vector<Polynomial> interior;
};

/// `orientation` is that of the same motion.
ContactCondition contact_condition(const Motion& motion, const std::vector<Vector>& x,
                                   const std::optional<Polynomial>& orientation);

/// Within `distance`, in the unit of x: closed.
Condition nearness_condition(const Motion& motion, const std::vector<Vector>& x, const Integer& distance);

}  // namespace noli::oracle
