// SPDX-License-Identifier: Apache-2.0
//
// Expresses contact and nearness of two features as conditions on the time.
//
// A point of the hull of some points is a weighted mean of few of them (Caratheodory). So two features are in contact,
// or within a distance, iff the relative interiors of two of their sub-features with unique closest points are. These
// points solve the normal equations, by Cramer's rule with the Gram determinant G. The conditions are that G > 0 and
// that the weights are not negative. Sub-features with G = 0 are left out: smaller ones already cover them. Nothing is
// projected to a plane.
#pragma once

#include <optional>

#include "oracle/condition.h"
#include "oracle/integer_path.h"

namespace noli::oracle {

/// A polynomial that vanishes in every contact: the determinant of the four points of vertex_face and edge_edge in 3D,
/// or of the three points of vertex_edge in 2D. Other pairs have none.
std::optional<Polynomial> orientation(const Motion& motion, const std::vector<Vector>& x);

/// When two features are in contact.
struct ContactCondition {
  Condition condition;
  /// All are positive at a contact that is relatively interior to both features and whose points span a plane
  /// (vertex_edge in 2D: a line). Empty for pairs without an orientation.
  std::vector<Polynomial> interior;
};

/// `orientation` must come from the same motion.
ContactCondition contact_condition(const Motion& motion, const std::vector<Vector>& x,
                                   const std::optional<Polynomial>& orientation);

/// The closed condition "within `distance`", in the unit of x.
Condition nearness_condition(const Motion& motion, const std::vector<Vector>& x, const Integer& distance);

}  // namespace noli::oracle
