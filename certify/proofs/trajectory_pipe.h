// SPDX-License-Identifier: Apache-2.0
//
// A block file that is never a file, on its way to a checker: the world lines of a run that is reproduced, or frames
// from a source that no checker reads.
//
// What is written is kept in memory until the checker has read it, and drained() bounds that: whoever calls it before
// each window, or frame, has one of them in memory.
#pragma once

#include <chrono>
#include <condition_variable>
#include <deque>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <thread>

#include "certify/process/scratch_folder.h"
#include "trajectory/blocks/block_sink.h"
#include "trajectory/stop.h"

namespace noli {

class TrajectoryPipe {
 public:
  /// A named pipe in a folder of its own, which vanishes with this. Gives up after a stop. Throws std::system_error.
  explicit TrajectoryPipe(const StopOfWork& stop);
  ~TrajectoryPipe();
  TrajectoryPipe(const TrajectoryPipe&) = delete;
  TrajectoryPipe& operator=(const TrajectoryPipe&) = delete;

  /// The file that the checker opens.
  const std::filesystem::path& path() const { return path_; }
  /// For a RunWriter or FramesWriter, which this has to outlive.
  std::unique_ptr<Sink> sink();

  /// Waits until the checker has read all that was written, or until a stop. Throws std::runtime_error when it does not
  /// open the pipe within a minute. Returns at once if the checker has ended; writing the proof then reports that.
  void drained();
  /// The same, then ends the stream.
  void close();
  /// Nothing is written any more: whoever waits goes on.
  void abandon();
  /// Whether nothing is written any more.
  bool is_over() const;

 private:
  class End;

  void put(std::string_view bytes);
  void work();
  bool given_up() const;
  bool waited_too_long() const;
  std::optional<int> open() const;
  bool write(int end, std::string_view bytes) const;

  StopOfWork stop_;
  ScratchFolder folder_;
  std::filesystem::path path_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::string> waiting_;  ///< the first one is being written
  bool closing_ = false, abandoned_ = false;
  bool over_ = false;                                                   ///< nothing is written any more
  std::optional<std::chrono::steady_clock::time_point> awaited_since_;  ///< since when drained() waits
  bool unopened_ = false;                                               ///< the checker never opened the pipe
  std::thread thread_;
};

}  // namespace noli
