// SPDX-License-Identifier: Apache-2.0
#include "certify/shards/shard_motion.h"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <thread>

#include <noli/errors.h>
#include "certify/process/hdf5_frames.h"
#include "certify/shards/request_json.h"
#include "trajectory/blocks/folder_lock.h"
#include "trajectory/blocks/run_file.h"
#include "trajectory/formats/frame_sequence.h"

namespace noli {
namespace {

namespace fs = std::filesystem;

void require_files(const VerifyRequest& request) {
  if (request.trajectory)
    throw UsageError("--trajectory: is about all frames; expected none when they are verified in parts");
  const bool files =
      std::ranges::all_of(request.frames, [](const fs::path& file) { return fs::is_regular_file(file); });
  if (request.reading.given || !files) {
    throw UsageError("each part reads its frames by itself; expected regular files, found something else");
  }
}

class Frames : public ShardMotion {
 public:
  explicit Frames(const VerifyRequest& request)
      : frames_(open_all_frames(request.frames, request.reading)),
        motion_(request.constant_motion ? Motion::constant : Motion::linear) {}

  std::uint64_t step_count() override {
    const auto steps = FrameSequence(*frames_, motion_).step_count();
    if (!steps) throw UsageError("how many frames there are is known at the last one; expected files");
    return *steps;
  }

  bool is_source_of(const ShardReader& shard, const StepRange& /*range*/) override {
    for (const Json& file : shard.head().at("files")) look_at(file.at(0).get<std::uint64_t>());
    return !other_input(shard, frames_->facts());
  }

  Json source(const VerifyOutcome& outcome, const StepRange& /*range*/) override {
    Json files = Json::array();
    for (std::size_t i = 0; i < outcome.inputs.size(); ++i) {
      if (outcome.inputs[i].looked_at) files.push_back({i, hex(outcome.inputs[i].sha256)});
    }
    return {{"files", files}};
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
  explicit Windows(const VerifyRequest& request) : request_(request), run_(request.frames.at(0)) {}

  std::uint64_t step_count() override { return RunReader(run_).look().windows; }

  void wait_for(std::uint64_t count) override {
    constexpr auto pause = std::chrono::milliseconds(50);
    while (request_.follow) {
      const bool written = is_locked(run_);  // before the look, so that the last windows are seen
      if (step_count() >= count || !written) return;
      VerifyOutcome asked;
      if (asked.stop_for(request_))
        throw Stopped(asked.interrupted ? StopReason::interrupted : StopReason::out_of_time, "");
      if (request_.progress) request_.progress("wait", 0);
      std::this_thread::sleep_for(pause);
    }
  }

  bool is_source_of(const ShardReader& shard, const StepRange& range) override {
    const Json& known = shard.head().at("windows");
    const auto end = shard.head().at("end").get<std::uint64_t>();
    return end == range.end && known == hashes({range.first, range.first + known.size()});
  }

  Json source(const VerifyOutcome& outcome, const StepRange& range) override {
    return {{"windows", hashes({range.first, range.first + outcome.steps.size()})}};
  }

 private:
  Json hashes(const StepRange& range) {
    Json list = Json::array();
    RunReader reader(run_);
    reader.skip_to(range.first);
    for (std::uint64_t window = range.first; window < range.end; ++window) {
      reader.skip_to(window + 1);
      list.push_back(hex(reader.group_hash()));
    }
    return list;
  }

  const VerifyRequest& request_;
  fs::path run_;
};

}  // namespace

std::unique_ptr<ShardMotion> motion_of_shards(const VerifyRequest& request) {
  if (!request.run) {
    require_files(request);
    return std::make_unique<Frames>(request);
  }
  if (request.lines_in_no_file && are_proved(request)) {
    throw UsageError(
        "--reproduce: the run recorded frames alone, so no file has the world lines that a checker would read when the "
        "parts are joined; expected --no-check, and no least distance");
  }
  return std::make_unique<Windows>(request);
}

}  // namespace noli
