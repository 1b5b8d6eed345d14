// SPDX-License-Identifier: Apache-2.0
//
// The checkers of proofs, which are programs of their own (proofs/checker, proofs/coq), run as separate processes.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace noli::app {

enum class Checker { plain, verified };

/// What a checker said, and how it ended: 0 accepted, 1 refuted, 3 rejected.
struct CheckerVerdict {
  int code = 3;
  std::string words;  ///< its standard output, lines
};

/// Runs a checker on a proof and what it is about. Throws std::runtime_error when the checker is not there, was ended
/// by a signal, or ended with another code than it may.
CheckerVerdict run_checker(Checker checker, const std::filesystem::path& proof,
                           const std::vector<std::filesystem::path>& trajectory);

/// The file of a run that checkers read.
std::vector<std::filesystem::path> trajectory_for_checker(const std::vector<std::filesystem::path>& trajectory);

}  // namespace noli::app
