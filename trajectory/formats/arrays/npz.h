// SPDX-License-Identifier: Apache-2.0
//
// The arrays of a `.npz` file: a ZIP archive of `.npy` members of any length, stored or deflated. Their CRC is checked.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "trajectory/formats/arrays/byte_stream.h"

namespace noli {

/// What the archive's directory says of an array.
struct NpzMember {
  std::string key;                     ///< its name without .npy
  std::uint64_t size = 0, packed = 0;  ///< bytes of the array, and in the archive
  std::uint64_t number = 0;            ///< of its entry
};

class ZipArchive;

class NpzFile {
 public:
  /// Throws InputError: no such file, no archive, more than 16 MB of names.
  explicit NpzFile(const std::filesystem::path& path);

  const std::vector<NpzMember>& members() const { return members_; }
  /// Names of members that do not end in .npy.
  const std::vector<std::string>& others() const { return others_; }
  /// The bytes of a member, as they were before they were deflated. Refuses what is longer than a gigabyte and was
  /// deflated to less than a two hundredth of it. All streams of this file are for one thread at a time. They may
  /// outlive the NpzFile. Throws InputError.
  std::unique_ptr<ByteStream> open(std::size_t number) const;

 private:
  std::string name_;
  std::shared_ptr<ZipArchive> archive_;
  std::vector<NpzMember> members_;
  std::vector<std::string> others_;
};

}  // namespace noli
