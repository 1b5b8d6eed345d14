// SPDX-License-Identifier: Apache-2.0
//
// A temporary folder.
#pragma once

#include <cstdint>
#include <filesystem>

namespace noli {

/// The destructor removes the folder with its contents.
class ScratchFolder {
 public:
  /// `disk`: where the system keeps temporary files. `memory`: a file system in memory if there is one, for writing and
  /// syncing thousands of small files a second; otherwise like `disk`.
  enum class Place : std::uint8_t { disk, memory };

  /// Throws std::system_error when no folder can be created there.
  explicit ScratchFolder(Place place = Place::disk);
  /// Within `parent`, for what may be too large for the system's temporary folder; that is used if `parent` is not
  /// writable. Throws the same.
  explicit ScratchFolder(const std::filesystem::path& parent);
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  int process_;  ///< removes it; the child of a fork does not
};

}  // namespace noli
