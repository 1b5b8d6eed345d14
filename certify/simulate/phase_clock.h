// SPDX-License-Identifier: Apache-2.0
//
// Measures how long a run is in each phase: a thread samples its Activity about a thousand times a second, and adds the
// time since the last sample to the phase that it sees.
//
// Phases that last less than some milliseconds in all may be missed.
#pragma once

#include <condition_variable>
#include <mutex>
#include <thread>

#include <noli/run.h>
#include "certify/json.h"
#include "integrator/phase.h"

namespace noli {

class PhaseClock {
 public:
  /// Begins to sample. `activity` must outlive this.
  explicit PhaseClock(const integrator::Activity& activity);
  ~PhaseClock();
  PhaseClock(const PhaseClock&) = delete;
  PhaseClock& operator=(const PhaseClock&) = delete;

  /// The times up to now, which add up to the time since it began.
  PhaseSeconds seconds();

 private:
  using Time = std::chrono::steady_clock::time_point;
  void watch();
  void look();

  const integrator::Activity& activity_;
  std::mutex mutex_;
  std::condition_variable wake_;
  bool done_ = false;
  Time last_;
  PhaseSeconds seconds_{};
  std::thread thread_;
};

/// {"force": s, ..., "other": s}
Json phases_json(const PhaseSeconds& seconds);
/// "force 1.20 s (40 %), ...": the phases that took at least a thousandth of the time, the longest first.
std::string phases_text(const PhaseSeconds& seconds);

}  // namespace noli
