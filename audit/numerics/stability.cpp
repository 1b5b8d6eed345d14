// SPDX-License-Identifier: Apache-2.0
#include "audit/numerics/stability.h"

#include <fmt/format.h>

#include <algorithm>

#include "audit/numerics/stability_point.h"
#include "certify/process/child.h"
#include "certify/process/scratch_folder.h"

namespace noli::audit {
namespace {

namespace fs = std::filesystem;

/// Keeps the input of the point.
void save(const fs::path& scratch, const std::string& name, const StabilityOptions& options, StabilityPoint& point) {
  point.saved = options.out / name;
  fs::create_directories(point.saved);
  for (const auto& entry : fs::directory_iterator(scratch)) {
    if (entry.is_regular_file()) {
      fs::copy_file(entry.path(), point.saved / entry.path().filename(), fs::copy_options::overwrite_existing);
    }
  }
}

/// The sum of count(point) over all points.
template <class Count>
std::size_t sum_over_points(const StabilityReport& report, const Count& count) {
  std::size_t sum = 0;
  for (const StabilityResult& row : report.rows) {
    for (const StabilityPoint& point : row.points) sum += count(point);
  }
  return sum;
}

}  // namespace

std::size_t StabilityResult::first_to_give() const {
  const auto gives = [](const StabilityPoint& point) { return !point.gives.empty(); };
  return static_cast<std::size_t>(std::ranges::find_if(points, gives) - points.begin());
}

std::size_t StabilityReport::points() const {
  return sum_over_points(*this, [](const StabilityPoint&) { return 1U; });
}

std::size_t StabilityReport::held() const {
  return sum_over_points(*this, [](const StabilityPoint& point) { return point.gives.empty() ? 1U : 0U; });
}

std::size_t StabilityReport::findings() const {
  return sum_over_points(*this, [](const StabilityPoint& point) { return point.findings.size(); });
}

StabilityReport audit_stability(const std::vector<StabilityRow>& rows, const StabilityOptions& options) {
  std::size_t total = 0, done = 0;
  for (const StabilityRow& row : rows) total += row.values.size();
  const auto stopped = stop_by(options.stop);
  StabilityReport report;
  for (const StabilityRow& row : rows) {
    report.rows.push_back({row.name, row.varied, row.contact, {}});
    for (const double value : row.values) {
      if (options.progress) options.progress(static_cast<double>(done++) / static_cast<double>(total), row.name);
      const ScratchFolder scratch;
      StabilityPoint point = ask_point(row.make(value), scratch.path(), options);
      if (stopped()) {
        report.complete = false;
        return report;
      }
      point.value = value;
      if (!point.findings.empty()) save(scratch.path(), fmt::format("{}-{:g}", row.name, value), options, point);
      report.rows.back().points.push_back(std::move(point));
    }
  }
  return report;
}

}  // namespace noli::audit
