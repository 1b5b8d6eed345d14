// SPDX-License-Identifier: Apache-2.0
//
// How long a run is in which phase: a thread looks at its Activity about a thousand times a second, and gives the time
// since it looked last to the phase that it sees.
//
// What this does not do: what lasts for less than some milliseconds in all is seen or not.
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
  /// Begins to look. `activity` must outlive this.
  explicit PhaseClock(const integrator::Activity& activity);
  ~PhaseClock();
  PhaseClock(const PhaseClock&) = delete;
  PhaseClock& operator=(const PhaseClock&) = delete;

  /// Up to now; they add up to the time since it began.
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
/// "force 1.20 s (40 %), ...": those that took a thousandth of all, the longest first.
std::string phases_text(const PhaseSeconds& seconds);

}  // namespace noli
