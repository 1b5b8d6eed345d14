// SPDX-License-Identifier: Apache-2.0
//
// What a run is busy with at the moment: one byte, written by who works, read by who wants to know where time goes.
//
// What is counted where
//   force        positions of a force's vertices and its impulse; in rows of 64 forces
//   kick         what impulses do to velocities, gravity's too, and the breakpoints that it leaves
//   layer        layers of contact: distances of the pairs for which they are active, impulses, friction
//   certificate  looks at vertices, slabs, activation
//   broad_phase  who is near whom: the hierarchy of boxes, the pairs that it finds
//   queue        what comes next: clocks, the agenda of layers, the queue of certificates; scripts
//   recording    breakpoints at a window's ends; sorting all of them by vertex
//   proof        verifying a window, or waiting for it to be verified elsewhere
//   writing      blocks, frames, the log, series.h5
//   other        all else: reading, building, energies
//
// What this does not do: it measures no time. Writing the byte costs about as much as any other store, so phases of a
// few nanoseconds are not told apart. Nothing that is computed depends on it.
#pragma once

#include <atomic>
#include <cstdint>
#include <string_view>

namespace noli::integrator {

enum class Phase : std::uint8_t {
  force,
  kick,
  layer,
  certificate,
  broad_phase,
  queue,
  recording,
  proof,
  writing,
  other
};
constexpr std::size_t phases = 10;

constexpr std::string_view name(Phase phase) {
  switch (phase) {
    case Phase::force: return "force";
    case Phase::kick: return "kick";
    case Phase::layer: return "layer";
    case Phase::certificate: return "certificate";
    case Phase::broad_phase: return "broad_phase";
    case Phase::queue: return "queue";
    case Phase::recording: return "recording";
    case Phase::proof: return "proof";
    case Phase::writing: return "writing";
    case Phase::other: return "other";
  }
  return "";
}

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
