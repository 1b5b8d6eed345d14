// SPDX-License-Identifier: Apache-2.0
//
// What happens to the process from outside: Ctrl-C, SIGTERM and --time-limit ask the work to stop, and what was settled
// so far is then reported as usual, with exit code 2; memory ends; descriptors are closed.
#pragma once

#include <atomic>
#include <chrono>

namespace noli::app {

/// Becomes true when the user asks to stop. Never becomes false again.
const std::atomic<bool>& interrupted();

/// How often the user has asked: what comes after the work may need to be asked again.
int interruptions();

/// SIGINT and SIGTERM ask to stop from now on, and end system calls that wait, also those that begin later (within a
/// second); a closed pipe is an error of writing instead of a signal.
void install_signal_handlers();

/// From now on whoever asks for stops (trajectory/stop.h) hears those of the user: readers, generators and the like
/// throw Stopped. For commands that report nothing, or know how to report less, when that happens. Others look at
/// interrupted() between two pieces of work, and lose none.
void hear_stops_everywhere();

/// Asks to stop (trajectory/stop.h) once this much time has passed from now. Precondition: install_signal_handlers()
/// was called. A second call replaces the first. Throws std::system_error.
void stop_after(std::chrono::nanoseconds limit);

/// Gives large pieces of memory back to the system as soon as they are free. By itself glibc soon keeps them, and a
/// thousand frames then take three times the memory of two.
void return_large_memory();

/// Makes a failed allocation inside GMP, which cannot throw, and std::terminate end in one line and ExitCode::failure;
/// and makes sure that descriptors 0 to 2 exist, so that no file that is opened later takes the place of a closed
/// standard output.
void prepare_for_the_worst();

}  // namespace noli::app
