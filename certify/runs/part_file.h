// SPDX-License-Identifier: Apache-2.0
//
// A file of a run that is written beside its place, as "NAME.part", and takes the name when it is whole.
//
// The folder may come from anybody: a link by the name is not followed, and nothing but the file that was made here
// takes the place.
#pragma once

#include <filesystem>
#include <string>

namespace noli {

class PartFile {
 public:
  /// A file by that name that a killed process left is removed first. Throws InputError when there is something else by
  /// it, a link or a folder; std::system_error, naming the file, when it cannot be made.
  explicit PartFile(const std::filesystem::path& path);
  /// Leaves nothing behind of a file that did not take its name.
  ~PartFile();
  PartFile(const PartFile&) = delete;
  PartFile& operator=(const PartFile&) = delete;

  /// Open for reading and writing; closed with this.
  int descriptor() const { return file_; }

  /// Syncs it, gives it its name, or that of a file that is there, and syncs the folder. Throws std::system_error.
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
