// SPDX-License-Identifier: Apache-2.0
//
// Facts about this process and the programs that come with it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace noli {

/// The largest resident size of this process so far, in bytes.
std::uint64_t peak_memory_bytes();

/// The executable of this process.
std::filesystem::path this_program_file();

/// Where beside_this_program() looks. For a library in the process of another program, such as an interpreter. Call it
/// before any work.
void keep_programs_in(std::filesystem::path folder);

/// The path of a program of this name in the folder of this one, or of keep_programs_in(). It need not exist.
std::filesystem::path beside_this_program(const std::string& name);

}  // namespace noli
