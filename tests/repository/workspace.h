// SPDX-License-Identifier: Apache-2.0
//
// Helpers for files and commands in the tests of this folder.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "tests/support/temporary_folder.h"

namespace noli::repository {

using test::read_text;
using test::TemporaryFolder;

/// Writes the file and creates its parent folders.
void write_file(const std::filesystem::path& path, std::string_view text);

/// All files below `folder` in ascending order, except .git and what git ignores (build folders, caches).
std::vector<std::filesystem::path> files_below(const std::filesystem::path& folder);

/// Whether the file is C++ by its name: .h or .cpp.
bool is_cpp(const std::filesystem::path& path);

struct CommandResult {
  int exit_code = -1;  ///< as in a shell; 128 + n after signal n
  std::string output;  ///< standard output; redirect with 2>&1 for both
};

/// Runs a shell command and waits for it.
CommandResult run(const std::string& command);

/// The text as one word of a shell command.
std::string quoted(const std::string& text);

/// Each string on its own line.
std::string lines(const std::vector<std::string>& all);

}  // namespace noli::repository
