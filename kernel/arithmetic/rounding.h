// SPDX-License-Identifier: Apache-2.0
//
// Does this program, on this machine, round as IEEE 754 says? Asked once, at run time, in release builds too: a
// compiler flag, an emulator or a library that changed the control word can break what the error bounds of the filters
// rest on.
//
// What this does not do: it samples. A processor that fails on other operands than these is not found out.
#pragma once

#include <string_view>

namespace noli {

struct RoundingReport {
  /// Round to nearest in double: no excess precision, no contraction of a * b + c, subnormals kept.
  bool nearest_ok = false;
  /// Switching to upward rounding takes effect for +, -, *, / and sqrt, and CGAL::Interval_nt encloses. Not so under
  /// Valgrind.
  bool directed_ok = false;

  bool ok() const { return nearest_ok && directed_ok; }
  explicit operator bool() const { return ok(); }
  /// One line for people.
  std::string_view text() const;
};

/// The result of the test, made at the first call. Leaves the rounding mode as it was. Thread-safe.
const RoundingReport& rounding_self_test();

}  // namespace noli
