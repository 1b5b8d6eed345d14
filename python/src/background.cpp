// SPDX-License-Identifier: Apache-2.0
#include "python/src/background.h"

#include <pybind11/pybind11.h>

#include <cfenv>
#include <thread>

#include <noli/errors.h>

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

std::unique_lock<std::mutex> OneAtATime::enter() {
  const py::gil_scoped_release unlocked;
  return std::unique_lock(mutex_);
}

void in_background(const std::function<void(Background&)>& work) {
  std::atomic<bool> stop = false;
  in_background(stop, work);
}

void in_background(std::atomic<bool>& stop, const std::function<void(Background&)>& work) {
  stop = false;
  Background background(stop);
  std::exception_ptr thrown;
  {
    const py::gil_scoped_release unlocked;
    std::thread thread([&] {
      std::fesetenv(FE_DFL_ENV);
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
