// SPDX-License-Identifier: Apache-2.0
//
// What a run is busy with at the moment: one byte, written by who works, read by who wants to know where time goes.
//
// What this does not do: it measures no time. Writing the byte costs about as much as any other store, so phases of a
// few nanoseconds are not told apart. Nothing that is computed depends on it.
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

/// A phase that lasts as long as this does; then the one before goes on.
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
