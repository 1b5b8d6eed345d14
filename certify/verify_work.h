// SPDX-License-Identifier: Apache-2.0
//
// A request of `noli verify` with what Noli's own parts add: steps that shards decide or have decided, and the
// pipe to a checker.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include <noli/verify.h>

namespace noli {

struct CommitPoint;
class DecidedSteps;
class StepParts;
struct StepResult;
class TrajectoryPipe;

/// Steps first, first + 1, ..., end - 1, from 0.
struct StepRange {
  std::uint64_t first = 0, end = 0;
};

struct VerifyWork : VerifyRequest {
  VerifyWork() = default;
  explicit VerifyWork(const VerifyRequest& request) : VerifyRequest(request) {}

  bool lines_in_no_file = false;                 ///< of a run that is reproduced: it recorded frames alone
  TrajectoryPipe* trajectory_pipe = nullptr;     ///< on which the checker reads the motion; nothing: nobody does
  std::optional<StepRange> only;                 ///< decide these steps alone
  std::vector<StepResult>* decisions = nullptr;  ///< gets what was found in each step, without its proof
  /// Of a run with `only`: gets the hash of the group of the first window of all, then of each that was decided.
  std::vector<std::array<std::uint8_t, 32>>* windows = nullptr;
  const CommitPoint* before =
      nullptr;          ///< of a run with `only`: where the window before those begins, if there are others before it
  bool divide = false;  ///< verify_shard() decides the only step in parts (--divide); the answer is the same
  StepParts* parts = nullptr;  ///< decide only these parts, and hand each over; the outcome then has no verdict
  std::shared_ptr<DecidedSteps> decided;  ///< has what would be found in each step

  /// Checks what goes with `reproduce`, and sets lines_in_no_file. Throws UsageError, InputError.
  void prepare_to_reproduce();
};

/// As run_verify(const VerifyRequest&), without prepare_to_reproduce(). Precondition: that was called, if `reproduce`.
VerifyOutcome run_verify(const VerifyWork& work);

}  // namespace noli
