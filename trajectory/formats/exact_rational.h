// SPDX-License-Identifier: Apache-2.0
//
// Doubles as quotients of decimal integers, both ways and without rounding.
#pragma once

#include <string>
#include <string_view>

namespace noli {

/// Sets `value` to numerator / denominator, two decimal integers of any length with or without a sign. Returns "" when
/// the quotient is exactly a finite double, else what is wrong: no integer, a zero denominator, a quotient that is no
/// double. A zero numerator with a minus sign gives -0.0.
std::string parse_exact_quotient(std::string_view numerator, std::string_view denominator, double& value);

/// "NUMERATOR,DENOMINATOR" in lowest terms, the denominator a power of two; -0.0 is "-0,1". Precondition: finite.
std::string format_exact_quotient(double value);

}  // namespace noli
