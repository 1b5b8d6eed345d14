// SPDX-License-Identifier: Apache-2.0
//
// Decides a sequence of frames of one mesh, step by step, in memory.
//
//   SequenceVerifier verifier(mesh, {});
//   verifier.add(x);                                 // the first frame: there is no step yet
//   while (solver.advance(x)) {
//     if (verifier.add(x)->touches()) break;         // decided exactly: something meets between two frames
//   }
//
// Notation
//   frame     positions of all vertices at one time; between two frames each vertex moves along a straight line
//   step k    from frame k to frame k + 1, k = 0, 1, ...; with `at_rest`, frame k alone, which stands still
//
// A pair of features that already meets at the beginning of a later step is not counted again.
//
// Units: positions in any unit of length; times in [0, 1] of the step.
// Errors: std::bad_alloc, what `progress` throws, and what baseline() throws. Thread safety: a verifier is for one
// thread at a time, and uses several threads itself; any number of verifiers may run at once.
// It writes no proof and reads no files (noli/verify.h does both).
#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <noli/contact.h>
#include <noli/findings.h>
#include <noli/mesh.h>
#include <noli/time_of_impact.h>

namespace noli {

struct ChainMemory;
struct StepPart;
struct StepProof;
struct VerifyOptions;
struct VerifyResult;
class Baseline;
class ProofReceiver;
class WindowVerifier;

struct SequenceOptions {
  int dimension = 3;  ///< 2 or 3; in 2 the third coordinate is ignored
  bool at_rest = false;
  int threads = 0;          ///< 0: all there are
  bool first_only = false;  ///< stop at any contact
  bool strict = false;      ///< also compare the vertex-disjoint features of one cell
  std::size_t max_reports = 100;
  const Exclusions* exclusions = nullptr;  ///< pairs of groups that are not compared; must outlive the verifier
  /// Pairs of cells that intersect in the first frame are not compared: see SequenceVerifier::baseline().
  bool only_new = false;
  /// Of all steps of the motion, the number of the first one that is given. With 0, initial intersections are looked
  /// for; otherwise pairs that meet in the first frame that is given were counted in the step before. With `only_new`,
  /// call baseline() first.
  std::uint64_t first_step = 0;
  const std::atomic<bool>* stop = nullptr;  ///< polled; when it becomes true the step is not complete
  std::optional<std::chrono::steady_clock::time_point> deadline = {};
  std::function<void(double)> progress = {};  ///< called with the share of the current step that is done, in [0, 1]
};

/// The first contact of a step, or of a window, exactly.
struct FirstInStep {
  FeatureContact contact;
  ContactKind kind = ContactKind::touching;
  double time = 0;  ///< the largest double not above the exact time; in [0, 1] of the step, in seconds of a run
};

/// What was found in one step; counts are lower bounds unless it is complete.
/// Initial intersections are those of the first frame, or of each one at rest.
struct StepResult : Findings {
  std::optional<FirstInStep> first;
  std::shared_ptr<const StepProof> proof;  ///< as in VerifyResult; nothing with exclusions or only_new
  bool receiver_has_proof = false;         ///< as in VerifyResult
  bool rests = false;                      ///< between two frames: they are equal
};

class SequenceVerifier {
 public:
  /// Precondition: every index of the mesh is below its vertex_count, and there are fewer than 2^31 cells.
  SequenceVerifier(Mesh mesh, SequenceOptions options);
  ~SequenceVerifier();
  SequenceVerifier(SequenceVerifier&&) noexcept;
  SequenceVerifier& operator=(SequenceVerifier&&) noexcept;

  const Mesh& mesh() const { return mesh_; }

  /// The next frame. Nothing for the first one, unless at rest. Precondition: vertex_count finite positions. Throws
  /// std::bad_alloc and, with `only_new`, std::length_error as baseline() does.
  std::optional<StepResult> add(std::span<const Position> x);

  /// The next step, for callers that have both frames: x_t0 is the x_t1 of the step before, or its x_t0 when that step
  /// touches and is tried again. add() then goes on from x_t1. Precondition and errors as for add(). `prove`: also fill
  /// `proof`.
  StepResult step(std::span<const Position> x_t0, std::span<const Position> x_t1, bool prove = false);

  /// For Noli itself: the next step, whose proof the receiver takes while it is found. Precondition: no `only_new` and
  /// no `exclusions`. Throws what the receiver throws.
  StepResult step_for(std::span<const Position> x_t0, std::span<const Position> x_t1, ProofReceiver& receiver);

  /// With `only_new`: the pairs of cells that intersect at the positions x of the first frame, in ascending order. All
  /// others are compared. add() and step() look for them in their first frame if it was not called before. If it is
  /// stopped they are not all there, and the first step is not complete. Throws std::logic_error without `only_new`,
  /// std::length_error for more than most_of_baseline pairs.
  static constexpr std::size_t most_of_baseline = 1'000'000;
  const std::vector<InitialIntersection>& baseline(std::span<const Position> x);

  /// For Noli itself: a part of the first step, in which nothing is known of steps before. Precondition: no
  /// `first_only`, `only_new` and `exclusions`, and no other positions than in the calls before.
  StepResult part_of_step(std::span<const Position> x_t0, std::span<const Position> x_t1, const StepPart& part,
                          bool prove);

  /// For Noli itself: the options of the prover for any step, without `after_step`, `chain` and `progress`.
  VerifyOptions step_options() const;

 private:
  StepResult decide(std::span<const Position> x_t0, std::span<const Position> x_t1, bool prove,
                    ProofReceiver* receiver);
  /// A step that touches and may be tried again: where it began, and what was known before it.
  struct Rejected {
    std::vector<Position> x_t0;
    std::uint64_t steps;
    bool meeting_at_end;
  };

  void take_back(std::span<const Position> x_t0);
  VerifyResult verify_between(std::span<const Position> x_t0, std::span<const Position> x_t1,
                              const VerifyOptions& options);
  StepResult result_of(VerifyResult found, std::span<const Position> x_t0, std::span<const Position> x_t1) const;

  Mesh mesh_;
  SequenceOptions options_;
  std::unique_ptr<const WindowVerifier> windows_;  ///< with exclusions
  std::unique_ptr<ChainMemory> chain_;             ///< without exclusions
  std::unique_ptr<const Baseline> baseline_;       ///< with only_new, once the first frame is known
  std::uint64_t steps_ = 0;
  bool meeting_at_end_ = false;  ///< some pair met in the previous step: only then can one meet as the next one begins
  std::optional<std::vector<Position>> last_;  ///< frame of add()
  std::optional<Rejected> rejected_;           ///< the last step, if it touches; not if it ended where it began
};

}  // namespace noli
