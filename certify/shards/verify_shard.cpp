// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include <noli/errors.h>
#include <noli/sequence.h>
#include "certify/process/scratch_folder.h"
#include "certify/shards/decided_shards.h"
#include "certify/shards/request_json.h"
#include "certify/shards/shard_motion.h"
#include "certify/shards/shards.h"
#include "certify/shards/step_json.h"
#include "certify/step_parts.h"
#include "certify/verification.h"
#include "proofs/prover/chain.h"
#include "trajectory/blocks/folder_lock.h"
#include "trajectory/blocks/sha256.h"

namespace noli {
namespace {

namespace fs = std::filesystem;

class ShardMaker : private StepParts {
 public:
  ShardMaker(const VerifyWork& request, const ShardWork& work)
      : request_(request),
        work_(work),
        proved_(noli::are_proved(request)),
        motion_(motion_of_shards(request)),
        steps_(counted_steps()),
        folder_(work.folder, request_json(request)) {
    count_tasks();
  }

  ShardOutcome operator()() {
    try {
      request_.divide ? make_parts() : make_all();
    } catch (const Stopped& stopped) {
      outcome_.interrupted |= stopped.reason() == StopReason::interrupted;
      outcome_.out_of_time |= stopped.reason() == StopReason::out_of_time;
    }
    return outcome_;
  }

 private:
  /// Called before the folder is made: a request that is refused leaves nothing.
  std::uint64_t counted_steps() const {
    const std::uint64_t steps = motion_->step_count();
    if (request_.divide && steps != 1) {
      throw UsageError(
          fmt::format("--divide: expected one step (two frames, or one with --static), found {} steps", steps));
    }
    return steps;
  }

  void make_all() {
    while (const auto task = next_task()) {
      if (*task > last_needed_) {
        ++outcome_.not_needed;
      } else if (!is_there(*task) && !make(*task)) {
        break;
      }
    }
  }

  /// Of a divided step. The frames are read, and the tree is built, once for all parts.
  void make_parts() {
    next_part_ = next_missing();
    if (!next_part_) return;
    VerifyWork request = request_;
    request.parts = this;
    request.proof.reset();
    request.open_proof = nullptr;
    request.progress = [this](std::string_view work, double share) { tell_of_part(work, share); };
    note_stop(run_verify(request));
  }

  std::optional<std::uint64_t> next_missing() {
    while (const auto task = next_task()) {
      if (!is_there(*task)) return task;
    }
    return std::nullopt;
  }

  bool are_proved() const override { return proved_; }

  std::optional<StepPart> next() override {
    const auto part = next_part_ ? std::exchange(next_part_, std::nullopt) : next_missing();
    if (part) part_ = *part;
    return part ? std::optional(StepPart{static_cast<std::uint32_t>(*part), parts_of_step}) : std::nullopt;
  }

  void take(const StepPart& part, const StepResult& result, const VerifyOutcome& outcome) override {
    const bool unproved = proved_ && !result.touches() && result.proof == nullptr;
    Json head = head_json(part.index, range_of(part.index), {result}, outcome, unproved);
    head["files"] = files_json(outcome);
    write_part_shard(folder_.shard(part.index), head, result.proof.get());
    ++outcome_.done;
    note_end(head);
  }

  void note_stop(const VerifyOutcome& found) {
    outcome_.interrupted |= found.interrupted;
    outcome_.out_of_time |= found.out_of_time;
  }

  std::optional<std::uint64_t> next_task() {
    const auto task = work_.next_task ? work_.next_task() : std::optional(work_.number - 1 + made_++ * work_.of);
    if (task && request_.follow && *task <= last_needed_) wait_for(*task);
    if (!task || *task >= outcome_.tasks_total) return std::nullopt;
    end_if_stopped(request_);
    return task;
  }

  /// Until the task is complete, or as complete as it gets.
  void wait_for(std::uint64_t task) {
    motion_->wait_for((task + 1) * steps_of_chain, [this] { return !work_.are_needed || work_.are_needed(); });
    steps_ = motion_->step_count();
    count_tasks();
  }

  void count_tasks() {
    outcome_.tasks_total = request_.divide ? parts_of_step : (steps_ + steps_of_chain - 1) / steps_of_chain;
  }

  StepRange range_of(std::uint64_t task) const {
    if (request_.divide) return {0, steps_};
    return {task * steps_of_chain, std::min((task + 1) * steps_of_chain, steps_)};
  }

  /// Whether there is a whole shard of the task, made from the files as they are now.
  bool is_there(std::uint64_t task) {
    if (!folder_.has(task)) return false;
    try {
      const ShardReader shard(folder_.shard(task), folder_.request_hash(), task);
      return reading(shard.name(), [&] {
        if (!motion_->is_source_of(shard, range_of(task))) return false;
        note_end(shard.head());
        ++outcome_.already_done;
        return true;
      });
    } catch (const InputError&) {
      return false;
    }
  }

