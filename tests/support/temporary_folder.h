// SPDX-License-Identifier: Apache-2.0
//
// A folder for the files of one test.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace noli::test {

/// A new empty folder, removed with all that is in it at the end of the scope. Throws std::runtime_error when it or a
/// file in it cannot be made.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path operator/(const std::string& file) const { return path_ / file; }
  /// Writes a file and returns its path.
  std::filesystem::path write(const std::string& file, std::string_view content) const;
  /// Names of the files in it, sorted.
  std::vector<std::string> names() const;

 private:
  std::filesystem::path path_;
};

/// The whole file. Throws std::runtime_error when it cannot be read.
std::string read_text(const std::filesystem::path& path);

}  // namespace noli::test
