// SPDX-License-Identifier: Apache-2.0
//
// Records where a run in another precision departs from the run in double. audit/numerics/replay.h fills these in.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "certificates/stencil.h"

namespace noli::audit {

/// The first number of a run that differs from the run in double in any bit.
struct BitDifference {
  double time = 0;   ///< [s]
  std::string what;  ///< "position of vertex 3", ...
};

/// A pair for which the formulas took another branch than in double.
struct CourseChange {
  double time = 0;  ///< [s]
  certificates::Stencil pair;
  std::uint32_t layer = 0;
  bool acts_in_double = false;
};

/// For each kind of branch that may differ: how often it did, and where first.
struct CourseChanges {
  struct Way {
    std::uint64_t count = 0;
    std::optional<CourseChange> first;
    void add(const CourseChange& change) {
      if (count++ == 0) first = change;
    }
  };
  Way acts;     ///< a layer acts in one run and not in the other: the order of impulses differs
  Way parts;    ///< restitution counts in only one of them
  Way sticks;   ///< friction exceeds Coulomb's bound in only one of them
  Way corners;  ///< the closest points lie on other parts of the features
};

}  // namespace noli::audit
