// SPDX-License-Identifier: Apache-2.0
//
// What `noli fuzz trajectories` tests: `noli verify` on files, and both checkers on the proof that it writes, each as a
// program of its own, so that a crash or a hang is an answer too.
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>

#include "audit/fuzz/trajectories/fuzz_trajectories.h"
#include "certify/process/run_program.h"

namespace noli::audit {

class VerifyProgram {
 public:
  /// The verified checker, where there is one, is asked about one motion of `verified_every`. When `stop` becomes true
  /// the programs are ended. Throws std::system_error when noli_check cannot be started.
  VerifyProgram(std::uint64_t verified_every, const std::atomic<bool>& stop);

  MotionAnswer operator()(const FrameMotion& motion);

 private:
  CheckerWord check(const std::filesystem::path& program, const std::vector<std::string>& files,
                    MotionAnswer& answer) const;

  ProgramLimits limits_;
  std::filesystem::path noli_, plain_, verified_;
  bool has_verified_;
  std::uint64_t verified_every_;
  std::atomic<std::uint64_t> number_ = 0;
};

}  // namespace noli::audit
