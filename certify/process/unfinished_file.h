// SPDX-License-Identifier: Apache-2.0
//
// A file that is there as a whole or not at all.
#pragma once

#include <filesystem>

namespace noli {

/// Has a random name beside the file until it is finished. Vanishes if it never is.
class UnfinishedFile {
 public:
  explicit UnfinishedFile(const std::filesystem::path& file);
  ~UnfinishedFile();
  UnfinishedFile(const UnfinishedFile&) = delete;
  UnfinishedFile& operator=(const UnfinishedFile&) = delete;

  /// Where to write.
  const std::filesystem::path& path() const { return path_; }
  /// Gives it its name, and replaces what has it. Throws std::system_error.
  void finish() const;

 private:
  std::filesystem::path file_, path_;
};

}  // namespace noli
