// SPDX-License-Identifier: Apache-2.0
//
// A folder for files that nobody wants to keep.
#pragma once

#include <cstdint>
#include <filesystem>

namespace noli {

/// Vanishes, with all that is in it, with this.
class ScratchFolder {
 public:
  /// `disk`: where the system keeps temporary files. `memory`: where the machine has files in memory, for who writes
  /// and syncs thousands of small ones a second; else the same.
  enum class Place : std::uint8_t { disk, memory };

  /// Throws std::system_error when no folder can be made there.
  explicit ScratchFolder(Place place = Place::disk);
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace noli
