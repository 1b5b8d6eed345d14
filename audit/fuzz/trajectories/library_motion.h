// SPDX-License-Identifier: Apache-2.0
//
// Runs a library of continuous collision detection on each step of a motion of a mesh, as a whole pipeline: its search
// for candidates, or all pairs if it has none, then its query for each of them (audit/ccd/ccd_pipeline.h).
//
// Faults of a pair of features that meets first at t*
//   not_found        it is not among the candidates
//   false_negative   "no hit", but they meet
//   bad_time, no_time, late   a time outside [0, 1]; none (NaN) from a library that knows times; one after t*
// Faults of a step
//   crash, hang, memory   how the library's process ended
//   failure          the search, or a query, returned neither of its answers
//   bad_pair         a candidate is not two features without a common vertex
//   leak             memory grew each time all queries were asked again
// Further faults of a library that claims to be exact
//   false_positive   "hit", but they stay apart
//   early            a time that is not t* rounded down to double
// Of the first step with a fault, the first of these words that fits is reported.
//
// What this does not do: only contacts of a vertex and a face and of two edges in 3D are known. Motions in a plane are
// taken as motions in space.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "audit/ccd/ccd_pipeline.h"
#include "audit/ccd/library_answers.h"
#include "audit/fuzz/trajectories/whole_motion.h"

namespace noli::audit {

enum class MotionFault {
  crash,
  hang,
  memory,
  failure,
  not_found,
  false_negative,
  bad_time,
  no_time,
  late,
  bad_pair,
  leak,
  false_positive,
  early
};

constexpr std::size_t motion_fault_count = 13;

/// The name used in JSON: "not_found", ...
constexpr std::string_view name(MotionFault fault) {
  constexpr std::array<std::string_view, motion_fault_count> names = {
      "crash",   "hang", "memory",   "failure", "not_found",      "false_negative", "bad_time",
      "no_time", "late", "bad_pair", "leak",    "false_positive", "early"};
  return names[static_cast<std::size_t>(fault)];
}

/// What is told of a motion.
struct MotionFaultFound {
  MotionFault fault = MotionFault::crash;
  ContactKind kind = ContactKind::apart;  ///< of the contact, where the fault is about one
  std::size_t step = 0;                   ///< from 0
  bool through = false;                   ///< who trusts its times goes through a contact in this step
  std::string words;  ///< "late: step 1: vertex 3 and face 0-1-2: 1, exact first time 0.5 (crossing)"

  /// Whether it is the same fault with the same kind of contact and the same end of the step.
  bool is_like(const MotionFaultFound& other) const {
    return fault == other.fault && kind == other.kind && through == other.through;
  }
};

struct LibraryMotionAnswer {
  bool stopped = false;  ///< by the user or the time limit; then the rest does not count
  std::uint64_t contacts = 0, candidates = 0, false_positives = 0;
  std::optional<MotionFaultFound> found;
  std::string shape;  ///< what it went through, as a word
};

/// What is asked for beside the answers.
struct MotionQuestion {
  bool knows_times = false;  ///< as knows_times() says of the library
  bool leaks = false;        ///< look for them too, for host.repeat_seconds a step
};

/// `planted`: what is known of the motion. Throws InputError (a library that is not as it has to be), std::logic_error
/// (the truth contradicts what was planted, or the oracle what the library is told to be wrong about), and what
/// HostProcess throws.
LibraryMotionAnswer ask_motion(const LibraryUnderTest& library, const FrameMotion& motion, const PlantedTruth& planted,
                               const MotionQuestion& question);

}  // namespace noli::audit
