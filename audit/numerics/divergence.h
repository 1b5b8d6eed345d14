// SPDX-License-Identifier: Apache-2.0
//
// Where a run in other numbers parts from the run in double.
//
// What this does not do: it finds none of it (audit/numerics/replay.h).
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "certificates/stencil.h"

namespace noli::audit {

/// The first number of a run that is not, bit for bit, that of the run in double.
struct BitDifference {
  double time = 0;   ///< [s]
  std::string what;  ///< "position of vertex 3", ...
};

/// A pair for which the formulas went another way than in double.
struct CourseChange {
  double time = 0;  ///< [s]
  certificates::Stencil pair;
  std::uint32_t layer = 0;
  bool acts_in_double = false;
};

/// Of each way in which formulas may part: how often, and where first.
struct CourseChanges {
  struct Way {
    std::uint64_t count = 0;
    std::optional<CourseChange> first;
    void add(const CourseChange& change) {
      if (count++ == 0) first = change;
    }
  };
  Way acts;     ///< a layer acts in one run and not in the other: the order of impulses is another
  Way parts;    ///< restitution counts in one of them only
  Way sticks;   ///< friction stops all slip in one of them only
  Way corners;  ///< the closest points lie on other parts of the features
};

}  // namespace noli::audit
