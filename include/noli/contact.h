// SPDX-License-Identifier: Apache-2.0
//
// Did the two features of a query meet during the step? Exact, for any finite doubles.
//
//   noli::VertexFace3 query;                                          // noli/query.h
//   query.x_t0 = {{{0.2, 0.2, 1}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}}};  // vertex, then the face's corners, at t = 0
//   query.x_t1 = {{{0.2, 0.2, -1}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}}};
//   if (noli::meet(query)) ...                                        // true
//
// The answer is that of real arithmetic on the given coordinates: features and the time interval are closed, so a touch
// counts, and so does a contact at exactly t = 0 or t = 1. There is no tolerance.
//
// Stages: a decision passes through stages, from comparisons to integers of any width. Each stage is certain when it
// answers, and silent otherwise. StageCounters count how often each one answered.
//
// Preconditions: finite coordinates; the floating-point environment rounds to nearest. Do not call it while a
// CGAL::Interval_nt protector is alive.
// Errors: std::bad_alloc. Thread safety: any thread, with counters of its own.
// The kind of contact and its exact time are in noli/time_of_impact.h.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include <noli/query.h>

namespace noli {

enum class Stage {
  comparison,  ///< an axis on which the two features are in the same strict order at both ends: comparisons only
  direction,   ///< a separating direction, with a proved floating-point error bound
  bernstein,   ///< Bernstein coefficients with bisection, in double with a proved error bound
  fixed,       ///< exact integers of fixed width, without allocation
  interval,    ///< Bernstein coefficients in interval arithmetic (CGAL::Interval_nt), for exponents that do not fit the
               ///< fixed width
  gmp          ///< exact integers of any width
};

constexpr std::array<Stage, 6> all_stages = {Stage::comparison, Stage::direction, Stage::bernstein,
                                             Stage::fixed,      Stage::interval,  Stage::gmp};

/// The name used in JSON: "comparison", ...
constexpr std::string_view name(Stage stage) {
  constexpr std::array<std::string_view, 6> names = {"comparison", "direction", "bernstein",
                                                     "fixed",      "interval",  "gmp"};
  return names[static_cast<std::size_t>(stage)];
}

/// How many decisions each stage made. Plain counters: one set per thread, added up afterwards.
struct StageCounters {
  std::array<std::uint64_t, all_stages.size()> decided{};

  void count(Stage stage) { ++decided[static_cast<std::size_t>(stage)]; }
  std::uint64_t operator[](Stage stage) const { return decided[static_cast<std::size_t>(stage)]; }

  StageCounters& operator+=(const StageCounters& other) {
    for (std::size_t i = 0; i < decided.size(); ++i) decided[i] += other.decided[i];
    return *this;
  }
  friend bool operator==(const StageCounters&, const StageCounters&) = default;
};

/// A part [begin, end] of the step, 0 <= begin <= end <= 1.
struct TimeEnclosure {
  double begin = 0;
  double end = 1;
};

/// If the features meet at some t in [0, 1]: an interval that contains the first such t. It is usually narrower than
/// 2^-20, but this is not guaranteed. Otherwise nothing. Defined for vertex_face, edge_edge, vertex_edge, vertex_vertex
/// in 3D and for vertex_edge, vertex_vertex in 2D. Counts the stage that decided in `counters` when given.
template <FeaturePair Pair, int Dim>
std::optional<TimeEnclosure> contact(const Query<Pair, Dim>& query, StageCounters* counters = nullptr);

/// Whether the features meet at some t in [0, 1].
template <FeaturePair Pair, int Dim>
bool meet(const Query<Pair, Dim>& query, StageCounters* counters = nullptr) {
  return contact(query, counters).has_value();
}

}  // namespace noli
