// SPDX-License-Identifier: Apache-2.0
//
// Tests how long a writer waits for a checker that reads everything, or nothing.
#include "certify/proofs/trajectory_pipe.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <future>
#include <optional>
#include <string>

#include "certify/process/child.h"
#include "trajectory/stop.h"

namespace noli {
namespace {

using std::chrono::seconds;

/// Stands in for a checker: opens the pipe, and reads on request.
class Reader {
 public:
  explicit Reader(const TrajectoryPipe& pipe) {
    end_.take(::open(pipe.path().c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC));
  }
  bool is_open() const { return end_.get() >= 0; }
  /// Whether there was something.
  bool read() {
    std::string part(65536, '\0');
    return ::read(end_.get(), part.data(), part.size()) > 0;
  }

 private:
  Descriptor end_;
};

/// More than the buffer of a pipe holds.
const std::string much(4'000'000, 'x');

/// Checks that drained() waits, then calls `ask`. Returns whether drained() returns within ten seconds after that.
template <class Ask>
bool goes_on_after(TrajectoryPipe& pipe, const Ask& ask) {
  const Reader reader(pipe);
  EXPECT_TRUE(reader.is_open());
  pipe.sink()->write(much);
  auto waiting = std::async(std::launch::async, [&] { pipe.drained(); });
  EXPECT_EQ(waiting.wait_for(std::chrono::milliseconds(300)), std::future_status::timeout);
  ask();
  const bool went_on = waiting.wait_for(seconds(10)) == std::future_status::ready;
  pipe.abandon();  // lets drained() return in any case
  waiting.get();
  return went_on;
}

TEST(TrajectoryPipe, IsDrainedWhenAllIsRead) {
  TrajectoryPipe pipe(StopOfWork(nullptr, std::nullopt));
  Reader reader(pipe);
  ASSERT_TRUE(reader.is_open());
  pipe.sink()->write(much);
  auto waiting = std::async(std::launch::async, [&] { pipe.drained(); });
  while (waiting.wait_for(seconds(0)) != std::future_status::ready) reader.read();
  EXPECT_FALSE(pipe.is_over());
}

TEST(TrajectoryPipe, HearsAStop) {
  std::atomic<bool> stop = false;
  TrajectoryPipe pipe(StopOfWork(&stop, std::nullopt));
  EXPECT_TRUE(goes_on_after(pipe, [&] { stop = true; }));
}

TEST(TrajectoryPipe, HearsAStopOfTheThreadThatMadeIt) {
  std::atomic<bool> stop = false;
  const StopOfThread of_thread(stop);
  TrajectoryPipe pipe(StopOfWork(nullptr, std::nullopt));
  EXPECT_TRUE(goes_on_after(pipe, [&] { stop = true; }));
}

TEST(TrajectoryPipe, HearsADeadline) {
  TrajectoryPipe pipe(StopOfWork(nullptr, std::chrono::steady_clock::now() + seconds(2)));
  EXPECT_TRUE(goes_on_after(pipe, [] {}));
}

TEST(TrajectoryPipe, HearsAStopOfTheProcess) {
  TrajectoryPipe pipe(StopOfWork(nullptr, std::nullopt));
  EXPECT_TRUE(goes_on_after(pipe, [] { ask_to_stop(StopReason::interrupted); }));
  forget_stops();
}

}  // namespace
}  // namespace noli
