// SPDX-License-Identifier: Apache-2.0
//
// The arrays of a `.npz` file: a ZIP archive of `.npy` members, stored or deflated, also of more than 4 GB. Read with
// libzip, which checks the members' CRC.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "trajectory/formats/arrays/byte_stream.h"

namespace noli {

/// Whether this was built with libzip (NOLI_WITH_ZIP).
bool can_read_npz();

class NpzFile {
 public:
  /// Throws InputError: no such file, no archive, built without libzip.
  explicit NpzFile(const std::filesystem::path& path);
  ~NpzFile();
  NpzFile(const NpzFile&) = delete;
  NpzFile& operator=(const NpzFile&) = delete;

  /// The names of the members that end in .npy, without that.
  const std::vector<std::string>& keys() const { return keys_; }
  /// The bytes of a member, as they were before they were deflated. Refuses what is longer than a gigabyte and was
  /// deflated to less than a two hundredth of it. Valid as long as this is. Throws InputError.
  std::unique_ptr<ByteStream> open(std::size_t key) const;
  /// Its length, as the archive tells.
  std::uint64_t size(std::size_t key) const;

 private:
  class Member;
  struct Archive;

  std::string name_;
  std::unique_ptr<Archive> archive_;
  std::vector<std::string> keys_;
  std::vector<std::uint64_t> members_;  ///< of each key: its number in the archive
};

}  // namespace noli
