// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "audit/ccd/audit_report.h"
#include "report/figures/figure_axes.h"
#include "report/figures/svg.h"

namespace noli::audit {
namespace {

using report::Anchor;
using report::colour;
using report::logarithmic_scale;
using report::logarithmic_ticks;
using report::LogScale;
using report::Svg;
using report::Tick;

constexpr double left = 96, right = 660, top = 84;          ///< of the panels, which are one above the other
constexpr double height = 210, to_zero = 34, between = 24;  ///< of a panel's logarithm, of what is below it, of the gap
constexpr double letter = 7;                                ///< about as wide as one in a legend
constexpr double pad = 14;                                  ///< from what is drawn to the frame around it
constexpr double panel = height + to_zero + 2 * pad + between;
constexpr const char* grey = "#444444";
constexpr const char* pale = "#eeeeee";

/// What is counted in a panel. Apart, for the one is a simulation that goes through, the other one that stops in vain.
struct Quantity {
  const char* words;
  std::uint64_t AuditCounts::*count;
};
constexpr std::array<Quantity, 2> quantities = {
    {{"contacts missed", &AuditCounts::false_negatives}, {"false positives", &AuditCounts::false_positives}}};

/// Where counts are: a logarithm has no place for none, which has a line of its own below it.
struct Counts {
  LogScale y;
  double zero;

  double operator()(std::uint64_t count) const { return count > 0 ? y(static_cast<double>(count)) : zero; }
};

/// What a mark says of times of impact.
enum class Times { early, late, none };

Times times_of(const AuditCounts& counts) {
  if (counts.times == 0) return Times::none;
  return counts.late.count() > 0 ? Times::late : Times::early;
}

void mark(Svg& svg, Svg::Point at, Times times, const std::string& stroke) {
  constexpr double size = 5;
  const Svg::Point corner = {at[0] - size, at[1] - size};
  if (times == Times::early) return svg.rectangle(corner, {2 * size, 2 * size}, stroke);
  if (times == Times::none) {
    const Svg::Point next = {at[0] + size, at[1] - size};
    const std::array<Svg::Point, 6> around = {
        // one side twice, which closes the corner
        {corner, next, {at[0] + size, at[1] + size}, {at[0] - size, at[1] + size}, corner, next}};
    return svg.polyline(around, stroke, 2);
  }
  for (const double slope : {-size, size}) {
    const std::array<Svg::Point, 2> ends = {{{at[0] - size, at[1] - slope}, {at[0] + size, at[1] + slope}}};
    svg.polyline(ends, stroke, 3);
  }
}

void axes(Svg& svg, const LogScale& x, const Counts& counts, const char* words) {
  const double over = counts.y.to - pad, under = counts.zero + pad;
  for (const Tick& tick : logarithmic_ticks(x.low, x.high)) {
    svg.line({x(tick.value), over}, {x(tick.value), under}, pale);
  }
  for (const Tick& tick : logarithmic_ticks(counts.y.low, counts.y.high)) {
    const double y = counts.y(tick.value);
    svg.line({left, y}, {right, y}, pale);
    svg.line({left - 5, y}, {left, y}, grey);
    svg.text({left - 9, y + 4.5}, tick.words, Anchor::end);
  }
  svg.line({left - 5, counts.zero}, {left, counts.zero}, grey);
  svg.text({left - 9, counts.zero + 4.5}, "0", Anchor::end);
  const double cut = 0.5 * (counts.y.from + counts.zero);
  svg.line({left, cut}, {right, cut}, "#aaaaaa", "2 4");
  svg.frame({left, over}, {right - left, under - over}, grey);
  svg.text({left - 68, 0.5 * (over + under)}, words, Anchor::middle, true);
}

/// Below the last panel.
void times_axis(Svg& svg, const LogScale& x, double y) {
  for (const Tick& tick : logarithmic_ticks(x.low, x.high)) {
    svg.line({x(tick.value), y}, {x(tick.value), y + 5}, grey);
    svg.text({x(tick.value), y + 20}, tick.words, Anchor::middle);
  }
  svg.text({0.5 * (left + right), y + 44}, "time per query [ns]", Anchor::middle);
}

/// How long the unit of times takes for a query, the textbook method in the same run; 0 where that was not measured.
double unit_ns(const AuditOutcome& outcome) {
  for (const LibraryAudit& audit : outcome.audits) {
    if (audit.total.units() > 0) return audit.total.ns_per_query() / audit.total.units();
  }
  return 0;
}

std::string label(const AuditOutcome& outcome, const LibraryAudit& audit) {
  std::string words = fmt::format("{}, {:g}", audit_name(outcome, audit.plugin), audit.tolerance);
  if (!audit.description.empty()) words += fmt::format(" ({})", audit.description);
  const std::uint64_t unanswered = audit.total.queries - audit.total.answered + audit.total.failures;
  return unanswered == 0 ? words : words + fmt::format(", {} without an answer", unanswered);
}

/// One colour for all tolerances of a library.
class Colours {
 public:
  const char* of(const std::filesystem::path& library) {
    static constexpr const char* colours[] = {"#1b6ca8", "#c8553d", "#2e8b57", "#8e5ea2", "#c99a1c",
                                              "#5f6b73", "#17a2a2", "#d0679d", "#222222"};
    return of_.try_emplace(library, colours[of_.size() % std::size(colours)]).first->second;
  }

