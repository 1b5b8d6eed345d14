// SPDX-License-Identifier: Apache-2.0
#include "python/src/background.h"

#include <pybind11/pybind11.h>

#include <cfenv>
#include <set>
#include <thread>

#include <noli/errors.h>
#include "trajectory/stop.h"

namespace noli::python {
namespace {

namespace py = pybind11;

constexpr auto between_signals = std::chrono::milliseconds(50);
constexpr auto between_progress = std::chrono::milliseconds(100);

}  // namespace

void Background::call(const std::function<void()>& task) {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return task_ == nullptr || stop_; });  // another thread's call
  if (stop_) throw Stopped(StopReason::interrupted, "");
  task_ = &task;
  answered_ = false;
  changed_.notify_all();
  changed_.wait(lock, [this] { return answered_; });
  task_ = nullptr;
  changed_.notify_all();
  if (stop_) throw Stopped(StopReason::interrupted, "");
}

bool Background::is_due() {
  const std::lock_guard lock(mutex_);
  const auto now = std::chrono::steady_clock::now();
  if (now - last_ < between_progress) return false;
  last_ = now;
  return true;
}

void Background::wait_for_calls() {
  std::unique_lock lock(mutex_);
  while (!ended_) {
    const bool woken = changed_.wait_for(lock, between_signals, [this] { return ended_ || (task_ && !answered_); });
    if (ended_) return;
    if (woken) {
      answer(lock);
    } else {
      hear_signals(lock);
    }
  }
}

void Background::answer(std::unique_lock<std::mutex>& lock) {
  if (!stop_) {
    const auto& task = *task_;
    lock.unlock();
    std::exception_ptr raised;
    {
      const py::gil_scoped_acquire locked;
      try {
        task();
      } catch (...) {
        raised = std::current_exception();
      }
    }
    lock.lock();
    if (raised) raised_ = raised;
    if (raised) stop_ = true;
  }
  answered_ = true;
  changed_.notify_all();
}

void Background::hear_signals(std::unique_lock<std::mutex>& lock) {
  if (stop_) return;
  lock.unlock();
  std::exception_ptr raised;
  {
    const py::gil_scoped_acquire locked;
    if (PyErr_CheckSignals() != 0) raised = std::make_exception_ptr(py::error_already_set());
  }
  lock.lock();
  if (!raised) return;
  raised_ = raised;
  stop_ = true;
  changed_.notify_all();
}

void Background::end() {
  const std::lock_guard lock(mutex_);
  ended_ = true;
  changed_.notify_all();
}

OneAtATime::Guard OneAtATime::enter() {
  if (is_mine()) throw UsageError("this thread uses the object already; expected another one");
  bool mine = false;
  while (!mine) {
    {
      const py::gil_scoped_release unlocked;
      mine = mutex_.try_lock_for(between_signals);
    }
    if (mine) continue;
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  }
  owner_ = std::this_thread::get_id();
  return Guard(*this);
}

OneAtATime::Guard::~Guard() {
  of_.owner_ = std::thread::id();
  of_.mutex_.unlock();
}

namespace {

/// All work of the process.
struct AllWork {
  std::mutex mutex;
  std::condition_variable changed;
  std::multiset<std::atomic<bool>*> stops;
  bool ending = false;
};

/// Never deleted: threads may outlive what is static.
AllWork*& current_work() {
  static AllWork* work = new AllWork;
  return work;
}

AllWork& all_work() { return *current_work(); }

}  // namespace

Working::Working(std::atomic<bool>& stop) : stop_(stop) {
  AllWork& all = all_work();
  const std::lock_guard lock(all.mutex);
  if (all.ending) throw Stopped(StopReason::interrupted, "the interpreter ends");
  all.stops.insert(&stop);
}

Working::~Working() {
  AllWork& all = all_work();
  const std::lock_guard lock(all.mutex);
  const auto mine = all.stops.find(&stop_);
  if (mine != all.stops.end()) all.stops.erase(mine);  // not there in the child of a fork
  all.changed.notify_all();
}

void end_all_work() {
  const py::gil_scoped_release unlocked;
  AllWork& all = all_work();
  std::unique_lock lock(all.mutex);
  all.ending = true;
  for (std::atomic<bool>* const stop : all.stops) *stop = true;
  all.changed.wait(lock, [&] { return all.stops.empty(); });
}

void forget_all_work() { current_work() = new AllWork; }

void in_background(const std::function<void(Background&)>& work) {
  std::atomic<bool> stop = false;
  in_background(stop, work);
}

void in_background(std::atomic<bool>& stop, const std::function<void(Background&)>& work) {
  stop = false;
  const Working working(stop);
  Background background(stop);
  std::exception_ptr thrown;
  {
    const py::gil_scoped_release unlocked;
    std::thread thread([&] {
      std::fesetenv(FE_DFL_ENV);
      const StopOfThread stop_of_thread(stop);
      try {
        work(background);
      } catch (...) {
        thrown = std::current_exception();
      }
      background.end();
    });
    background.wait_for_calls();
    thread.join();
  }
  if (background.raised_) std::rethrow_exception(background.raised_);
  if (thrown) std::rethrow_exception(thrown);
}

}  // namespace noli::python
