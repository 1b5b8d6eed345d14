// SPDX-License-Identifier: Apache-2.0
//
// A folder for what an audit makes on its way, which vanishes with the object.
#pragma once

#include <filesystem>

namespace noli::audit {

class ScratchFolder {
 public:
  /// Where the system keeps temporary files. Throws std::system_error when none can be made there.
  ScratchFolder();
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace noli::audit
