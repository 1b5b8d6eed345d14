// SPDX-License-Identifier: Apache-2.0
//
// How `noli` ends. Verdict and exit code always agree, and nothing abnormal ends in 0.
#pragma once

#include <stdexcept>
#include <string>

namespace noli::app {

enum class ExitCode {
  holds = 0,      ///< what was asked holds
  refuted = 1,    ///< it does not: a contact, a disagreement, a finding
  undecided = 2,  ///< a limit was reached, or the run was interrupted
  bad_input = 3,  ///< the input or the command line is at fault
  failure = 4     ///< an internal check failed, or the machine did
};

/// The command line asks for something that cannot be. Ends in ExitCode::bad_input; what() is one line.
struct UsageError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Results could not be written. Ends in ExitCode::failure; what() is one line.
struct WriteError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A process that helps could not do its work, because of memory or files. Ends in ExitCode::failure; what() is one
/// line.
struct HelperError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace noli::app
