// SPDX-License-Identifier: Apache-2.0
//
// What ships under Apache-2.0 may stand on permissive and LGPL code, not on GPL code. This finds every header that the
// compiler reads for what ships, by asking the compiler, and judges the licence each header states.
//
// What this does not do: it gives no legal advice, and it judges no header that states no licence at all, unless it is
// CGAL's, whose headers all do.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace noli::repository {

/// Why a header with this path and text may not be in what ships; empty when it may.
std::string objection(const std::filesystem::path& path, std::string_view text);

/// How the build compiles one source.
struct CompileCommand {
  std::filesystem::path file;    ///< absolute
  std::string flags;             ///< compiler and flags, without the input, -c and -o; a shell command's beginning
  std::filesystem::path folder;  ///< where it is run
};

/// The build's compile_commands.json, with a command for each source of a batch (cmake/NoliBatches.cmake). Throws
/// std::runtime_error when the file is missing.
std::vector<CompileCommand> compile_commands(const std::filesystem::path& build);

/// The absolute paths, links resolved, of all files that the compiler reads for `input` with the flags of `command`.
/// Throws std::runtime_error with the compiler's messages when it fails.
std::vector<std::filesystem::path> files_read(const CompileCommand& command, const std::filesystem::path& input);

/// One line for each of the files that has an objection.
std::vector<std::string> licence_violations(const std::vector<std::filesystem::path>& files);

/// The libraries that `readelf -d` lists as needed and that are not among those THIRD_PARTY.md speaks of (nor the
/// system's or a sanitizer's). HDF5 is for noli_series alone: its package brings libraries of networks.
std::vector<std::string> unexpected_libraries(std::string_view readelf_output);

/// The libraries in what `ldd` lists that have no place in a program which decides geometry: HDF5, and those of
/// networks, certificates and directories that its package brings.
std::vector<std::string> network_libraries(std::string_view ldd_output);

}  // namespace noli::repository
