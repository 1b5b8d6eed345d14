// SPDX-License-Identifier: Apache-2.0
//
// Creates a folder for the files of one test.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace noli::test {

/// A new empty folder, removed with its contents at the end of the scope. Throws std::runtime_error if it or a file in
/// it cannot be created.
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
  /// Names of its files, sorted.
  std::vector<std::string> names() const;

 private:
  std::filesystem::path path_;
};

/// The content of a file. Throws std::runtime_error if it cannot be read.
std::string read_text(const std::filesystem::path& path);

}  // namespace noli::test
