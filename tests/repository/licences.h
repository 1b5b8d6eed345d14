// SPDX-License-Identifier: Apache-2.0
//
// Checks the licences of all headers in shipped code. Code under Apache-2.0 may use permissive and LGPL code, but not
// GPL code. The compiler lists every header that it reads, and each header is judged by the licence it states.
//
// A header that states no licence passes, except CGAL's, whose headers all state one. This is no legal advice.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace noli::repository {

/// Why a header with this path and text must not be in shipped code; empty if it may.
std::string objection(const std::filesystem::path& path, std::string_view text);

/// How the build compiles one source.
struct CompileCommand {
  std::filesystem::path file;    ///< absolute
  std::string flags;             ///< compiler and flags, without the input, -c and -o; begins a shell command
  std::filesystem::path folder;  ///< the working folder
};

/// The build's compile_commands.json, with a command for each source of a batch (cmake/NoliBatches.cmake). Throws
/// std::runtime_error if the file is missing.
std::vector<CompileCommand> compile_commands(const std::filesystem::path& build);

/// The absolute paths, links resolved, of all files that the compiler reads for `input` with the flags of `command`.
/// Throws std::runtime_error with the compiler's messages if it fails.
std::vector<std::filesystem::path> files_read(const CompileCommand& command, const std::filesystem::path& input);

/// One line for each file with an objection.
std::vector<std::string> licence_violations(const std::vector<std::filesystem::path>& files);

/// The libraries that `readelf -d` lists as needed, without those in THIRD_PARTY.md, the system's and sanitizers'. Only
/// noli_series may use HDF5, because its package brings network libraries.
std::vector<std::string> unexpected_libraries(std::string_view readelf_output);

/// The libraries listed by `ldd` that do not belong in a program that decides geometry: HDF5, and the libraries for
/// networks, certificates and directories that its package brings. libcrypto is not listed: libzip needs it, and it
/// opens no connection.
std::vector<std::string> network_libraries(std::string_view ldd_output);

}  // namespace noli::repository
