// SPDX-License-Identifier: Apache-2.0
//
// The stages a decision passes through, each certain when it answers and silent otherwise, and how often each one
// answered.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

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

}  // namespace noli
