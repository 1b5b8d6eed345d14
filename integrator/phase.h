// SPDX-License-Identifier: Apache-2.0
//
// The current phase of a run: one byte, written by the working thread, read by a thread that measures where time goes.
//
// Writing the byte costs about as much as any other store, so phases of a few nanoseconds are not distinguished. No
// result depends on it.
#pragma once

#include <atomic>

#include <noli/run.h>

namespace noli::integrator {

using noli::Phase;

/// Written by one thread, read by any.
class Activity {
 public:
  Phase now() const { return now_.load(std::memory_order_relaxed); }
  void set(Phase phase) { now_.store(phase, std::memory_order_relaxed); }

 private:
  std::atomic<Phase> now_{Phase::other};
};

/// Sets a phase as long as this object lives; the destructor restores the previous one.
class PhaseScope {
 public:
  PhaseScope(Activity& activity, Phase phase) : activity_(activity), before_(activity.now()) { activity.set(phase); }
  ~PhaseScope() { activity_.set(before_); }
  PhaseScope(const PhaseScope&) = delete;
  PhaseScope& operator=(const PhaseScope&) = delete;

 private:
  Activity& activity_;
  Phase before_;
};

}  // namespace noli::integrator
