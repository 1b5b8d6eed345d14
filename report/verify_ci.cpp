// SPDX-License-Identifier: Apache-2.0
#include "report/verify_ci.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string_view>
#include <utility>

#include <noli/errors.h>
#include "certify/contact_report.h"
#include "report/verify_place.h"
#include "trajectory/text.h"

namespace noli::report {
namespace {

constexpr std::size_t most_annotations = 10;  ///< GitHub shows no more of a step

/// Whether step k, from 0, was decided to its end.
bool is_decided(const VerifyOutcome& outcome, std::size_t k) {
  return k + 1 < outcome.steps.size() || (k + 1 == outcome.steps.size() && outcome.complete);
}

/// Whether the step is too near, or may be.
bool is_near(const VerifyOutcome& outcome, std::size_t k) { return outcome.near && outcome.near->step == k + 1; }

bool is_too_near(const VerifyOutcome& outcome, std::size_t k) { return outcome.is_too_near() && is_near(outcome, k); }

/// What is wrong with a step that was begun; nothing: nothing touches in it.
std::string fault_of(const VerifyRequest& request, const VerifyOutcome& outcome, std::size_t k) {
  const StepCounts& step = outcome.steps[k];
  if (is_too_near(outcome, k)) {
    return fmt::format("{} and {} are not more than {} apart", outcome.near->names[0], outcome.near->names[1],
                       request.min_distance);
  }
  if (!step.touches()) return step.goes_on ? "features that met in the step before still meet as this one begins" : "";
  const bool whole = is_decided(outcome, k) && !request.first_only;
  std::string text;
  if (step.contact_count() > 0) {
    text = fmt::format("{}{} of features meet", whole ? "" : "at least ", plural(step.contact_count(), "pair"));
  }
  if (step.initial_intersections > 0) {
    text += fmt::format("{}{} of cells intersect where the step begins", text.empty() ? "" : ", ",
                        plural(step.initial_intersections, "pair"));
  }
  if (!step.first || !whole) return text;
  return fmt::format("{}; the first at t = {}{}: {}", text, digits17(step.first->time), request.run ? " s" : "",
                     who_and_where(*step.first, outcome.dimension));
}

/// Why a step in which nothing is wrong does not pass; nothing: it does. `last`: outcome.last_for_distance().
std::string why_open(const VerifyRequest& request, const VerifyOutcome& outcome, std::size_t k,
                     std::optional<std::size_t> last) {
  if (k >= outcome.steps.size()) {
    const char* const why = request.keep_going  ? nullptr
                            : outcome.touches() ? "at an earlier contact"
                            : outcome.near      ? "where something came too near"
                                                : nullptr;
    if (why == nullptr) return fmt::format("not looked at: {}", why_incomplete(outcome));
    return fmt::format("not looked at: verification stopped {} (--keep-going)", why);
  }
  if (!is_decided(outcome, k)) return fmt::format("undecided: {}", why_incomplete(outcome));
  if (is_near(outcome, k)) return "undecided: something is about as near as the least distance";
  const bool distance_open = request.min_distance > 0 && last && *last <= k;
  return distance_open
             ? "nothing touches; not checked for the least distance, which an earlier step breaks or may break"
             : "";
}

std::string case_of(const VerifyRequest& request, const VerifyOutcome& outcome, std::size_t k,
                    std::optional<std::size_t> last) {
  const std::string head = fmt::format("    <testcase classname=\"noli.verify\" name=\"{}\"",
                                       escaped_markup(step_name(request, outcome, k + 1)));
  const std::string fault = k < outcome.steps.size() ? fault_of(request, outcome, k) : "";
  if (!fault.empty()) {
    const Verdict verdict = is_too_near(outcome, k) ? Verdict::too_near : Verdict::contact;
    return fmt::format("{}>\n      <failure type=\"{}\" message=\"{}\"/>\n    </testcase>\n", head, name(verdict),
                       escaped_markup(fault));
  }
  const std::string why = why_open(request, outcome, k, last);
  if (why.empty()) return head + "/>\n";
  return fmt::format("{}>\n      <skipped message=\"{}\"/>\n    </testcase>\n", head, escaped_markup(why));
}

/// A property of all cases together.
std::string property(const char* key, std::string_view value) {
  return fmt::format("      <property name=\"{}\" value=\"{}\"/>\n", key, escaped_markup(value));
}

std::string run_end(const VerifyOutcome& outcome) {
  return outcome.ending ? property("run.end", outcome.ending->why.value_or("none")) : "";
}

/// Of a message; of a property also the two characters that end it.
std::string escaped(const std::string& text, bool property) {
  std::string out;
  for (const char c : text) {
    const bool special = c == '%' || c == '\r' || c == '\n' || (property && (c == ':' || c == ','));
    out += special ? fmt::format("%{:02X}", static_cast<unsigned char>(c)) : std::string(1, c);
  }
  return out;
}

std::string annotation(const char* level, const std::string& title, const std::string& message) {
  return fmt::format("::{} title={}::{}\n", level, escaped(title, true), escaped(message, false));
}

}  // namespace

std::string verify_junit(const VerifyRequest& request, const VerifyOutcome& outcome) {
  std::string cases;
  std::size_t failures = 0, skipped = 0;
  const std::size_t count = std::max(outcome.steps_total, outcome.steps.size());
  const auto last = outcome.last_for_distance();
  for (std::size_t k = 0; k < count; ++k) {
    const std::string one = case_of(request, outcome, k, last);
    failures += one.find("<failure ") != std::string::npos ? 1 : 0;
    skipped += one.find("<skipped ") != std::string::npos ? 1 : 0;
    cases += one;
  }
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites>\n  <testsuite name=\"noli verify\" tests=\"{}\" "
      "failures=\"{}\" errors=\"0\" skipped=\"{}\">\n    <properties>\n{}{}    </properties>\n{}  "
      "</testsuite>\n</testsuites>\n",
      count, failures, skipped, property("verdict", name(outcome.verdict)),
      property("answer", place_of(request, outcome)) + run_end(outcome), cases);
}

std::string verify_annotations(const VerifyRequest& request, const VerifyOutcome& outcome) {
  std::string lines;
  std::size_t left_out = 0, written = 0;
  for (std::size_t k = 0; k < outcome.steps.size(); ++k) {
    const std::string fault = fault_of(request, outcome, k);
    if (fault.empty()) continue;
    if (written == most_annotations) {
      ++left_out;
      continue;
    }
    ++written;
    lines += annotation("error", "noli: " + step_name(request, outcome, k + 1), fault);
  }
  if (left_out > 0) lines += annotation("warning", "noli", fmt::format("{} more steps have contacts", left_out));
  if (written > 0) return lines;
  const char* const level = outcome.verdict == Verdict::undecided ? "error" : "notice";
  return annotation(level, "noli: " + std::string(name(outcome.verdict)), place_of(request, outcome));
}

}  // namespace noli::report
