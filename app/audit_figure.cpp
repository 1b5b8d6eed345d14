// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "noli/app/audit_report.h"
#include "noli/app/figure_axes.h"
#include "noli/app/svg.h"

namespace noli::app {
namespace {

using audit::AuditOutcome;
using audit::LibraryAudit;

constexpr double left = 96, right = 660, top = 60, bottom = 400, zero = 440;
constexpr const char* grey = "#444444";

void axes(Svg& svg, const LogScale& x, const LogScale& y) {
  for (const Tick& tick : logarithmic_ticks(x.low, x.high)) {
    svg.line({x(tick.value), top}, {x(tick.value), zero}, "#eeeeee");
    svg.line({x(tick.value), zero + 14}, {x(tick.value), zero + 19}, grey);
    svg.text({x(tick.value), zero + 34}, tick.words, Anchor::middle);
  }
  for (const Tick& tick : logarithmic_ticks(y.low, y.high)) {
    svg.line({left, y(tick.value)}, {right, y(tick.value)}, "#eeeeee");
    svg.line({left - 5, y(tick.value)}, {left, y(tick.value)}, grey);
    svg.text({left - 9, y(tick.value) + 4.5}, tick.words, Anchor::end);
  }
  // A logarithm has no place for none.
  svg.line({left - 5, zero}, {left, zero}, grey);
  svg.text({left - 9, zero + 4.5}, "0", Anchor::end);
  svg.line({left, 0.5 * (bottom + zero)}, {right, 0.5 * (bottom + zero)}, "#aaaaaa", "2 4");
  svg.frame({left, top - 14}, {right - left, zero + 28 - top}, grey);
  svg.text({0.5 * (left + right), zero + 58}, "time per query [ns]", Anchor::middle);
  svg.text({left - 68, 0.5 * (top + zero)}, "wrong answers", Anchor::middle, true);
}

/// A square, or, where contacts were missed or times late, a cross.
void mark(Svg& svg, Svg::Point at, bool missed, const std::string& stroke) {
  constexpr double size = 5;
  if (!missed) return svg.rectangle({at[0] - size, at[1] - size}, {2 * size, 2 * size}, stroke);
  for (const double slope : {-size, size}) {
    const std::array<Svg::Point, 2> ends = {{{at[0] - size, at[1] - slope}, {at[0] + size, at[1] + slope}}};
    svg.polyline(ends, stroke, 3);
  }
}

}  // namespace

std::string audit_svg(const AuditOutcome& outcome) {
  static constexpr const char* colours[] = {"#1b6ca8", "#c8553d", "#2e8b57", "#8e5ea2", "#c99a1c",
                                            "#5f6b73", "#17a2a2", "#d0679d", "#222222"};
  const std::string title = "Continuous collision detection: wrong answers against time";
  const double legend = 40 + 20 * static_cast<double>(outcome.audits.size() + 3);
  Svg svg(960, std::max(520.0, top + legend), title);
  svg.text({left, 30}, title);
  std::vector<double> times, errors;
  for (const LibraryAudit& audit : outcome.audits) {
    times.push_back(audit.total.ns_per_query());
    errors.push_back(static_cast<double>(audit.total.false_answers()));
  }
  const LogScale x = logarithmic_scale(times, left + 14, right - 14), y = logarithmic_scale(errors, bottom, top);
  axes(svg, x, y);
  std::map<std::string, const char*> colour_of;
  double line = top;
  for (const LibraryAudit& audit : outcome.audits) {
    const std::string name = audit_name(outcome, audit.plugin);
    const auto place = colour_of.try_emplace(name, colours[colour_of.size() % std::size(colours)]).first;
    const audit::AuditCounts& counts = audit.total;
    const bool missed = counts.false_negatives > 0 || counts.late.count() > 0;
    const auto wrong = static_cast<double>(counts.false_answers());
    mark(svg, {x(counts.ns_per_query()), wrong > 0 ? y(wrong) : zero}, missed, place->second);
    mark(svg, {right + 26, line - 4}, missed, place->second);
    svg.text({right + 42, line}, fmt::format("{}, {:g}", name, audit.tolerance));
    line += 20;
  }
  svg.text({right + 20, line + 16}, "cross: misses contacts,");
  svg.text({right + 20, line + 34}, "or says when too late");
  return svg.finish();
}

}  // namespace noli::app
