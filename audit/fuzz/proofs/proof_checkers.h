// SPDX-License-Identifier: Apache-2.0
//
// The checkers of proofs as `noli fuzz proofs` asks them: thousands of times a second.
//
// Notation
//   host      noli_check_host (audit/fuzz/check_host), the plain checker in a process that checks one proof after
//             another. When it crashes or hangs, that is its answer, and another is started
//   program   a checker that is started for each proof: noli_check_verified
#pragma once

#include <chrono>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "certify/process/run_program.h"

namespace noli::audit {

/// A proof, and the files of the trajectory that it is about.
struct ProofFiles {
  std::string proof;
  std::string extension;
  std::vector<std::string> files;
};

/// The fields by which a checker is asked for just what a proof claims (proofs/FORMAT.md, section 6): what mutants of a
/// proof are judged by is what they claim themselves. Nothing for what has no claim.
std::vector<std::string> own_claim(const std::string& proof);

struct ProofAnswer {
  int code = 0;         ///< 0 accepted, 1 refuted, 3 rejected
  std::string failure;  ///< how it failed to say any of these, in words; then the code does not count
  std::string words{};  ///< of the host: the first line of what it printed
};

/// A checker for one thread, with a temporary folder for its files.
class ProofChecker {
 public:
  ProofChecker() = default;
  virtual ~ProofChecker() = default;
  ProofChecker(const ProofChecker&) = delete;
  ProofChecker& operator=(const ProofChecker&) = delete;

  virtual ProofAnswer check(const ProofFiles& files) = 0;
};

/// The host. Throws std::runtime_error when it is not there.
std::unique_ptr<ProofChecker> hosted_checker(const std::filesystem::path& host, std::chrono::milliseconds limit);

std::unique_ptr<ProofChecker> program_checker(const std::filesystem::path& program, const ProgramLimits& limits);

/// Writes proof.noli and trajectory-0.ply, ... (or trajectory.blocks), and removes frames behind the last and those of
/// another form; the names in the order of a command line.
std::vector<std::string> write_proof_files(const ProofFiles& files, const std::filesystem::path& folder);

/// What was written so, and nothing else of a trajectory. Throws InputError.
ProofFiles read_proof_files(const std::filesystem::path& folder);

}  // namespace noli::audit
