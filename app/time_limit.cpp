// SPDX-License-Identifier: Apache-2.0
#include "app/time_limit.h"

#include "app/duration.h"
#include "app/interrupt.h"

namespace noli::app {

void add_time_limit_option(CLI::App& command, std::string& text, const std::string& help) {
  command.add_option("--time-limit", text, help)->type_name("TIME");
}

std::optional<std::chrono::steady_clock::time_point> begin_work(const std::string& text) {
  hear_stops_everywhere();
  if (text.empty()) return std::nullopt;
  const std::chrono::nanoseconds limit = parse_duration(text, "--time-limit");
  const auto deadline = std::chrono::steady_clock::now() + limit;
  stop_after(limit);
  return deadline;
}

}  // namespace noli::app
