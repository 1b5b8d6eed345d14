// SPDX-License-Identifier: Apache-2.0
//
// Files and commands, as the tests of this folder need them.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "tests/support/temporary_folder.h"

namespace noli::repository {

using test::read_text;
using test::TemporaryFolder;

/// Writes the file, and makes the folders it is in.
void write_file(const std::filesystem::path& path, std::string_view text);

/// All files below `folder` in ascending order, but for what git ignores here (build folders, caches) and .git itself.
std::vector<std::filesystem::path> files_below(const std::filesystem::path& folder);

/// Whether the file is C++ by its name: .h or .cpp.
bool is_cpp(const std::filesystem::path& path);

struct CommandResult {
  int exit_code = -1;  ///< as a shell gives it; 128 + n when ended by signal n
  std::string output;  ///< standard output; redirect with 2>&1 for both
};

/// Runs a line of shell and waits for it.
CommandResult run(const std::string& command);

/// The text as one word of a shell command.
std::string quoted(const std::string& text);

/// Each on a line of its own.
std::string lines(const std::vector<std::string>& all);

}  // namespace noli::repository
