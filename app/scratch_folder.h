// SPDX-License-Identifier: Apache-2.0
//
// A folder for files that nobody wants to keep, in memory where the machine has such a place: fuzzers write and sync
// thousands of them a second.
#pragma once

#include <filesystem>

namespace noli::app {

/// Vanishes, with all that is in it, with this.
class ScratchFolder {
 public:
  /// Throws std::system_error when no folder can be made.
  ScratchFolder();
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace noli::app
