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
#include "report/shard_report.h"

namespace noli::app {

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
  return end_of(ranks, code);
}

ExitCode answer_shard(VerifyWork& request, const ShardWork& work, const Output& output) {
  request.stop = &interrupted();
  std::optional<ProgressBars> bars(std::in_place);
  request.progress = [&](std::string_view what, double share) { bars->show(what, share, ""); };
  const ShardOutcome outcome = verify_shard(request, work);
  bars.reset();
  output.write("verify", report::shard_answer(work, outcome, request.step_word()), Json::object());
  return exit_code_of(outcome.refuted(), outcome.holds());
}

}  // namespace noli::app
