// SPDX-License-Identifier: Apache-2.0
//
// Where a block file is written to.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace noli {

/// Bytes are appended. Each function throws std::system_error when it cannot do what it says (disk full, say); then
/// some of the bytes may have been written.
class Sink {
 public:
  Sink() = default;
  virtual ~Sink() = default;
  Sink(const Sink&) = delete;
  Sink& operator=(const Sink&) = delete;

  virtual void write(std::string_view bytes) = 0;
  /// Returns when what was written survives a loss of power.
  virtual void sync() = 0;
  /// Cuts off all but the first `size` bytes; what is written next follows them.
  virtual void truncate(std::uint64_t size) = 0;
};

/// A file, locked as long as this object lives: of two processes that write the same run the second is refused.
class FileSink : public Sink {
 public:
  enum class Open { create, existing };

  /// create: the file must not be there yet; its folder is synced, so that the name survives too. A link is never
  /// followed: its target may be anybody's. Throws std::system_error, naming the file; also when it is a link or no
  /// regular file.
  FileSink(const std::filesystem::path& path, Open how);
  ~FileSink() override;

  void write(std::string_view bytes) override;
  void sync() override;
  void truncate(std::uint64_t size) override;

 private:
  void check(bool succeeded) const;

  std::string name_;
  int descriptor_;
};

/// A descriptor of the folder, the current one where the name is empty; negative, with errno, where it cannot be
/// opened.
int try_open_folder(const std::filesystem::path& folder);
/// The same, but throws std::system_error.
int open_folder(const std::filesystem::path& folder);

/// Makes the names in a folder survive a loss of power. Throws std::system_error.
void sync_folder(const std::filesystem::path& folder);

}  // namespace noli
