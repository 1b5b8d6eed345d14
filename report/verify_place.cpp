// SPDX-License-Identifier: Apache-2.0
#include "report/verify_place.h"

#include <fmt/format.h>

#include <noli/errors.h>
#include "certify/contact_report.h"
#include "certify/json.h"
#include "certify/not_compared.h"
#include "certify/proofs/claim.h"

namespace noli::report {
namespace {

/// What stands behind the verdict, in the last line.
class Place {
 public:
  Place(const VerifyRequest& request, const VerifyOutcome& outcome) : request_(request), outcome_(outcome) {}

  std::string operator()() const {
    switch (outcome_.verdict) {
      case Verdict::proved:
        return fmt::format("{}: {} ({})", looked_at(), nothing_touches_text(outcome_), by_checker());
      case Verdict::no_contact:
        return fmt::format("{}: {} (decided exactly, not checked)", looked_at(), nothing_touches_text(outcome_));
      case Verdict::contact: return contact();
      case Verdict::too_near: return near();
      case Verdict::undecided:
        if (!request_.run && outcome_.steps.size() == outcome_.steps_total) {
          return fmt::format("{} {} begun: nothing found so far ({})", outcome_.steps.size(),
                             steps_word(request_, outcome_.steps.size()), why_incomplete(outcome_));
        }
        return fmt::format("{} of {} {} begun: nothing found so far ({})", outcome_.steps.size(), outcome_.steps_total,
                           steps_word(request_, outcome_.steps_total), why_incomplete(outcome_));
    }
    return "";
  }

 private:
  std::string looked_at() const {
    std::string steps = fmt::format("{} {}", outcome_.steps_total, steps_word(request_, outcome_.steps_total));
    if (request_.constant_motion) return steps;
    if (!request_.run) return fmt::format("{} frames, {}", outcome_.frame_count(), steps);
    const RunEnding& ending = *outcome_.ending;
    if (ending.whole() || !ending.duration) return fmt::format("{}, {} s", steps, digits4(ending.time));
    const std::string of = ending.windows_total
                               ? fmt::format("{} of {}{} windows", outcome_.steps_total,
                                             ending.some_ended_early ? "at least " : "", *ending.windows_total)
                               : steps;
    return fmt::format("{}, {} of {} s", of, digits4(ending.time), *ending.duration);
  }

  std::string by_checker() const {
    return outcome_.checker ? fmt::format("accepted by {} {}", outcome_.checker->name, outcome_.checker->version)
                            : "accepted by the checker";
  }

  std::string contact() const {
    if (outcome_.first && !intersects_first(outcome_)) {
      const ListedContact& first = *outcome_.first;
      return fmt::format("{}  t = {}{}  {}{}", step_name(request_, outcome_, first.step), digits4(first.time),
                         request_.run ? " s" : "", who_and_where(first, outcome_.dimension), rests_on());
    }
    if (outcome_.initial_reports.empty()) return "from the beginning" + rests_on();
    const ListedInitial& first = outcome_.initial_reports.front();
    return fmt::format("{}  from its beginning  {} × {}{}", step_name(request_, outcome_, first.step), first.names[0],
                       first.names[1], rests_on());
  }

  /// What the checker's witness rests on that is not asked by default: "; z does not count".
  std::string rests_on() const {
    const std::size_t at = outcome_.checked ? outcome_.checked->find("; ") : std::string::npos;
    return at == std::string::npos ? "" : outcome_.checked->substr(at);
  }

  std::string near() const {
    const ListedNear& near = *outcome_.near;
    const std::string ring = request_.ring > 1 ? fmt::format(", {} mesh edges or more away", request_.ring) : "";
    return fmt::format("{}  for example at t = {}: {} × {}, not more than {} apart{}",
                       step_name(request_, outcome_, near.step), digits4(near.pair.time), near.names[0], near.names[1],
                       request_.min_distance, ring);
  }

  const VerifyRequest& request_;
  const VerifyOutcome& outcome_;
};

}  // namespace

std::string nothing_touches_text(const VerifyOutcome& outcome) {
  std::string text = nothing_touches_in_short(outcome.not_compared);
  text += distance_phrase(outcome.claim);
  Claim others = outcome.claim;
  if (outcome.not_compared.any()) others.excluded.clear();  // named above
  for (const std::string& phrase : weakenings(others)) text += "; " + phrase;
  return text;
}

const char* steps_word(const VerifyRequest& request, std::size_t count) {
  if (request.run) return count == 1 ? "window" : "windows";
  if (request.constant_motion) return count == 1 ? "frame at rest" : "frames at rest";
  return count == 1 ? "step" : "steps";
}

std::string plural(std::uint64_t count, const char* thing) {
  return fmt::format("{} {}{}", count, thing, count == 1 ? "" : "s");
}

/// "c.ply → d.ply", "c.ply" for a frame at rest, nothing for a window.
std::string step_frames(const VerifyRequest& request, const VerifyOutcome& outcome, std::size_t number) {
  if (request.run) return "";
  const auto name = [&](std::size_t frame) {
    return on_one_line(std::filesystem::path(outcome.frame_name(frame)).filename().string());
  };
  return request.constant_motion ? name(number - 1) : fmt::format("{} → {}", name(number - 1), name(number));
}

bool intersects_first(const VerifyOutcome& outcome) {
  if (outcome.initial_reports.empty()) return false;
  return !outcome.first || outcome.initial_reports.front().step <= outcome.first->step;
}

const char* why_incomplete(const VerifyOutcome& outcome) {
  if (outcome.no_proof) return "no proof was found";
  if (outcome.interrupted) return "interrupted";
  if (outcome.out_of_time) return "time limit";
  if (outcome.near) return "something is about as near as the least distance, but no witness was found";
  return outcome.steps_total == 0 ? "no window was committed" : "first contact only";
}

std::string step_name(const VerifyRequest& request, const VerifyOutcome& outcome, std::size_t number) {
  const std::string frames = step_frames(request, outcome, number);
  return fmt::format("{} {}{}", request.step_word(), number, frames.empty() ? "" : " (" + frames + ")");
}

std::string place_of(const VerifyRequest& request, const VerifyOutcome& outcome) { return Place(request, outcome)(); }

}  // namespace noli::report
