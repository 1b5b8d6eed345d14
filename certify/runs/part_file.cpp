// SPDX-License-Identifier: Apache-2.0
#include "certify/runs/part_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include <noli/errors.h>
#include "trajectory/blocks/block_sink.h"

namespace noli {
PartFile::PartFile(const std::filesystem::path& path)
    : path_(path), name_(path.filename().string()), part_(name_ + ".part"), folder_(open_folder(path.parent_path())) {
  try {
    remove_earlier();
    file_ = ::openat(folder_, part_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
    if (file_ < 0) fail(errno, part_);
  } catch (...) {
    ::close(folder_);
    throw;
  }
}

PartFile::~PartFile() {
  if (!named_ && is_there()) ::unlinkat(folder_, part_.c_str(), 0);
  ::close(file_);
  ::close(folder_);
}

void PartFile::fail(int error, const std::string& name) const {
  throw std::system_error(error, std::generic_category(), (path_.parent_path() / name).string());
}

void PartFile::remove_earlier() const {
  struct stat there = {};
  if (::fstatat(folder_, part_.c_str(), &there, AT_SYMLINK_NOFOLLOW) != 0) {
    if (errno != ENOENT) fail(errno, part_);
    return;
  }
  if (!S_ISREG(there.st_mode)) {
    throw InputError((path_.parent_path() / part_).string(), "",
                     "is a link, or not a file; remove it, and pass --resume to write " + name_);
  }
  if (::unlinkat(folder_, part_.c_str(), 0) != 0 && errno != ENOENT) fail(errno, part_);
}

/// Whether the name still refers to the file that was created.
bool PartFile::is_there() const {
  struct stat named = {}, made = {};
  return ::fstatat(folder_, part_.c_str(), &named, AT_SYMLINK_NOFOLLOW) == 0 && ::fstat(file_, &made) == 0 &&
         named.st_dev == made.st_dev && named.st_ino == made.st_ino;
}

void PartFile::take_name() {
  while (::fsync(file_) != 0) {
    if (errno != EINTR) fail(errno, part_);
  }
  if (!is_there()) {
    throw std::system_error(std::make_error_code(std::errc::io_error),
                            (path_.parent_path() / part_).string() + ": another process replaced it");
  }
  if (::renameat(folder_, part_.c_str(), folder_, name_.c_str()) != 0) fail(errno, name_);
  named_ = true;
  if (::fsync(folder_) != 0 && errno != EINVAL) fail(errno, name_);  // some file systems do not support it
}

}  // namespace noli
