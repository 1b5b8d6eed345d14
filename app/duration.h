// SPDX-License-Identifier: Apache-2.0
//
// Durations as they are written on the command line.
#pragma once

#include <chrono>
#include <string>

namespace noli::app {

/// "60s", "1.5m", "500ms", "2h"; a bare number is seconds. Positive, at most ten years.
/// Throws UsageError, naming `option`, for anything else.
std::chrono::nanoseconds parse_duration(const std::string& text, const std::string& option);

}  // namespace noli::app
