// SPDX-License-Identifier: Apache-2.0
//
// A file of a run that is written as "NAME.part" and renamed when it is complete.
//
// The folder need not be trusted: links by the name are not followed, and only the file that was created here gets the
// name.
#pragma once

#include <filesystem>
#include <string>

namespace noli {

class PartFile {
 public:
  /// First removes a part file that a killed process left. Throws InputError when that name is a link or a folder;
  /// std::system_error, naming the file, when it cannot be created.
  explicit PartFile(const std::filesystem::path& path);
  /// Removes the file unless it was renamed.
  ~PartFile();
  PartFile(const PartFile&) = delete;
  PartFile& operator=(const PartFile&) = delete;

  /// Open for reading and writing; closed by the destructor.
  int descriptor() const { return file_; }

  /// Syncs the file, renames it (replacing an existing file), and syncs the folder. Throws std::system_error.
  void take_name();

 private:
  void remove_earlier() const;
  bool is_there() const;
  [[noreturn]] void fail(int error, const std::string& name) const;

  std::filesystem::path path_;
  std::string name_, part_;  ///< in the folder
  int folder_ = -1, file_ = -1;
  bool named_ = false;
};

}  // namespace noli
