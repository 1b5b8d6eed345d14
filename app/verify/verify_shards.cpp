// SPDX-License-Identifier: Apache-2.0
#include "app/verify/verify_shards.h"

#include <fmt/format.h>

#include <optional>
#include <regex>
#include <utility>

#include <noli/errors.h>
#include "app/notes.h"
#include "app/process.h"
#include "app/progress.h"
#include "trajectory/text.h"

namespace noli::app {
namespace {

report::Answer shard_answer(const ShardWork& work, const ShardOutcome& outcome) {
  const bool touches = outcome.first_touch.has_value();
  report::Answer answer(touches ? "contact" : outcome.complete() ? "done" : "undecided");
  answer.add({"shard", fmt::format("{}/{}", work.number, work.of)});
  answer.add({"tasks_total", outcome.tasks_total});
  answer.add({"done", outcome.done});
  answer.add({"there", outcome.there});
  answer.add({"not_needed", outcome.not_needed});
  answer.add({"first_step", touches ? fmt::format("{}", *outcome.first_touch) : "none"});
  const std::string tasks =
      fmt::format("shard {} of {}: {} tasks done, {} were there, {} not needed, of {} in all", work.number, work.of,
                  outcome.done, outcome.there, outcome.not_needed, outcome.tasks_total);
  answer.place = touches ? fmt::format("{}; something touches in step {}", tasks, *outcome.first_touch) : tasks;
  if (outcome.interrupted) answer.place += "; interrupted";
  if (outcome.out_of_time) answer.place += "; time limit";
  const std::string folder = on_one_line(work.folder.string());
  answer.next = outcome.complete() ? fmt::format("when all shards are done, noli merge {} gives the verdict.", folder)
                                   : "the same command does what is missing.";
  return answer;
}

}  // namespace

ShardWork parse_shard(const std::string& text, std::filesystem::path folder) {
  static const std::regex form("([1-9][0-9]{0,8})/([1-9][0-9]{0,8})");
  std::smatch match;
  ShardWork work{std::move(folder)};
  if (std::regex_match(text, match, form)) {
    work.number = std::stoull(match[1].str());
    work.of = std::stoull(match[2].str());
    if (work.number <= work.of) return work;
  }
  throw UsageError(fmt::format("--shard {}: expected K/N with 1 <= K <= N, such as 3/64", on_one_line(text)));
}

ExitCode answer_in_ranks(VerifyRequest& request, std::optional<std::filesystem::path> shards, Ranks& ranks,
                         const VerdictOutputs& outputs, const Output* output) {
  request.stop = &interrupted();
  if (request.threads == 0) request.threads = ranks.threads();
  ShardWork work{shards.value_or(usual_shard_folder(request))};
  work.next_task = [&ranks] { return std::optional(ranks.next_task()); };
  work.no_more = [&ranks] { ranks.take_no_more(); };
  if (!verify_shard(request, work).complete()) {
    tell_note(fmt::format("rank {} was stopped; the same command does what is missing", ranks.rank()));
    return ExitCode::undecided;
  }
  ranks.meet();
  ExitCode code = ExitCode::holds;
  if (output != nullptr) {
    VerifyRequest whole = request_of_shards(work.folder);
    whole.proof = request.proof;
    whole.check = request.check;
    whole.threads = request.threads;
    whole.deadline = request.deadline;
    code = answer(whole, outputs, *output);
    if (!shards && code != ExitCode::undecided) std::filesystem::remove_all(work.folder);
  }
  return ranks.end(code);
}

ExitCode answer_shard(VerifyRequest& request, const ShardWork& work, const Output& output) {
  request.stop = &interrupted();
  std::optional<ProgressBars> bars(std::in_place);
  request.progress = [&](std::string_view what, double share) { bars->show(what, share, ""); };
  const ShardOutcome outcome = verify_shard(request, work);
  bars.reset();
  output.write("verify", shard_answer(work, outcome), Json::object());
  if (outcome.first_touch) return ExitCode::refuted;
  return outcome.complete() ? ExitCode::holds : ExitCode::undecided;
}

}  // namespace noli::app
