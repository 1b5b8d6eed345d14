// SPDX-License-Identifier: Apache-2.0
#include "report/shard_report.h"

#include <fmt/format.h>

#include <string>
#include <string_view>

#include <noli/errors.h>

namespace noli::report {
namespace {

std::string_view verdict_of_shard(const ShardOutcome& outcome) {
  if (outcome.refuted()) return name(outcome.first_touch ? Verdict::contact : Verdict::too_near);
  return outcome.holds() ? "done" : name(Verdict::undecided);
}

/// "shard 3 of 64: 2 of 256 tasks done now, 1 before, ..."
std::string place_of_shard(const ShardWork& work, const ShardOutcome& outcome, const char* step) {
  std::string place = fmt::format("shard {} of {}: {} of {} tasks done now, {} before, {} not needed", work.number,
                                  work.of, outcome.done, outcome.tasks_total, outcome.already_done, outcome.not_needed);
  if (outcome.first_touch) place += fmt::format("; something touches in {} {}", step, *outcome.first_touch);
  if (outcome.first_near) place += fmt::format("; something comes too near in {} {}", step, *outcome.first_near);
  if (outcome.unproved) place += fmt::format("; no proof was found for some {}", step);
  if (outcome.interrupted) place += "; interrupted";
  if (outcome.out_of_time) place += "; time limit";
  return place;
}

}  // namespace

Answer shard_answer(const ShardWork& work, const ShardOutcome& outcome, const char* step_word) {
  const auto step = [](const auto& number) { return number ? fmt::format("{}", *number) : std::string("none"); };
  Answer answer(verdict_of_shard(outcome), {{"shard", fmt::format("{}/{}", work.number, work.of)},
                                            {"tasks_total", outcome.tasks_total},
                                            {"done", outcome.done},
                                            {"already_done", outcome.already_done},
                                            {"not_needed", outcome.not_needed},
                                            {"first_touch", step(outcome.first_touch)},
                                            {"first_near", step(outcome.first_near)}});
  answer.place = place_of_shard(work, outcome, step_word);
  answer.next = outcome.complete() ? fmt::format("when all shards are done, noli merge {} gives the verdict.",
                                                 on_one_line(work.folder.string()))
                                   : "run the same command for the rest.";
  return answer;
}

}  // namespace noli::report
