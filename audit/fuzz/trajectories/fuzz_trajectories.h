// SPDX-License-Identifier: Apache-2.0
//
// Fuzzing of everything between a file of frames and a checked proof: motions of meshes whose answer is known
// (audit/fuzz/trajectories/motion_generators.h), written, read, verified, proved, and the proof checked by both
// checkers.
//
// Notation
//   subject  the code under test, from files to the checkers' words
//   planted  what a generator says of its motion; the oracle (audit/fuzz/trajectories/motion_oracle.h) has to agree
//   finding  a motion that cannot be read back to the same bits, or on which the subject is wrong: contact or none, its
//            step, the exact first time rounded down, features that do not meet then, the kind; no proof or no
//            witness; a checker that rejects or says otherwise; a crash, a hang. Not one that its time was
//            up, if it says so
//   shape    what the subject went through, as a word: which stages, how large a proof. What has a new one is kept in
//            the corpus
//
// What this does not do: it does not count all contacts of a step, only when and where the first one is (tests/prover
// counts); it knows no least distance and no excluded pairs.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "audit/fuzz/fuzzing.h"
#include "audit/fuzz/trajectories/frame_motion.h"
#include "audit/fuzz/trajectories/motion_oracle.h"
#include "audit/fuzz/trajectories/whole_motion.h"

namespace noli::audit {

/// What a checker said.
enum class CheckerWord { accepted, refuted, rejected, not_asked };

/// What the subject says of a motion.
struct MotionAnswer {
  struct First {
    FeatureTwo features;
    std::string kind;      ///< as name(ContactKind)
    std::size_t step = 0;  ///< from 0
    double time = 0;       ///< the first time rounded down to double
  };

  std::string failure;     ///< how it failed to answer, in words ("stopped": by the user); then the rest does not count
  bool undecided = false;  ///< it says that its time was up, which is no fault; then the rest does not count
  bool contact = false;    ///< else it says that nothing touches
  std::size_t step = 0;    ///< the last step that it looked at, from 0
  bool initial = false;    ///< cells meet at the first time
  std::optional<First> first;
  bool has_proof = false;  ///< a proof, or a witness of a contact
  CheckerWord plain = CheckerWord::not_asked, verified = CheckerWord::not_asked;
  std::string shape;
};

/// The subject. Called from several threads at once.
using DecideMotion = std::function<MotionAnswer(const FrameMotion&)>;

struct TrajectoryOptions : FuzzSettings {
  DecideMotion decide;
  std::vector<std::string> families;        ///< names of generators; none: all of them
  std::size_t shrink_budget = 1000;         ///< calls of the subject for each finding
  std::vector<std::string> replay_command;  ///< the command that replays a saved finding, without its folder
};

struct TrajectoryFinding : FuzzFinding {
  FrameMotion motion;  ///< as made
  FrameMotion shrunk;  ///< simpler, and still a finding
};

struct TrajectoryTally {
  std::string name;
  std::uint64_t apart = 0, contact = 0;  ///< by the oracle
  std::uint64_t without_witness = 0;     ///< contacts, each of which is a finding
  std::uint64_t undecided = 0;           ///< in the time that there was
};

struct TrajectoryReport : FuzzTotals {
  std::vector<TrajectoryFinding> findings;  ///< the first max_findings
  std::vector<TrajectoryTally> generators;
  std::uint64_t checked_plain = 0, checked_verified = 0;
  std::uint64_t shapes = 0;  ///< different ones
};

/// Runs until a limit. Throws std::invalid_argument for a family that is not there.
/// With a count and without a corpus the report is the same for any number of threads. What
/// cannot be saved is in `not_saved`. Throws InputError for a corpus that cannot be read, std::system_error when
/// the machine fails.
TrajectoryReport fuzz_trajectories(const TrajectoryOptions& options);

/// What is wrong with the subject's answer, or the files of the motion, in words; nothing if all is well, or if it was
/// stopped, or its time was up, before that was known.
std::optional<std::string> difference(const FrameMotion& motion, const DecideMotion& decide,
                                      const std::atomic<bool>* stop = nullptr);

/// What is wrong with an answer.
std::optional<std::string> difference(const FrameMotion& motion, const MotionTruth& truth, const MotionAnswer& answer);

/// Where the oracle contradicts what was planted.
std::optional<std::string> broken_promise(const FrameMotion& motion, const PlantedTruth& planted,
                                          const MotionTruth& truth);

/// A motion for which `fails` holds and that none of these steps makes simpler: a frame less, a cell less, a vertex
/// that rests, a coordinate with fewer bits. Stops early after so many calls. Precondition: fails(motion).
FrameMotion minimise(const FrameMotion& motion, const std::function<bool(const FrameMotion&)>& fails,
                     std::size_t budget);

}  // namespace noli::audit
