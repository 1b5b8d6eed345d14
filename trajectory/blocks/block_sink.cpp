// SPDX-License-Identifier: Apache-2.0
#include "trajectory/blocks/block_sink.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "trajectory/write_file.h"

namespace noli {
namespace {

[[noreturn]] void throw_errno(const std::string& name) {
  throw std::system_error(errno, std::generic_category(), name);
}

bool is_regular(int descriptor) {
  struct stat status = {};
  return ::fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode);
}

/// Does not wait for the reader of a pipe.
int open_file(const std::string& name, FileSink::Open how) {
  const int flags = how == FileSink::Open::create ? O_CREAT | O_EXCL : 0;
  const int descriptor = ::open(name.c_str(), O_WRONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK | flags, 0666);
  if (descriptor < 0 && errno == ELOOP) throw_errno(name + ": is a link, which is not followed; expected a file");
  if (descriptor < 0) throw_errno(name);
  const bool regular = is_regular(descriptor);
  if (regular && ::flock(descriptor, LOCK_EX | LOCK_NB) == 0) return descriptor;
  const int error = regular ? errno : EINVAL;
  ::close(descriptor);
  throw std::system_error(error, std::generic_category(),
                          name + (regular ? ": is being written by another process" : ": is not a regular file"));
}

}  // namespace

FileSink::FileSink(const std::filesystem::path& path, Open how)
    : name_(path.string()), descriptor_(open_file(name_, how)) {
  if (how == Open::create) sync_folder(path.parent_path());
}

FileSink::~FileSink() { ::close(descriptor_); }

void FileSink::check(bool succeeded) const {
  if (!succeeded) throw_errno(name_);
}

void FileSink::write(std::string_view bytes) { check(write_all(descriptor_, bytes)); }

void FileSink::sync() {
  while (::fsync(descriptor_) != 0) check(errno == EINTR);
}

void FileSink::truncate(std::uint64_t size) {
  check(::ftruncate(descriptor_, static_cast<off_t>(size)) == 0);
  check(::lseek(descriptor_, static_cast<off_t>(size), SEEK_SET) >= 0);
}

int try_open_folder(const std::filesystem::path& folder) {
  return ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
}

int open_folder(const std::filesystem::path& folder) {
  const std::string name = folder.empty() ? "." : folder.string();
  const int descriptor = try_open_folder(folder);
  if (descriptor < 0) throw_errno(name);
  return descriptor;
}

void sync_folder(const std::filesystem::path& folder) {
  const int descriptor = open_folder(folder);
  const bool synced = ::fsync(descriptor) == 0 || errno == EINVAL;  // some file systems do not support it
  const int error = errno;
  ::close(descriptor);
  if (!synced) throw std::system_error(error, std::generic_category(), folder.empty() ? "." : folder.string());
}

}  // namespace noli
