// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cstddef>

#include "audit/numerics/stability.h"
#include "report/figures/svg.h"

namespace noli::audit {
namespace {

using report::Anchor;
using report::Svg;

constexpr double row_height = 44, first_box = 300, box_width = 104, top = 70, margin = 16;

const char* fill_of(const StabilityPoint& point) {
  if (!point.findings.empty()) return "#e8a39b";
  return point.gives.empty() ? "#bfe3c6" : "#f5e0a3";
}

std::string second_line(const StabilityPoint& point) {
  if (!point.findings.empty()) return "finding";
  if (!point.gives.empty()) return point.gives.substr(0, 14);
  return point.energy_error ? fmt::format("dE {:.0e}", *point.energy_error) : "";
}

void draw_row(Svg& svg, const StabilityResult& row, double y) {
  svg.text({margin, y + 18}, row.name);
  svg.text({margin, y + 35}, row.varied);
  double x = first_box;
  for (const StabilityPoint& point : row.points) {
    svg.rectangle({x, y + 2}, {box_width - 4, row_height - 4}, fill_of(point));
    svg.text({x + 0.5 * box_width - 2, y + 18}, fmt::format("{:.4g}", point.value), Anchor::middle);
    svg.text({x + 0.5 * box_width - 2, y + 35}, second_line(point), Anchor::middle);
    x += box_width;
  }
}

}  // namespace

std::string stability_svg(const StabilityReport& report) {
  std::size_t most = 1;
  for (const StabilityResult& row : report.rows) most = std::max(most, row.points.size());
  const double width = first_box + box_width * static_cast<double>(most) + margin;
  const std::string title = "From the ordinary to the extreme, one quantity at a time";
  Svg svg(width, top + row_height * static_cast<double>(report.rows.size()) + margin, title);
  svg.text({margin, 28}, title);
  svg.text({margin, 50}, "green: holds; yellow: fails closed; red: a finding; dE: error of the energy, in parts");
  double y = top;
  for (const StabilityResult& row : report.rows) {
    draw_row(svg, row, y);
    y += row_height;
  }
  return svg.finish();
}

}  // namespace noli::audit
