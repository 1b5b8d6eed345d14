// SPDX-License-Identifier: Apache-2.0
//
// Do two features come within a distance of each other during the step, and when first? Exact, for any finite doubles.
//
// Notation: the distance is that of the closed features, eta the bound; "within" means distance <= eta. With eta = 0 it
// is contact.
//
// It has only one filter before the exact decision: it is meant for a user's bound on the distance, not for the
// millions of queries of a simulation.
#pragma once

#include <optional>

#include <noli/query.h>
#include <noli/time_of_impact.h>
#include "kernel/motion.h"

namespace noli {

/// The least t in [0, 1] at which the features are within eta of each other, or nothing.
/// Preconditions: finite coordinates; eta is finite and not negative.
template <FeaturePair Pair, int Dim>
std::optional<TimeOfImpact> first_within(const Query<Pair, Dim>& query, double eta);

/// Whether the features come within eta of each other at some time in [0, 1].
template <FeaturePair Pair, int Dim>
bool within_distance(const Query<Pair, Dim>& query, double eta) {
  return first_within(query, eta).has_value();
}

/// The same for a piece of a motion; the time is s of kernel/motion.h.
template <FeaturePair Pair, int Dim>
std::optional<TimeOfImpact> first_within(const MotionQuery<Pair, Dim>& query, double eta);

}  // namespace noli
