// SPDX-License-Identifier: Apache-2.0
//
// What the machine can do to a run, and what a run does to the machine.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <string>

namespace noli::app {

/// The largest resident size of this process so far, in bytes.
std::uint64_t peak_memory_bytes();

/// Makes a failed allocation inside GMP, which cannot throw, and std::terminate end in one line and ExitCode::failure;
/// and makes sure that descriptors 0 to 2 exist, so that no file that is opened later takes the place of a closed
/// standard output.
void prepare_for_the_worst();

/// The file of this very program, whatever its name is.
std::filesystem::path this_program_file();

/// Where a program of this name lies if it lies beside this one. It need not be there.
std::filesystem::path beside_this_program(const std::string& name);

/// Seconds since it was made.
class Stopwatch {
 public:
  double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace noli::app
