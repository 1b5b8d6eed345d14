// SPDX-License-Identifier: Apache-2.0
//
// When two features first meet, as an algebraic number, and what kind of contact it is. Exact.
//
// Kinds, judged at the first time t* at which the features meet:
//   persistent  they meet during a whole interval that begins at t* (of positive length, within the step)
//   crossing    t* is inside the open step, the contact is of codimension one (vertex_face and edge_edge in 3D: at t*
//               the four points span exactly a plane; vertex_edge in 2D: the three points span exactly a line), it is
//               relatively interior to both features, and the orientation determinant changes sign at t*
//   touching    every other contact
//   apart       they do not meet
#pragma once

#include <optional>
#include <string_view>

#include "kernel/query.h"
#include "kernel/time_of_impact.h"

namespace noli {

enum class ContactKind { apart, touching, crossing, persistent };

/// The name used in JSON: "apart", "touching", "crossing", "persistent".
constexpr std::string_view name(ContactKind kind) {
  switch (kind) {
    case ContactKind::apart: return "apart";
    case ContactKind::touching: return "touching";
    case ContactKind::crossing: return "crossing";
    case ContactKind::persistent: return "persistent";
  }
  return "";
}

struct FirstContact {
  ContactKind kind = ContactKind::touching;  ///< never `apart`
  TimeOfImpact time;                         ///< the least t in [0, 1] at which the features meet
};

/// The first contact of the step, or nothing if the features stay apart.
/// Slow next to `contact` (kernel/contact.h): microseconds, with allocation. Call it for queries known to be in
/// contact.
template <FeaturePair Pair, int Dim>
std::optional<FirstContact> first_contact(const Query<Pair, Dim>& query);

}  // namespace noli
