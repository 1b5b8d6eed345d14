// SPDX-License-Identifier: Apache-2.0
//
// Lets only one process at a time write to a folder. It uses flock(2) on the folder itself, so no file is left behind,
// and a kill releases the lock.
//
// On file systems that cannot lock folders it refuses nobody. The files of a run have locks of their own
// (block_sink.h).
#pragma once

#include <filesystem>
#include <stdexcept>

namespace noli {

/// Another process has the lock. what(): "FOLDER: is being written by process 123", or "by another process" if its
/// number is unknown.
struct FolderLocked : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Holds the lock as long as this object lives.
class FolderLock {
 public:
  /// Precondition: the folder exists. Throws FolderLocked, within half a second; std::system_error when the folder
  /// cannot be opened.
  explicit FolderLock(const std::filesystem::path& folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int descriptor_;
};

/// Whether somebody holds the lock now; false if that cannot be known.
bool is_locked(const std::filesystem::path& folder);

}  // namespace noli
