// SPDX-License-Identifier: Apache-2.0
//
// Answers the kernel's questions a second time: slow, exact, and by other methods. It uses rational arithmetic and
// Sturm sequences, never computes with floating-point numbers, and includes nothing of the kernel.
//
// Features are closed; a degenerate one is the convex hull of its points. Time is the closed interval [0, 1]. Kinds,
// judged at the first time t* of contact:
//   persistent  in contact during a whole interval that begins at t*
//   crossing    0 < t* < 1; vertex_face or edge_edge in 3D whose points span a plane at t*, or vertex_edge in 2D whose
//               points span a line; relatively interior to both features; the orientation determinant changes sign at
//               t*
//   touching    any other contact
#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "oracle/motion.h"
#include "oracle/time.h"

namespace noli::oracle {

enum class Kind { apart, touching, crossing, persistent };

constexpr std::string_view name(Kind kind) {
  constexpr std::array<std::string_view, 4> names = {"apart", "touching", "crossing", "persistent"};
  return names[static_cast<std::size_t>(kind)];
}

struct Answer {
  Kind kind = Kind::apart;
  std::optional<Time> time;  ///< the first time of contact; unset iff apart
};

/// The first contact of the step.
Answer first_contact(const Motion& motion);

/// The first time at which the two features are within `distance` of each other. Precondition: distance is finite and
/// not negative.
std::optional<Time> first_within(const Motion& motion, double distance);

/// Whether the two features have the same strict order along some axis at t = 0 and at t = 1; then they stay apart.
bool axis_separates(const Motion& motion);

}  // namespace noli::oracle
