// SPDX-License-Identifier: Apache-2.0
//
// The way of a proof: to a file, or to the checker at once, and of the motion to the checker where it is in no file
// that checkers read.
//
//   ProofRoute route(request);                        // sets how the request's proof is written
//   VerifyOutcome outcome = run_verify(request);
//   route.check(outcome);                             // "no contact" becomes "proved"
//
// Where frames in files go to the checker alone, it reads the proof of the first step while that is found. If the step
// has no proof after all, another checker is started.
//
// With a least distance the proof always goes through a file: the proof of a step that turns out to be too near has to
// be taken back. So does that of a run that is being written: how many windows it has is known at the end. And that of
// steps which shards decided, so that several checkers share it out. A file with a proof of those has its name once the
// proof is complete: a job that was stopped or killed before can be run again by the same command.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "certify/process/scratch_folder.h"
#include "certify/proofs/checker.h"
#include "certify/proofs/trajectory_pipe.h"
#include "certify/verify_work.h"
#include "trajectory/replaced_file.h"

namespace noli {

class ProofRoute {
 public:
  /// `request` has to outlive this. Throws std::system_error.
  explicit ProofRoute(VerifyWork& request);

  /// Has the checker say what it thinks of a proof that is complete. What it refuses is an error of this program:
  /// throws std::runtime_error; or of the shards that were joined: throws InputError.
  void check(VerifyOutcome& outcome);

 private:
  void check_proof_of(VerifyOutcome& outcome);
  [[noreturn]] void refuse(const std::string& problem) const;
  void require_claim(const Claim& asked, const std::string& words, bool refuted) const;
  bool frames_are_streamed() const;
  bool can_be_read_again() const;
  std::vector<std::filesystem::path> trajectory() const;
  std::unique_ptr<Sink> to_file() const;
  std::unique_ptr<Sink> to_checker(const Claim& claim);
  std::optional<CheckerVerdict> verdict_on(const Claim& claim);
  std::optional<std::string> why_not(const VerifyOutcome& outcome) const;
  void stopped(VerifyOutcome& outcome) const;

  VerifyWork& request_;
  bool can_check_ = false;
  std::optional<ScratchFolder> folder_;
  std::optional<ReplacedFile> unfinished_;
  std::optional<std::filesystem::path> file_;
  std::optional<TrajectoryPipe> pipe_;  ///< of a motion that is in no file which checkers read
  std::optional<CheckerProcess> checker_;
};

}  // namespace noli
