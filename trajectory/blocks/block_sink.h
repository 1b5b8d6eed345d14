// SPDX-License-Identifier: Apache-2.0
//
// Sinks, to which block files are written.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace noli {

/// Appends bytes. Each function throws std::system_error when it fails (disk full, for example); some of the bytes may
/// then have been written.
class Sink {
 public:
  Sink() = default;
  virtual ~Sink() = default;
  Sink(const Sink&) = delete;
  Sink& operator=(const Sink&) = delete;

  virtual void write(std::string_view bytes) = 0;
  /// Returns once everything written so far survives a loss of power.
  virtual void sync() = 0;
  /// Cuts off all but the first `size` bytes; what is written next follows them.
  virtual void truncate(std::uint64_t size) = 0;
};

/// A file, locked as long as this object lives, so that a second process cannot write to the same run.
class FileSink : public Sink {
 public:
  enum class Open { create, existing };

  /// create: the file must not exist; its folder is synced, so that the name survives too. A link is never followed, as
  /// its target may belong to somebody else. Throws std::system_error, naming the file; also for a link, or anything
  /// else that is not a regular file.
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

/// A descriptor of the folder; an empty name means the current folder. Negative, with errno, if it cannot be opened.
int try_open_folder(const std::filesystem::path& folder);
/// The same, but throws std::system_error.
int open_folder(const std::filesystem::path& folder);

/// Makes the names in a folder survive a loss of power. Throws std::system_error.
void sync_folder(const std::filesystem::path& folder);

}  // namespace noli
