// SPDX-License-Identifier: Apache-2.0
//
// Reads a file or pipe from beginning to end, and reacts to a request to stop (stop.h) while it waits.
//
// Opening does not block: read() waits for a named pipe that has no writer yet. Endless input is refused: devices other
// than terminals at once, anything else before it fills the memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

namespace noli {

class InputFile {
 public:
  /// Throws InputError without a place when it is missing, is a folder or a device, or cannot be opened.
  explicit InputFile(const std::filesystem::path& path);
  /// The same, called so in errors.
  InputFile(const std::filesystem::path& path, std::string name);
  /// Reads a descriptor, which is closed with this.
  InputFile(int descriptor, std::string name);
  ~InputFile();
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;

  /// Reads the next bytes, at most `size`; 0 at the end. Throws InputError when that fails, ReadInterrupted.
  std::size_t read(char* to, std::size_t size);
  /// All remaining bytes. Throws as read() does, and InputError when they are more than half of this machine's memory.
  std::string read_to_end();

 private:
  void look();
  void wait() const;

  std::string name_;
  int descriptor_ = -1;
  bool regular_ = false;
  std::uint64_t size_ = 0;   ///< bytes of a regular file
  std::uint64_t taken_ = 0;  ///< bytes that were read
};

/// Throws InputError when the path names something else: a folder, a pipe, a device. Links are followed.
void require_regular_file(const std::filesystem::path& path);

/// Opens a file for reading. Throws InputError when it cannot be opened, or is not a regular file.
std::ifstream open_regular_file(const std::filesystem::path& path);

}  // namespace noli
