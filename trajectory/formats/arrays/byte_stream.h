// SPDX-License-Identifier: Apache-2.0
//
// Bytes that come one after another: of a file, a member of an archive, a pipe.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>

#include "trajectory/input_file.h"

namespace noli {

class ByteStream {
 public:
  ByteStream() = default;
  virtual ~ByteStream() = default;
  ByteStream(const ByteStream&) = delete;
  ByteStream& operator=(const ByteStream&) = delete;

  /// The next bytes, at most `size`; 0 at the end. Throws InputError, Stopped.
  virtual std::size_t read(char* to, std::size_t size) = 0;

  /// The next `size` bytes, or all that are left; how many.
  std::size_t read_all(char* to, std::size_t size) {
    std::size_t got = 0;
    while (got < size) {
      const std::size_t part = read(to + got, std::min<std::size_t>(size - got, most_at_once));
      if (part == 0) break;
      got += part;
    }
    return got;
  }

 private:
  static constexpr std::size_t most_at_once = std::size_t{1} << 20;  ///< so that a stop is heard
};

class FileBytes : public ByteStream {
 public:
  /// Throws as InputFile does.
  explicit FileBytes(const std::filesystem::path& path) : file_(path) {}
  /// Reads a descriptor, which is closed with this.
  FileBytes(int descriptor, const std::string& name) : file_(descriptor, name) {}
  std::size_t read(char* to, std::size_t size) override { return file_.read(to, size); }

 private:
  InputFile file_;
};

}  // namespace noli
