// SPDX-License-Identifier: Apache-2.0
//
// Records a program's actions on the files of one folder, in order. tests/faults/disk_model.h derives from them what a
// loss of power may leave. This is a library for LD_PRELOAD.
//
// Environment
//   NOLI_RECORD         the file that records are appended to
//   NOLI_RECORD_FOLDER  only paths with this prefix, and descriptors of such files, are recorded
//
// A record is a line of text, followed by the bytes for a write:
//   open FD FLAGS PATH | write FD SIZE | seek FD OFFSET | truncate FD SIZE | sync FD | close FD
//   rename FROM\tTO | unlink PATH | mkdir PATH
#include <dlfcn.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <array>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <mutex>

namespace {

constexpr std::size_t most_descriptors = 1024;

/// Serialises records, whose order matters.
std::mutex mutex;
std::array<bool, most_descriptors> recorded{};
int out = -1;

const char* folder() {
  static const char* const path = std::getenv("NOLI_RECORD_FOLDER");
  return path;
}

bool begins_so(const char* path) {
  return folder() != nullptr && std::strncmp(path, folder(), std::strlen(folder())) == 0;
}

bool is_recorded(int file) {
  return file >= 0 && static_cast<std::size_t>(file) < most_descriptors && recorded[static_cast<std::size_t>(file)];
}

void put(const char* bytes, std::size_t size) {
  if (out < 0) {
    const char* const path = std::getenv("NOLI_RECORD");
    if (path == nullptr) return;
    out = static_cast<int>(::syscall(SYS_openat, AT_FDCWD, path, O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666));
  }
  ::syscall(SYS_write, out, bytes, size);
}

void put_line(const char* format, ...) __attribute__((format(printf, 1, 2)));
void put_line(const char* format, ...) {
  std::array<char, 4096> line{};
  va_list more;
  va_start(more, format);
  const int size = std::vsnprintf(line.data(), line.size(), format, more);
  va_end(more);
  if (size > 0) put(line.data(), static_cast<std::size_t>(size));
}

int open_recorded(const char* path, int flags, mode_t mode) {
  const std::lock_guard lock(mutex);
  const auto file = static_cast<int>(::syscall(SYS_openat, AT_FDCWD, path, flags, mode));
  if (file < 0 || !begins_so(path) || static_cast<std::size_t>(file) >= most_descriptors) return file;
  recorded[static_cast<std::size_t>(file)] = true;
  put_line("open %d %d %s\n", file, flags, path);
  return file;
}

int truncate_recorded(int file, off_t size) {
  const std::lock_guard lock(mutex);
  const auto done = static_cast<int>(::syscall(SYS_ftruncate, file, size));
  if (done == 0 && is_recorded(file)) put_line("truncate %d %lld\n", file, static_cast<long long>(size));
  return done;
}

off_t seek_recorded(int file, off_t offset, int from) {
  const std::lock_guard lock(mutex);
  const off_t now = ::syscall(SYS_lseek, file, offset, from);
  if (now >= 0 && is_recorded(file)) put_line("seek %d %lld\n", file, static_cast<long long>(now));
  return now;
}

}  // namespace

extern "C" {

int open(const char* path, int flags, ...) {
  va_list more;
  va_start(more, flags);
  const mode_t mode = (flags & O_CREAT) != 0 ? va_arg(more, mode_t) : 0;
  va_end(more);
  return open_recorded(path, flags, mode);
}
int open64(const char* path, int flags, ...) {
  va_list more;
  va_start(more, flags);
  const mode_t mode = (flags & O_CREAT) != 0 ? va_arg(more, mode_t) : 0;
  va_end(more);
  return open_recorded(path, flags, mode);
}

ssize_t write(int file, const void* bytes, std::size_t size) {
  const std::lock_guard lock(mutex);
  const ssize_t written = ::syscall(SYS_write, file, bytes, size);
  if (written > 0 && is_recorded(file)) {
    put_line("write %d %lld\n", file, static_cast<long long>(written));
    put(static_cast<const char*>(bytes), static_cast<std::size_t>(written));
  }
  return written;
}

off_t lseek(int file, off_t offset, int from) { return seek_recorded(file, offset, from); }
off64_t lseek64(int file, off64_t offset, int from) { return seek_recorded(file, offset, from); }
int ftruncate(int file, off_t size) { return truncate_recorded(file, size); }
int ftruncate64(int file, off64_t size) { return truncate_recorded(file, size); }

int fsync(int file) {
  const std::lock_guard lock(mutex);
  const auto done = static_cast<int>(::syscall(SYS_fsync, file));
  if (done == 0 && is_recorded(file)) put_line("sync %d\n", file);
  return done;
}

int close(int file) {
  const std::lock_guard lock(mutex);
  if (is_recorded(file)) {
    recorded[static_cast<std::size_t>(file)] = false;
    put_line("close %d\n", file);
  }
  return static_cast<int>(::syscall(SYS_close, file));
}

int rename(const char* from, const char* to) {
  const std::lock_guard lock(mutex);
  const auto done = static_cast<int>(::syscall(SYS_renameat2, AT_FDCWD, from, AT_FDCWD, to, 0));
  if (done == 0 && begins_so(to)) put_line("rename %s\t%s\n", from, to);
  return done;
}

int unlink(const char* path) {
  const std::lock_guard lock(mutex);
  const auto done = static_cast<int>(::syscall(SYS_unlinkat, AT_FDCWD, path, 0));
  if (done == 0 && begins_so(path)) put_line("unlink %s\n", path);
  return done;
}
int remove(const char* path) { return unlink(path); }

int mkdir(const char* path, mode_t mode) {
  const std::lock_guard lock(mutex);
  const auto done = static_cast<int>(::syscall(SYS_mkdirat, AT_FDCWD, path, mode));
  if (done == 0 && begins_so(path)) put_line("mkdir %s\n", path);
  return done;
}

}  // extern "C"
