// SPDX-License-Identifier: Apache-2.0
#include <noli/shards.h>

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include <noli/errors.h>
#include <noli/sequence.h>
#include "certify/process/hdf5_frames.h"
#include "certify/process/scratch_folder.h"
#include "certify/proofs/claim.h"
#include "certify/shards/decided_shards.h"
#include "certify/shards/request_json.h"
#include "certify/shards/step_json.h"
#include "proofs/prover/chain.h"
#include "trajectory/blocks/sha256.h"

namespace noli {
namespace {

namespace fs = std::filesystem;

void require_parts(const VerifyRequest& request) {
  if (request.run) throw UsageError("--shard: is for frames; expected no run");
  if (request.trajectory) throw UsageError("--trajectory: is for all frames; expected none with --shard");
  const bool files =
      std::ranges::all_of(request.frames, [](const fs::path& file) { return fs::is_regular_file(file); });
  if (request.reading.given || !files) {
    throw UsageError("--shard: each process reads its frames; expected regular files, found something else");
  }
}

bool are_proved(const VerifyRequest& request) { return request.check || request.needs_proof(); }

std::uint64_t step_count(const VerifyRequest& request) {
  const auto frames = open_all_frames(request.frames, request.reading)->count();
  if (!frames) throw UsageError("--shard: how many frames there are is not known before the last; expected files");
  return *frames - (request.constant_motion || *frames == 0 ? 0 : 1);
}

Json files_json(const VerifyOutcome& outcome) {
  Json list = Json::array();
  for (std::size_t i = 0; i < outcome.inputs.size(); ++i) {
    if (outcome.inputs[i].looked_at) list.push_back({i, hex(outcome.inputs[i].sha256)});
  }
  return list;
}

class ShardMaker {
 public:
  ShardMaker(const VerifyRequest& request, const ShardWork& work)
      : request_(request),
        work_(work),
        proved_(are_proved(request)),
        steps_(step_count(request)),
        folder_(work.folder, request_json(request, proved_)) {
    outcome_.tasks_total = (steps_ + steps_of_chain - 1) / steps_of_chain;
  }

  ShardOutcome operator()() {
    while (const auto task = next_task()) {
      if (*task > last_needed_) {
        ++outcome_.not_needed;
      } else if (folder_.has(*task)) {
        ++outcome_.there;
        note_end(ShardReader(folder_.shard(*task), folder_.request_hash(), *task).head());
      } else if (!make(*task)) {
        break;
      }
    }
    return outcome_;
  }

 private:
  std::optional<std::uint64_t> next_task() {
    const auto task = work_.next_task ? work_.next_task() : std::optional(work_.number - 1 + made_++ * work_.of);
    return task && *task < outcome_.tasks_total ? task : std::nullopt;
  }

  /// False if it was stopped: nothing is written then.
  bool make(std::uint64_t task) {
    const StepRange range{task * steps_of_chain, std::min((task + 1) * steps_of_chain, steps_)};
    const ScratchFolder scratch;
    const fs::path proof = scratch.path() / "proof.noli";
    std::vector<StepResult> decisions;
    VerifyRequest part = request_;
    part.only = range;
    part.decisions = &decisions;
    part.proof.reset();
    part.open_proof = proved_ ? proof_to_file(proof) : nullptr;
    part.open_proof_at_once = false;
    const VerifyOutcome found = run_verify(part);
    outcome_.interrupted |= found.interrupted;
    outcome_.out_of_time |= found.out_of_time;
    if (!outcome_.complete()) return false;
    const Json head = head_json(task, range, decisions, found);
    write_shard(folder_.shard(task), head, fs::exists(proof) ? std::optional(proof) : std::nullopt);
    ++outcome_.done;
    note_end(head);
    return true;
  }

  Json head_json(std::uint64_t task, const StepRange& range, const std::vector<StepResult>& decisions,
                 const VerifyOutcome& found) const {
    Json steps = Json::array(), near, largest;
    for (const StepResult& decision : decisions) steps.push_back(step_json(decision));
    if (found.near) {
      near = near_json(found.near->pair, found.near->witnessed);
      near["step"] = range.first + found.near->step - 1;
    }
    if (found.largest_distance) {
      largest = {{"allowed", found.largest_distance->allowed}, {"limit", found.largest_distance->limit}};
    }
    const auto touching = std::ranges::find_if(decisions, &StepResult::touches);
    const Json touch = touching == decisions.end() ? Json() : Json(range.first + (touching - decisions.begin()));
    return {
        {"format", "noli shard"},
        {"version", 1},
        {"request", folder_.request_hash()},
        {"task", task},
        {"first", range.first},
        {"end", range.end},
        {"claim", claim_json(found.claim)},
        {"touch", touch},
        {"ends", decisions.size() < range.end - range.first || !found.steps.size() || found.near || !touch.is_null()},
        {"near", near},
        {"largest_distance", largest},
        {"steps", steps},
        {"files", files_json(found)}};
  }

  /// Behind a contact, nothing more is asked unless the request goes on.
  void note_end(const Json& head) {
    const Json touch = head.value("touch", Json());
    if (!touch.is_null()) {
      const auto step = touch.get<std::uint64_t>() + 1;
      outcome_.first_touch = std::min(outcome_.first_touch.value_or(step), step);
    }
    if (!request_.keep_going && head.value("ends", false)) {
      last_needed_ = std::min(last_needed_, head.value("task", last_needed_));
      if (work_.no_more) work_.no_more();
    }
  }

  const VerifyRequest& request_;
  const ShardWork& work_;
  bool proved_;
  std::uint64_t steps_;
  ShardFolder folder_;
  ShardOutcome outcome_;
  std::uint64_t made_ = 0;
  std::uint64_t last_needed_ = ~std::uint64_t{0};  ///< no task behind it is needed
};

}  // namespace

fs::path usual_shard_folder(const VerifyRequest& request) {
  const std::string hash = hex(sha256(to_text(request_json(request, are_proved(request)))));
  return "noli-shards-" + hash.substr(0, 12);
}

ShardOutcome verify_shard(const VerifyRequest& request, const ShardWork& work) {
  require_parts(request);
  return ShardMaker(request, work)();
}

VerifyRequest request_of_shards(const fs::path& folder) {
  ShardFolder shards(folder);
  try {
    VerifyRequest request = request_of_json(shards.request());
    request.decided = std::make_shared<DecidedShards>(std::move(shards));
    return request;
  } catch (const Json::exception& error) {
    throw InputError((folder / "request.json").string(), "", error.what());
  }
}

}  // namespace noli
