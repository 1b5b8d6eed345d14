// SPDX-License-Identifier: Apache-2.0
//
// What `noli fuzz trajectories` tests: `noli verify` on files, and both checkers on the proof that it writes, each as a
// program of its own, so that a crash or a hang is an answer too.
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>

#include "audit/fuzz_trajectories.h"
#include "audit/scratch_folder.h"

namespace noli::app {

class VerifyProgram {
 public:
  /// The verified checker, where there is one, is asked about one motion of `verified_every`. Throws std::runtime_error
  /// when noli or noli_check are not there.
  explicit VerifyProgram(std::uint64_t verified_every);

  bool has_verified_checker() const { return has_verified_; }
  audit::MotionAnswer operator()(const audit::FrameMotion& motion);

 private:
  audit::CheckerWord check(const std::filesystem::path& program, const std::vector<std::string>& files,
                           audit::MotionAnswer& answer) const;

  std::filesystem::path noli_, plain_, verified_;
  bool has_verified_;
  std::uint64_t verified_every_;
  audit::ScratchFolder folder_{audit::ScratchFolder::Place::memory};
  std::atomic<std::uint64_t> number_ = 0;
};

}  // namespace noli::app
