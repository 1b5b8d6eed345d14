// SPDX-License-Identifier: Apache-2.0
//
// Fuzzing of somebody else's library as a whole pipeline: the motions of audit/fuzz/trajectories/motion_generators.h,
// step by step, each in a process of its own (audit/fuzz/trajectories/library_motion.h). The truth is every contact of
// a step, from the verifier, with its exact first time from the kernel; it has to agree with what was planted, and the
// oracle with what is told of a finding.
//
// Notation
//   block    16 motions, each of another generator; a block depends on the seed and its number alone
//   finding  a motion on which the library has a fault
// Of the findings the first of each fault, kind of contact and generator, through or not, is shrunk against the library
// and saved, at most `max_findings` of them; all are counted. What is shrunk keeps all of these.
//
// What this does not do: look for leaks in more than the first block, as that means to ask again and again; nor in
// motions of the corpus.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "audit/fuzz/fuzzing.h"
#include "audit/fuzz/trajectories/library_motion.h"

namespace noli::audit {

struct LibraryMotionOptions : FuzzSettings {
  LibraryUnderTest asked;
  std::vector<std::string> families;        ///< names of generators; none: all of them
  bool first_only = false;                  ///< stop behind the first block that has a finding
  std::size_t shrink_budget = 1000;         ///< motions that the library is asked for each finding
  std::vector<std::string> replay_command;  ///< the command that replays a saved finding, without its folder
};

using MotionFaultCounts = std::array<std::uint64_t, motion_fault_count>;

struct LibraryMotionFinding {
  MotionFaultFound found;        ///< of the shrunk motion
  std::string generator;         ///< or "corpus/NAME"
  std::uint64_t block = 0;       ///< of the seed
  std::size_t index = 0;         ///< within the block
  FrameMotion motion, shrunk;    ///< as made; simpler, with the same fault
  std::uint64_t alike = 0;       ///< how many findings were like it, with this generator
  std::filesystem::path folder;  ///< where `shrunk` was saved; empty when it was not
};

/// What a generator's motions came to.
struct LibraryMotionTally {
  std::string name;
  std::uint64_t motions = 0, contacts = 0;  ///< pairs of features that meet in a step that was asked
  MotionFaultCounts faults{};
};

/// Items are motions that were asked, those of the corpus left out.
struct LibraryMotionReport : FuzzTotals {
  std::uint64_t not_asked = 0;  ///< after too many hangs in their block
  std::uint64_t contacts = 0, candidates = 0, false_positives = 0;
  std::uint64_t through = 0;   ///< findings in whose step who trusts the library goes through a contact
  MotionFaultCounts faults{};  ///< of all findings, those of the corpus included
  std::vector<LibraryMotionFinding> findings;
  std::vector<LibraryMotionTally> generators;
  bool knows_times = false;
};

/// With a count, without a corpus and without hangs the report is the same for any number of threads. What cannot be
/// saved is in `not_saved`. Throws what ask_motion throws, and InputError for a corpus that cannot be read.
LibraryMotionReport fuzz_library_motions(const LibraryMotionOptions& options);

/// A simpler motion with the same fault, and the fault of it. Precondition: it has that fault.
struct ShrunkMotion {
  FrameMotion motion;
  MotionFaultFound found;
};
ShrunkMotion shrink_for_library(const LibraryUnderTest& library, const FrameMotion& motion,
                                const MotionFaultFound& found, bool knows_times, std::size_t budget);

}  // namespace noli::audit
