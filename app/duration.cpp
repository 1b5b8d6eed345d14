// SPDX-License-Identifier: Apache-2.0
#include "app/duration.h"

#include <charconv>
#include <optional>
#include <string_view>

#include "app/exit_code.h"

namespace noli::app {
namespace {

std::optional<double> seconds_per(std::string_view unit) {
  if (unit.empty() || unit == "s") return 1.0;
  if (unit == "ms") return 1e-3;
  if (unit == "m") return 60.0;
  if (unit == "h") return 3600.0;
  return std::nullopt;
}

}  // namespace

std::chrono::nanoseconds parse_duration(const std::string& text, const std::string& option) {
  double number = 0;
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, number, std::chars_format::fixed);
  const auto unit = seconds_per(std::string_view(rest, static_cast<std::size_t>(end - rest)));
  constexpr double ten_years = 10 * 366 * 24 * 3600.0;
  const double seconds = number * unit.value_or(0);
  if (error != std::errc() || !(seconds > 0 && seconds <= ten_years)) {
    throw UsageError(option + ": '" + text +
                     "' is no duration; expected a positive number with ms, s, m or h, as in 60s");
  }
  return std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::duration<double>(seconds));
}

}  // namespace noli::app
