// SPDX-License-Identifier: Apache-2.0
//
// Runs work in a thread of its own, while the interpreter's thread handles Ctrl-C and calls of Python.
//
//   in_background([&](Background& background) { outcome = run_verify(request); });
//
// That thread begins with the default floating-point environment, which the kernel expects (noli/contact.h). Libraries
// in the interpreter's process may have changed theirs: some flush subnormal numbers to 0.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>

namespace noli::python {

class Background {
 public:
  /// `stop`: where a request to end goes.
  explicit Background(std::atomic<bool>& stop) : stop_(stop) {}

  /// Becomes true when the interpreter has an exception, KeyboardInterrupt for example: the work has to end.
  const std::atomic<bool>* stop() const { return &stop_; }

  /// From any thread of the work: has the interpreter's thread do something, with its lock, and waits. Throws Stopped
  /// if it raised an exception, then or before.
  void call(const std::function<void()>& task);

  /// For progress: whether so much time has passed since it was last true that people want to see more.
  bool is_due();

 private:
  friend void in_background(std::atomic<bool>& stop, const std::function<void(Background&)>& work);

  void wait_for_calls();
  void answer(std::unique_lock<std::mutex>& lock);
  void hear_signals(std::unique_lock<std::mutex>& lock);
  void end();

  std::mutex mutex_;
  std::condition_variable changed_;
  const std::function<void()>* task_ = nullptr;
  bool answered_ = false, ended_ = false;
  std::atomic<bool>& stop_;
  std::exception_ptr raised_;  ///< by the interpreter
  std::chrono::steady_clock::time_point last_;
};

/// Lets one thread at a time use an object.
class OneAtATime {
 public:
  class Guard {
   public:
    explicit Guard(OneAtATime& of) : of_(of) {}
    ~Guard();
    Guard(const Guard&) = delete;
    Guard& operator=(const Guard&) = delete;

   private:
    OneAtATime& of_;
  };

  /// Waits without the interpreter's lock (GIL), and hears signals. Throws UsageError if this thread uses the object
  /// already: in a signal handler, for example. Precondition: this thread has the lock.
  Guard enter();
  bool is_mine() const { return owner_ == std::this_thread::get_id(); }

 private:
  std::timed_mutex mutex_;
  std::atomic<std::thread::id> owner_{};
};

/// Work that goes on: as long as one of these lives, the interpreter does not end.
class Working {
 public:
  /// `stop`: set when the interpreter ends. Throws Stopped if it is ending. Precondition of this and of the destructor:
  /// this thread has the interpreter's lock.
  explicit Working(std::atomic<bool>& stop);
  ~Working();
  Working(const Working&) = delete;
  Working& operator=(const Working&) = delete;

 private:
  std::atomic<bool>& stop_;
};

/// Stops all work, waits until it has ended, and refuses more: for the interpreter's end.
void end_all_work();

/// For the child of a fork: work of the parent's other threads goes on in the parent alone.
void forget_all_work();

/// Does the work, and returns when it has ended. Throws what a call or a signal raised, else what the work threw.
/// Precondition: this thread has the interpreter's lock.
void in_background(const std::function<void(Background&)>& work);

/// The same for work whose parts outlive a call, and with them the place where they look for a request to end.
void in_background(std::atomic<bool>& stop, const std::function<void(Background&)>& work);

}  // namespace noli::python
