// SPDX-License-Identifier: Apache-2.0
//
// Replaces a file as a whole: a new file beside it, the scratch file, takes its name when it is complete.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string_view>

namespace noli {

/// Of the scratch file.
enum class ScratchName : std::uint8_t {
  numbered,  ///< ".noli-0", or the next free number: short, so that it is not too long when the target's name is not
  part,      ///< "NAME.part". Only the file that was created takes the target's name or is removed. Must be durable
  random     ///< "NAME.", 16 random digits, ".part". The caller creates this file and syncs it
};

struct Replacing {
  ScratchName name = ScratchName::numbered;
  bool keep_permissions = false;  ///< owner and permissions of the target, if there is one; not with a random name
  bool durable = true;            ///< syncs, so that a loss of power leaves either the old or the new file
};

/// The target is the path itself: a symbolic link is replaced, and the file it leads to stays. All functions throw
/// std::system_error.
class ReplacedFile {
 public:
  /// Creates the scratch file, except under a random name. The name must be free: a file or link there may belong to
  /// somebody else.
  explicit ReplacedFile(std::filesystem::path target, Replacing how = {});
  /// Removes the scratch file unless it was renamed.
  ~ReplacedFile();
  ReplacedFile(const ReplacedFile&) = delete;
  ReplacedFile& operator=(const ReplacedFile&) = delete;

  /// The scratch file.
  const std::filesystem::path& path() const { return path_; }
  /// Open for reading and writing; negative under a random name, whose file the caller syncs.
  int descriptor() const { return file_; }
  void write(std::string_view bytes);

  /// Renames the scratch file. Nothing may be written afterwards.
  void take_name();

 private:
  [[noreturn]] void fail() const;
  void complete();
  bool take_permissions() const;
  bool is_there() const;

  std::filesystem::path target_, path_;
  Replacing how_;
  int file_ = -1;
  bool named_ = false;
};

}  // namespace noli
