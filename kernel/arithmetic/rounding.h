// SPDX-License-Identifier: Apache-2.0
//
// Tests whether this program, on this machine, rounds as IEEE 754 requires. It runs once, in release builds too. The
// error bounds of the filters need it, and a compiler flag, an emulator or a changed control word can break it.
//
// It samples: it does not detect a processor that fails on other operands than these.
#pragma once

#include <string_view>

namespace noli {

struct RoundingReport {
  /// Round to nearest in double: no excess precision, no contraction of a * b + c, subnormals kept.
  bool nearest_ok = false;
  /// Switching to upward rounding takes effect for +, -, *, / and sqrt, and CGAL::Interval_nt encloses. False under
  /// Valgrind.
  bool directed_ok = false;

  bool ok() const { return nearest_ok && directed_ok; }
  explicit operator bool() const { return ok(); }
  /// One line for people.
  std::string_view text() const;
};

/// The result of the test, which runs at the first call. Leaves the rounding mode as it was. Thread-safe.
const RoundingReport& rounding_self_test();

}  // namespace noli
