// SPDX-License-Identifier: Apache-2.0
#include "certify/proofs/check_frames.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <memory>
#include <optional>
#include <thread>
#include <utility>

#include "certify/process/hdf5_frames.h"
#include "certify/process/scratch_folder.h"
#include "certify/proofs/trajectory_pipe.h"
#include "trajectory/blocks/frames_file.h"
#include "trajectory/formats/frame_sequence.h"
#include "trajectory/formats/frames.h"
#include "trajectory/formats/open_frames.h"
#include "trajectory/stop.h"

namespace noli {
namespace {

/// Calls `before` before each frame is written; ends when that says false.
template <class Before>
void write_all(FrameSource& frames, std::unique_ptr<Sink> sink, const Before& before) {
  std::optional<FramesWriter> writer;
  FrameSequence sequence(frames, Motion::constant);
  while (sequence.next()) {
    if (!writer) writer.emplace(std::move(sink), sequence.mesh());
    if (!before()) return;
    writer->append(sequence.x_t0());
  }
}

/// Gives frames to a checker that reads a pipe, in a thread of its own.
class Giving {
 public:
  /// `stop`: ends the reading of frames; may be nullptr.
  Giving(FrameSource& frames, TrajectoryPipe& pipe, const std::atomic<bool>* stop)
      : pipe_(pipe), stop_(stop), thread_([this, &frames] { give(frames); }) {}
  ~Giving() { join(); }
  Giving(const Giving&) = delete;
  Giving& operator=(const Giving&) = delete;

  /// Becomes true if the checker has not opened its pipe in time. It must be ended then, or it would wait forever.
  const std::atomic<bool>* failed() const { return &failed_; }
  /// The checker may have ended without reading all frames, or any. What went wrong with them, if anything did.
  std::exception_ptr join() {
    pipe_.abandon();
    if (thread_.joinable()) thread_.join();
    return fault_;
  }

 private:
  /// If a frame cannot be read, the motion ends before it: that may be all that is asked of the proof.
  void give(FrameSource& frames) {
    const StopOfThread stop_of_thread(stop_);
    try {
      write_all(frames, pipe_.sink(), [this] {
        pipe_.drained();
        return !pipe_.is_over();
      });
    } catch (...) {
      fault_ = std::current_exception();
    }
    try {
      pipe_.close();
    } catch (...) {
      if (!fault_) fault_ = std::current_exception();
      failed_ = true;
    }
  }

  TrajectoryPipe& pipe_;
  const std::atomic<bool>* stop_;
  std::exception_ptr fault_;  ///< written by the thread, read when it has ended
  std::atomic<bool> failed_ = false;
  std::thread thread_;
};

std::optional<CheckerVerdict> on_a_pipe(CheckRequest request, FrameSource& frames) {
  TrajectoryPipe pipe(StopOfWork(request.stop, request.deadline));
  request.trajectory = {pipe.path()};
  Giving giving(frames, pipe, request.stop);
  const StopOfThread ends_the_checker(giving.failed());
  CheckerProcess checker(request);
  const std::optional<CheckerVerdict> verdict = checker.finish();
  const std::exception_ptr fault = giving.join();
  // A witness refutes whatever follows. What was accepted is about all steps, and the checker saw only some, unless the
  // request names the last of them.
  const bool named = std::ranges::any_of(
      request.asked, [](const std::string& word) { return word.starts_with("steps=") && !word.ends_with(".."); });
  const bool settled = verdict && (verdict->code == 1 || (verdict->code == 0 && named));
  if (fault && !settled) std::rethrow_exception(fault);
  return verdict;
}

std::optional<CheckerVerdict> in_a_file(CheckRequest request, FrameSource& frames) {
  const ScratchFolder folder;
  request.trajectory = {folder.path() / "motion.frames"};
  write_all(frames, std::make_unique<FileSink>(request.trajectory[0], FileSink::Open::create), [] { return true; });
  return CheckerProcess(request).finish();
}

}  // namespace

bool checkers_read(const std::vector<std::filesystem::path>& frames, const FrameReading& reading) {
  if (reading.given || !reading.bodies.empty()) return false;
  if (frames.size() == 1 && begins_as_blocks(frames[0])) return true;
  return std::ranges::all_of(frames, [](const std::filesystem::path& path) {
    const std::string extension = extension_of(path);
    return extension == ".ply" || extension == ".obj";
  });
}

std::optional<CheckerVerdict> check_frames(CheckRequest request, FrameSource& frames) {
  return request.checker == Checker::plain ? on_a_pipe(std::move(request), frames)
                                           : in_a_file(std::move(request), frames);
}

bool left_to_checkers(const std::vector<std::filesystem::path>& files, const FrameReading& reading) {
  if (checkers_read(files, reading)) return true;
  const bool in_files = !reading.given && reading.bodies.empty();
  return in_files && files.size() == 1 && files[0] != "-" && !holds_frames(files[0]);
}

CheckerVerdict check_motion(const CheckRequest& request, const FrameReading& reading) {
  if (left_to_checkers(request.trajectory, reading)) return check_proof(request);
  return verdict_or_stopped(check_frames(request, *open_all_frames(request.trajectory, reading)), request);
}

}  // namespace noli
