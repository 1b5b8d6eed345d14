// SPDX-License-Identifier: Apache-2.0
//
// Did the two features of a query meet during the step? Exact, for any finite doubles.
//
// The answer is that of real arithmetic on the given coordinates: features and the time interval are closed, so a touch
// counts, and so does a contact at exactly t = 0 or t = 1. There is no tolerance.
//
// What this does not do: it does not say what kind of contact it is or exactly when it begins (kernel/first_contact.h),
// nor does it know a thickness (kernel/thickness.h).
#pragma once

#include <optional>

#include "kernel/query.h"
#include "kernel/stages.h"

namespace noli {

/// A part [begin, end] of the step, 0 <= begin <= end <= 1.
struct TimeEnclosure {
  double begin = 0;
  double end = 1;
};

/// If the features meet at some t in [0, 1]: an interval that contains the first such t, mostly narrower than 2^-20 but
/// never promised to be. Otherwise nothing. Defined for vertex_face, edge_edge, vertex_edge, vertex_vertex in 3D and
/// for vertex_edge, vertex_vertex in 2D. Counts the stage that decided in `counters` when given. Preconditions: finite
/// coordinates; the floating-point environment rounds to nearest (do not call it while a CGAL::Interval_nt protector is
/// alive).
template <FeaturePair Pair, int Dim>
std::optional<TimeEnclosure> contact(const Query<Pair, Dim>& query, StageCounters* counters = nullptr);

/// Whether the features meet at some t in [0, 1].
template <FeaturePair Pair, int Dim>
bool meet(const Query<Pair, Dim>& query, StageCounters* counters = nullptr) {
  return contact(query, counters).has_value();
}

}  // namespace noli
