// SPDX-License-Identifier: Apache-2.0
#include "app/verify/verify_shards.h"

#include <fmt/format.h>

#include <optional>
#include <string_view>
#include <utility>

#include <noli/errors.h>
#include "app/notes.h"
#include "app/process.h"
#include "app/progress.h"
#include "trajectory/text.h"

namespace noli::app {
namespace {

std::string_view verdict_of(const ShardOutcome& outcome) {
  if (!outcome.complete()) return name(Verdict::undecided);  // whatever was found: tasks are missing
  if (outcome.first_touch) return name(Verdict::contact);
  if (outcome.first_near) return name(Verdict::too_near);
  return outcome.unproved ? name(Verdict::undecided) : "done";
}

/// "shard 3 of 64: 2 of 256 tasks done now, 1 before, ..."
std::string place_of(const ShardWork& work, const ShardOutcome& outcome, const char* step) {
  std::string place = fmt::format("shard {} of {}: {} of {} tasks done now, {} before, {} not needed", work.number,
                                  work.of, outcome.done, outcome.tasks_total, outcome.already_done, outcome.not_needed);
  if (outcome.first_touch) place += fmt::format("; something touches in {} {}", step, *outcome.first_touch);
  if (outcome.first_near) place += fmt::format("; something comes too near in {} {}", step, *outcome.first_near);
  if (outcome.unproved) place += fmt::format("; no proof was found for some {}", step);
  if (outcome.interrupted) place += "; interrupted";
  if (outcome.out_of_time) place += "; time limit";
  return place;
}

report::Answer shard_answer(const ShardWork& work, const ShardOutcome& outcome, const char* step_word) {
  const auto step = [](const auto& number) { return number ? fmt::format("{}", *number) : std::string("none"); };
  report::Answer answer(verdict_of(outcome), {{"shard", fmt::format("{}/{}", work.number, work.of)},
                                              {"tasks_total", outcome.tasks_total},
                                              {"done", outcome.done},
                                              {"already_done", outcome.already_done},
                                              {"not_needed", outcome.not_needed},
                                              {"first_touch", step(outcome.first_touch)},
                                              {"first_near", step(outcome.first_near)}});
  answer.place = place_of(work, outcome, step_word);
  answer.next = outcome.complete() ? fmt::format("when all shards are done, noli merge {} gives the verdict.",
                                                 on_one_line(work.folder.string()))
                                   : "run the same command for the rest.";
  return answer;
}

}  // namespace

ExitCode answer_in_ranks(VerifyWork& request, const std::optional<std::filesystem::path>& shards, Ranks& ranks,
                         const VerdictOutputs& outputs, const Output* output) {
  if (request.live && !request.follow) {
    throw UsageError(
        "another process writes to the run, so ranks may see different windows; pass --follow, or wait until it ends");
  }
  request.stop = &interrupted();
  const int threads = request.threads;
  if (threads == 0) request.threads = ranks.threads();
  ShardWork work{shards.value_or(usual_shard_folder(request))};
  work.next_task = [&ranks] { return ranks.next_task(); };
  work.no_more = [&ranks] { ranks.close_counter(); };
  work.are_needed = [&ranks] { return !ranks.counter_is_closed(); };
  request.progress = [&ranks](std::string_view /*work*/, double /*share*/) { ranks.serve(); };
  if (!verify_shard(request, work).complete()) {
    tell_note(fmt::format("rank {} was stopped; run the same command for the rest", ranks.rank()));
    return ExitCode::undecided;
  }
  ranks.barrier();
  ExitCode code = ExitCode::holds;
  if (output != nullptr) {
    VerifyWork whole = request_of_shards(work.folder);
    whole.proof = request.proof;
    whole.check = request.check;
    whole.threads = threads;  // the other ranks wait
    whole.deadline = request.deadline;
    code = answer(whole, outputs, *output);
    if (!shards && code != ExitCode::undecided) std::filesystem::remove_all(work.folder);
  }
  return ranks.end(code);
}

ExitCode answer_shard(VerifyWork& request, const ShardWork& work, const Output& output) {
  request.stop = &interrupted();
  std::optional<ProgressBars> bars(std::in_place);
  request.progress = [&](std::string_view what, double share) { bars->show(what, share, ""); };
  const ShardOutcome outcome = verify_shard(request, work);
  bars.reset();
  output.write("verify", shard_answer(work, outcome, request.step_word()), Json::object());
  const bool refuted = outcome.complete() && (outcome.first_touch || outcome.first_near);
  return exit_code_of(refuted, outcome.complete() && !outcome.unproved);
}

}  // namespace noli::app