 private:
  std::map<std::filesystem::path, const char*> of_;
};

void legend(Svg& svg, const AuditOutcome& outcome, Colours& colours) {
  constexpr double x = right + 26, step = 20;
  double line = top;
  const auto add = [&](Times times, const char* colour, const std::string& words) {
    mark(svg, {x, line - 4}, times, colour);
    svg.text({x + 16, line}, words);
    line += step;
  };
  for (const LibraryAudit& audit : outcome.audits) {
    add(times_of(audit.total), colours.of(audit.plugin), label(outcome, audit));
  }
  line += step;
  add(Times::early, "#999999", "no time of impact is late");
  add(Times::late, "#999999", "some are late");
  add(Times::none, "#999999", "gives no times");
}

void draw(Svg& svg, const AuditOutcome& outcome, const Quantity& quantity, const LogScale& x, double over,
          Colours& colours) {
  std::vector<double> values;
  for (const LibraryAudit& audit : outcome.audits) values.push_back(static_cast<double>(audit.total.*quantity.count));
  const Counts counts{logarithmic_scale(values, over + height, over), over + height + to_zero};
  axes(svg, x, counts, quantity.words);
  if (const double unit = unit_ns(outcome); unit > 0) {
    svg.line({x(unit), over - pad}, {x(unit), counts.zero + pad}, "#888888", "5 3");
  }
  for (const LibraryAudit& audit : outcome.audits) {
    mark(svg, {x(audit.total.ns_per_query()), counts(audit.total.*quantity.count)}, times_of(audit.total),
         colours.of(audit.plugin));
  }
}

}  // namespace

std::string audit_svg(const AuditOutcome& outcome) {
  const std::string title = "Continuous collision detection: wrong answers against time";
  const double below = top + quantities.size() * panel - between - pad;
  const double legend_end = top + 20 * static_cast<double>(outcome.audits.size() + 4);
  std::size_t longest = 0;
  for (const LibraryAudit& audit : outcome.audits) longest = std::max(longest, label(outcome, audit).size());
  const double width = std::max(960.0, right + 60 + letter * static_cast<double>(longest));
  Svg svg(width, std::max(below + 60, legend_end), title);
  svg.text({left, 30}, title);
  std::vector<double> times;
  for (const LibraryAudit& audit : outcome.audits) times.push_back(audit.total.ns_per_query());
  const LogScale x = logarithmic_scale(times, left + pad, right - pad);
  Colours colours;
  for (std::size_t i = 0; i < quantities.size(); ++i) {
    draw(svg, outcome, quantities[i], x, top + static_cast<double>(i) * panel, colours);
  }
  times_axis(svg, x, below);
  if (const double unit = unit_ns(outcome); unit > 0) {
    svg.text({x(unit), top - pad - 6}, fmt::format("textbook: {:.0f} ns", unit), Anchor::middle);
  }
  legend(svg, outcome, colours);
  return svg.finish();
}

}  // namespace noli::audit
