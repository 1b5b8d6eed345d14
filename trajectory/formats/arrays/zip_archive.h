// SPDX-License-Identifier: Apache-2.0
//
// A ZIP archive that is open for reading, with libzip. Archives and members of any length are read (zip64).
//
// libzip takes the directory that suits it among all that it finds in the last 64 KB, and reads any number of entries.
// So the end of the directory is checked here first: it is the end of the file, and the directory lies directly before
// it. libzip is then shown the file with a comment of 64 KB behind it, and so finds no other end of a directory.
#pragma once

#include <zip.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

namespace noli {

class ZipArchive {
 public:
  /// Throws InputError: no such file, no archive, a damaged directory, or one of more than 16 MB.
  explicit ZipArchive(const std::filesystem::path& path);
  ~ZipArchive();
  ZipArchive(const ZipArchive&) = delete;
  ZipArchive& operator=(const ZipArchive&) = delete;

  /// For one thread at a time, as are the members that it opens.
  zip_t* get() const { return zip_; }

 private:
  static zip_int64_t answer(void* archive, void* data, zip_uint64_t length, zip_source_cmd_t command);
  zip_int64_t read_with_comment(char* to, std::uint64_t length);
  bool read_file(std::uint64_t at, char* to, std::uint64_t length);
  std::string bytes_at(std::uint64_t at, std::uint64_t length);
  std::uint64_t check_directory(const std::string& name);

  std::ifstream file_;
  std::uint64_t size_ = 0;       ///< bytes of the file, without the comment
  std::uint64_t file_at_ = 0;    ///< where the file is read next
  std::uint64_t source_at_ = 0;  ///< where libzip reads next
  zip_error_t error_{};
  zip_t* zip_ = nullptr;
};

}  // namespace noli