  /// False if it was stopped: nothing is written then.
  bool make(std::uint64_t task) {
    const StepRange range = range_of(task);
    const ScratchFolder scratch;
    const fs::path proof = scratch.path() / "proof.noli";
    std::vector<StepResult> decisions;
    std::vector<Sha256Digest> windows;
    VerifyWork part = request_;
    part.only = range;
    part.decisions = &decisions;
    part.windows = &windows;
    part.before = motion_->before(range);
    part.progress = [&](std::string_view work, double share) { tell(work, share, range); };
    part.proof.reset();
    part.open_proof = proved_ ? proof_to_file(proof) : nullptr;
    part.open_proof_at_once = false;
    const VerifyOutcome found = run_verify(part);
    note_stop(found);
    if (!outcome_.complete()) return false;
    Json head = head_json(task, range, decisions, found, found.no_proof);
    head[request_.run ? "windows" : "files"] = request_.run ? windows_json(windows) : files_json(found);
    write_shard(folder_.shard(task), head, fs::exists(proof) ? std::optional(proof) : std::nullopt);
    ++outcome_.done;
    note_end(head);
    return true;
  }

  /// Frames tell where they are in the whole sequence.
  void tell(std::string_view work, double share, const StepRange& range) const {
    if (!request_.progress) return;
    const auto length = static_cast<double>(range.end - range.first);
    const double done = static_cast<double>(range.first) + share * length;
    request_.progress(work, request_.run ? done / static_cast<double>(steps_) : share);
  }

  void tell_of_part(std::string_view work, double share) const {
    if (!request_.progress) return;
    const double done = (static_cast<double>(part_) + share) / parts_of_step;
    request_.progress(work, work == "verify" ? done : share);
  }

  static Json files_json(const VerifyOutcome& outcome) {
    Json list = Json::array();
    for (std::size_t i = 0; i < outcome.inputs.size(); ++i) {
      if (outcome.inputs[i].looked_at) list.push_back({i, hex(outcome.inputs[i].sha256)});
    }
    return list;
  }

  static Json windows_json(const std::vector<Sha256Digest>& windows) {
    Json list = Json::array();
    for (const Sha256Digest& hash : windows) list.push_back(hex(hash));
    return list;
  }

  Json head_json(std::uint64_t task, const StepRange& range, const std::vector<StepResult>& decisions,
                 const VerifyOutcome& found, bool unproved) const {
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
    return {{"format", "noli shard"},
            {"version", 1},
            {"request", folder_.request_hash()},
            {"task", task},
            {"first", range.first},
            {"end", range.end},
            {"claim", shared_claim_json(found.claim)},
            {"touch", touch},
            {"ends", !request_.divide &&  // all parts of a step count contacts
                         (decisions.size() < range.end - range.first || found.near || !touch.is_null())},
            {"near", near},
            {"unproved", unproved},
            {"largest_distance", largest},
            {"steps", steps}};
  }

  /// After a contact, nothing more is asked unless the request goes on.
  void note_end(const Json& head) {
    const auto lower = [](std::optional<std::uint64_t>& least, const Json& step) {
      if (!step.is_null()) least = std::min(least.value_or(~std::uint64_t{0}), step.get<std::uint64_t>() + 1);
    };
    lower(outcome_.first_touch, head.at("touch"));
    if (!head.at("near").is_null()) lower(outcome_.first_near, head.at("near").at("step"));
    outcome_.unproved |= request_.needs_proof() && head.at("unproved").get<bool>();
    if (!request_.keep_going && head.at("ends").get<bool>()) {
      last_needed_ = std::min(last_needed_, head.at("task").get<std::uint64_t>());
      if (work_.no_more) work_.no_more();
    }
  }

  const VerifyWork& request_;
  const ShardWork& work_;
  bool proved_;
  std::unique_ptr<ShardMotion> motion_;
  std::uint64_t steps_;
  ShardFolder folder_;
  ShardOutcome outcome_;
  std::uint64_t made_ = 0;
  /// Looked for before the frames are read, so that nothing is read when all parts are there.
  std::optional<std::uint64_t> next_part_;
  std::uint64_t part_ = 0;                         ///< the last one that was asked for
  std::uint64_t last_needed_ = ~std::uint64_t{0};  ///< no task behind it is needed
};

}  // namespace

fs::path usual_shard_folder(const VerifyWork& request) {
  const std::string hash = hex(sha256(to_text(request_json(request))));
  return "noli-shards-" + hash.substr(0, 12);
}

ShardOutcome verify_shard(const VerifyWork& request, const ShardWork& work) { return ShardMaker(request, work)(); }

VerifyWork request_of_shards(const fs::path& folder) {
  ShardFolder shards(folder);
  return reading((folder / "request.json").string(), [&] {
    VerifyWork request = request_of_json(shards.request());
    const Json now = request_json(request);
    for (const char* const member : {"ignore", "reproduce"}) {  // whose files have to be the same
      if (now.at(member) == shards.request().at(member)) continue;
      throw InputError((folder / "request.json").string(), std::string("/") + member,
                       "is about files that have changed; expected the same ones, or a new folder");
    }
    request.live = request.run && is_locked(request.frames.at(0));
    request.prepare_to_reproduce();
    if (request.divide) {
      request.decided = std::make_shared<DecidedParts>(std::move(shards), request);
    } else {
      request.decided = std::make_shared<DecidedShards>(std::move(shards), request.run);
    }
    return request;
  });
}

}  // namespace noli
