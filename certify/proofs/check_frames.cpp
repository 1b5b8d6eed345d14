// SPDX-License-Identifier: Apache-2.0
#include "certify/proofs/check_frames.h"

#include <algorithm>
#include <exception>
#include <memory>
#include <thread>
#include <utility>

#include "certify/process/scratch_folder.h"
#include "certify/proofs/trajectory_pipe.h"
#include "trajectory/blocks/frames_file.h"
#include "trajectory/formats/frame_sequence.h"
#include "trajectory/formats/frames.h"

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

std::optional<CheckerVerdict> on_a_pipe(CheckRequest request, FrameSource& frames) {
  TrajectoryPipe pipe(std::nullopt);
  request.trajectory = {pipe.path()};
  CheckerProcess checker(request);
  std::exception_ptr fault;
  std::thread giving([&] {
    try {
      write_all(frames, pipe.sink(), [&] {
        pipe.drained();
        return !pipe.is_over();
      });
      pipe.close();
    } catch (...) {
      fault = std::current_exception();
      pipe.abandon();
    }
  });
  std::optional<CheckerVerdict> verdict;
  try {
    verdict = checker.finish();
  } catch (...) {
    if (!fault) fault = std::current_exception();
  }
  pipe.abandon();  // the checker may have ended without reading all, or any of it
  giving.join();
  if (fault) std::rethrow_exception(fault);
  return verdict;
}

std::optional<CheckerVerdict> in_a_file(CheckRequest request, FrameSource& frames) {
  const ScratchFolder folder;
  request.trajectory = {folder.path() / "motion.frames"};
  write_all(frames, std::make_unique<FileSink>(request.trajectory[0], FileSink::Open::create), [] { return true; });
  return CheckerProcess(request).finish();
}

}  // namespace

bool checkers_read(const std::vector<std::filesystem::path>& frames) {
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

}  // namespace noli
