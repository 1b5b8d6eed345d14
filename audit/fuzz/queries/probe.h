// SPDX-License-Identifier: Apache-2.0
//
// What a query is asked beside contact: do its features come within a distance of each other, and until when does a
// certificate for two of its points hold?
//
// Notation
//   eta           the distance
//   certificate   n . (a(t) - b(t)) > g for a point a of the first feature and b of the second. Each moves on the chord
//                 of the step, from (0, x_t0) to (1, x_t1), or as a ray does, at x_t0 with velocity x_t1
//
// What this does not do: it decides nothing (audit/fuzz/queries/judge.h).
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "audit/fuzz/random.h"
#include "certify/queries/any_query.h"

namespace noli::audit {

/// Numbers are finite, eta and `from` not negative.
struct Probe {
  std::optional<double> eta;  ///< nothing: it is not asked for the distance
  Point3 normal{};
  double gap = 0;                       ///< g
  double from = 0;                      ///< the time from which on the certificate is asked about
  std::array<std::size_t, 2> points{};  ///< a and b, by their places in the query
  std::array<bool, 2> rays{};           ///< whether a and b move as rays
  friend bool operator==(const Probe&, const Probe&) = default;
};

/// Whether a and b are points of the first and the second feature.
bool fits(const AnyQuery& query, const Probe& probe);

/// One that is hard for this query, for the distance as well if asked to: bounds near distances that its points have,
/// or equal to them as rounding has them, and neighbouring doubles.
Probe make_probe(const AnyQuery& query, bool distance, Random& random);

/// The line of a saved query that says what else it was asked: "# noli-fuzz dimension 3 eta 0.5 normal ..." (or "eta
/// none"). Files of queries take it for a comment.
std::string probe_line(const AnyQuery& query, const Probe& probe);

struct SavedProbe {
  int dimension = 3;
  Probe probe;
};

/// Reads such a line; nothing if it is none, or says what cannot be.
std::optional<SavedProbe> parse_probe_line(std::string_view line);

}  // namespace noli::audit
