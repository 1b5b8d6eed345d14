// SPDX-License-Identifier: Apache-2.0
//
// The process that this code is part of, and the programs that come with it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace noli {

/// The largest resident size of this process so far, in bytes.
std::uint64_t peak_memory_bytes();

/// The file of this very program, whatever its name is.
std::filesystem::path this_program_file();

/// Where a program of this name lies if it lies beside this one. It need not be there.
std::filesystem::path beside_this_program(const std::string& name);

}  // namespace noli
