// SPDX-License-Identifier: Apache-2.0
#include "certify/shards/shard_motion.h"

#include <algorithm>
#include <chrono>
#include <deque>
#include <filesystem>
#include <thread>

#include <noli/errors.h>
#include "certify/process/hdf5_frames.h"
#include "certify/proofs/prove_frames.h"
#include "certify/shards/request_json.h"
#include "certify/simulate/reproduced_windows.h"
#include "certify/verification.h"
#include "proofs/prover/chain.h"
#include "trajectory/blocks/folder_lock.h"
#include "trajectory/blocks/run_file.h"
#include "trajectory/blocks/sha256.h"
#include "trajectory/formats/frame_sequence.h"

namespace noli {
namespace {

namespace fs = std::filesystem;

void require_files(const VerifyWork& request) {
  if (request.trajectory) throw UsageError("--trajectory: writes all frames; drop it when they are verified in parts");
  const bool files =
      std::ranges::all_of(request.frames, [](const fs::path& file) { return fs::is_regular_file(file); });
  if (request.reading.given || !files) {
    throw UsageError("each shard opens the frames again; expected regular files, found a pipe or similar");
  }
}

void require_divisible(const VerifyWork& request) {
  if (request.run) throw UsageError("--divide: cuts the step between two frames; expected frames, found a run");
  if (request.first_only) throw UsageError("--divide: all parts count contacts; expected no --first-only");
  if (!verifier_proves(request)) {
    throw UsageError(
        "--divide: cannot be combined with --only-new, --ignore and --min-distance; expected none of them");
  }
}

class Frames : public ShardMotion {
 public:
  explicit Frames(const VerifyWork& request)
      : frames_(open_all_frames(request.frames, request.reading)),
        motion_(request.constant_motion ? Motion::constant : Motion::linear) {}

  std::uint64_t step_count() override {
    const auto steps = FrameSequence(*frames_, motion_).step_count();
    if (!steps) throw UsageError("the number of frames is not known in advance; expected files");
    return *steps;
  }

  bool is_source_of(const ShardReader& shard, const StepRange& /*range*/) override {
    for (const Json& file : shard.head().at("files")) look_at(file.at(0).get<std::uint64_t>());
    return !other_input(shard, frames_->facts());
  }

 private:
  /// A file of many frames is looked at as a whole.
  void look_at(std::uint64_t file) {
    const auto& facts = frames_->facts();
    if (file < facts.size() && !facts[file].looked_at) frames_->look_at(file);
  }

  std::unique_ptr<FrameSource> frames_;
  Motion motion_;
};

class Windows : public ShardMotion {
 public:
  explicit Windows(const VerifyWork& request) : request_(request), run_(request.frames.at(0)), counted_(run_) {
    require_can_be_asked(request, counted_);
    if (request.reproduce)
      ReproducedWindows::of(run_, request.scene_folder, counted_.scene(), {});  // are its files there?
    claim_ = shared_claim_json(claim_of_run(request, counted_.scene()));
  }

  std::uint64_t step_count() override {
    look();
    if (counted_.windows() == 0 && !request_.follow) {
      throw InputError(run_.string(), "", "has no window yet; wait for one, or pass --follow");
    }
    return counted_.windows();
  }

  void wait_for(std::uint64_t count, const std::function<bool()>& needed) override {
    constexpr auto pause = std::chrono::milliseconds(50);
    while (request_.follow && look() && counted_.windows() < count && needed()) {
      end_if_stopped(request_);
      if (request_.progress) request_.progress("wait", 0);
      std::this_thread::sleep_for(pause);
    }
  }

  bool is_source_of(const ShardReader& shard, const StepRange& range) override {
    const Json &known = shard.head().at("windows"), &claim = shard.head().at("claim");
    if (shard.head().at("end") != range.end || known.size() < 2 || claim != claim_) return false;
    RunReader reader(run_);
    const auto is_next = [&reader](const Json& hash) {
      return reader.skip_window() && hash == hex(reader.committed().group);
    };
    if (!is_next(known[0])) return false;
    if (range.first == 0) return known[0] == known[1] && std::all_of(known.begin() + 2, known.end(), is_next);
    reader.skip_to(*before(range));
    reader.skip_to(range.first);
    return std::all_of(known.begin() + 1, known.end(), is_next);
  }

  const CommitPoint* before(const StepRange& range) override {
    const std::uint64_t task = range.first / steps_of_chain;
    return task == 0 ? nullptr : &tasks_.at(task - 1);
  }

 private:
  /// Counts the windows that are there now. Returns whether more may come.
  bool look() {
    const bool is_written = is_locked(run_);  // asked before the look, so that the last windows are seen
    try {
      count();
    } catch (const InputError&) {  // a window that is not committed may be taken back while it is looked at
      if (!is_written) throw;
    }
    return is_written;
  }

  void count() {
    counted_.look_again();
    while (counted_.skip_window()) {
      if (counted_.windows() % steps_of_chain == steps_of_chain - 1) tasks_.push_back(counted_.committed());
    }
  }

  const VerifyWork& request_;
  fs::path run_;
  RunReader counted_;  ///< behind the last window that was there
  Json claim_;
  std::deque<CommitPoint> tasks_;  ///< of each task but the first: behind the last window but one before it
};

}  // namespace

std::unique_ptr<ShardMotion> motion_of_shards(const VerifyWork& request) {
  if (request.divide) require_divisible(request);
  if (!request.run) {
    require_files(request);
    return std::make_unique<Frames>(request);
  }
  if (request.lines_in_no_file && are_proved(request)) {
    throw UsageError(
        "--reproduce: the run recorded only frames, so no file has the world lines that a checker would read when the "
        "parts are joined; expected --no-check, without --proof and --min-distance");
  }
  return std::make_unique<Windows>(request);
}

}  // namespace noli
