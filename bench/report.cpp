// SPDX-License-Identifier: Apache-2.0
#include "bench/report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace noli::bench {

void MedianReporter::ReportRuns(const std::vector<Run>& runs) {
  for (const Run& run : runs) {
    if (run.aggregate_name != "median") continue;
    const bool by_hand = run.run_name.time_type == "manual_time";
    const double time = by_hand ? run.GetAdjustedRealTime() : run.GetAdjustedCPUTime();
    medians_[run.run_name.function_name] = time * 1e9 / benchmark::GetTimeUnitMultiplier(run.time_unit);
  }
  ConsoleReporter::ReportRuns(runs);
}

const double* MedianReporter::median_ns(const std::string& name) const {
  const auto found = medians_.find(name);
  return found == medians_.end() ? nullptr : &found->second;
}

std::string shares_head() {
  std::string text;
  for (const Stage stage : all_stages) text += fmt::format("{}{}", text.empty() ? "% " : " / ", name(stage));
  return text;
}

std::string shares(const StageCounters& counters, std::size_t queries) {
  std::string text;
  for (const Stage stage : all_stages) {
    const double share = 100 * static_cast<double>(counters[stage]) / static_cast<double>(queries);
    text += fmt::format("{}{:.1f}", text.empty() ? "" : " / ", share);
  }
  return text;
}

Table::Table(const std::vector<std::string>& head) {
  row(head);
  row(std::vector<std::string>(head.size(), "---"));
}

void Table::row(const std::vector<std::string>& cells) { text_ += fmt::format("| {} |\n", fmt::join(cells, " | ")); }

}  // namespace noli::bench
