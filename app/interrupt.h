// SPDX-License-Identifier: Apache-2.0
//
// Ctrl-C and SIGTERM ask the work to stop; what was settled so far is then reported as usual, with exit code 2.
#pragma once

#include <atomic>

namespace noli::app {

/// Becomes true when the user asks to stop. Never becomes false again.
const std::atomic<bool>& interrupted();

/// How often the user has asked: what comes after the work may need to be asked again.
int interruptions();

/// SIGINT and SIGTERM set the flag from now on, and end a reader's wait for a pipe with ReadInterrupted, also one that
/// begins later (within a second); a closed pipe is an error of writing instead of a signal.
void install_signal_handlers();

}  // namespace noli::app
