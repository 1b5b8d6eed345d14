// SPDX-License-Identifier: Apache-2.0
//
// Files, temporary folders and commands, as the tests of this folder need them.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace noli::repository {

/// The whole file. Throws std::runtime_error when it cannot be read.
std::string read_file(const std::filesystem::path& path);
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

/// A new empty folder, removed with all that is in it at the end of the scope.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace noli::repository
