// SPDX-License-Identifier: Apache-2.0
//
// How `noli` ends. Verdict and exit code always agree, and nothing abnormal ends in 0.
#pragma once

#include <noli/errors.h>

namespace noli::app {

enum class ExitCode {
  holds = 0,      ///< what was asked holds
  refuted = 1,    ///< it does not: a contact, a disagreement, a finding
  undecided = 2,  ///< a limit was reached, or the run was interrupted
  bad_input = 3,  ///< the input or the command line is at fault
  failure = 4     ///< an internal check failed, or the machine did
};

/// `refuted` comes first: what was found stays found, also where the work was not finished.
inline ExitCode exit_code_of(bool refuted, bool holds) {
  if (refuted) return ExitCode::refuted;
  return holds ? ExitCode::holds : ExitCode::undecided;
}

/// Waits for the other ranks and ends MPI. `own`: the exit code of this rank. Returns that of the first rank.
template <class Ranks>
ExitCode end_of(Ranks& ranks, ExitCode own) {
  return static_cast<ExitCode>(ranks.end(static_cast<int>(own)));
}

}  // namespace noli::app
