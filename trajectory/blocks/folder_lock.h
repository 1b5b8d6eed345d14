// SPDX-License-Identifier: Apache-2.0
//
// Of several processes that write to one folder, one at a time: flock(2) on the folder itself, so that no file is left
// behind and a kill ends it.
//
// What this does not do: where a file system locks no folders, nobody is refused here. The files of a run have locks of
// their own (block_sink.h).
#pragma once

#include <filesystem>
#include <stdexcept>

namespace noli {

/// Another process has it. what(): "FOLDER: is being written by process 123", or "by another process" where that is not
/// known.
struct FolderLocked : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Has the folder as long as this object lives.
class FolderLock {
 public:
  /// Precondition: the folder is there. Throws FolderLocked, within half a second; std::system_error when the folder
  /// cannot be opened.
  explicit FolderLock(const std::filesystem::path& folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int descriptor_;
};

/// Whether somebody has it now. False where that cannot be known.
bool is_locked(const std::filesystem::path& folder);

}  // namespace noli
