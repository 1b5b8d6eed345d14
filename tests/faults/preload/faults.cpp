// SPDX-License-Identifier: Apache-2.0
//
// Makes calls of a program fail, as if memory had run out, the disk were full or a file system broken. This is a
// library for LD_PRELOAD. It counts calls from the first instruction of main() until main() returns.
//
// Environment
//   NOLI_FAULT           KIND:N     the N-th call of this kind fails, counted from 1 over all threads
//                        KIND:N+    and so do all later ones
//                        unset      no call fails
//   NOLI_FAULT_PROGRAM   the file name of the program whose calls fail; children with another name are unaffected
//   NOLI_FAULT_COUNTS    a file; a line "KIND COUNT" is appended to it for each kind when the program ends
//
// Kinds, and the errno of a failing call
//   allocate  malloc and its kin            ENOMEM
//   open      files and folders             EMFILE
//   read      also of folders               EIO
//   write     also of the file's size       ENOSPC
//   sync      fsync, fdatasync              EIO
//   rename    also link, unlink             EIO
//   close     the descriptor is closed      EIO
//
// It does not see calls inside the C library (the writes of printf(), for example), nor those of a statically linked
// program.
#include <dirent.h>
#include <dlfcn.h>
#include <fcntl.h>
#include <sys/syscall.h>
#include <sys/types.h>
#include <sys/uio.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstdarg>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>

extern "C" {
// The C library's own functions, because dlsym() may allocate.
void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);
void* __libc_memalign(std::size_t, std::size_t);
}

namespace {

enum Kind { allocate, open_file, read_file, write_file, sync_file, rename_file, close_file, kinds };

struct KindFacts {
  const char* name;
  int error;
};
constexpr std::array<KindFacts, kinds> facts = {{{"allocate", ENOMEM},
                                                 {"open", EMFILE},
                                                 {"read", EIO},
                                                 {"write", ENOSPC},
                                                 {"sync", EIO},
                                                 {"rename", EIO},
                                                 {"close", EIO}}};

std::atomic<bool> in_main{false};
std::array<std::atomic<std::uint64_t>, kinds> counts{};
int wanted_kind = kinds;
std::uint64_t wanted = 0;
bool and_all_after = false;

/// Counts a call and returns whether it must fail; if so, sets errno.
bool fails(Kind kind) {
  if (!in_main.load(std::memory_order_relaxed)) return false;
  const std::uint64_t number = counts[kind].fetch_add(1, std::memory_order_relaxed) + 1;
  if (kind != wanted_kind || number < wanted || (number > wanted && !and_all_after)) return false;
  errno = facts[kind].error;
  return true;
}

void read_environment() {
  const char* const fault = std::getenv("NOLI_FAULT");
  const char* const colon = fault == nullptr ? nullptr : std::strchr(fault, ':');
  if (colon == nullptr) return;
  for (int kind = 0; kind < kinds; ++kind) {
    const char* const name = facts[static_cast<std::size_t>(kind)].name;
    const auto length = static_cast<std::size_t>(colon - fault);
    if (std::strlen(name) == length && std::strncmp(fault, name, length) == 0) wanted_kind = kind;
  }
  char* end = nullptr;
  wanted = std::strtoull(colon + 1, &end, 10);
  and_all_after = *end == '+';
}

/// Uses only raw system calls, which are neither counted nor made to fail.
void write_counts() {
  const char* const path = std::getenv("NOLI_FAULT_COUNTS");
  if (path == nullptr) return;
  const auto file = static_cast<int>(::syscall(SYS_openat, AT_FDCWD, path, O_WRONLY | O_CREAT | O_APPEND, 0666));
  if (file < 0) return;
  for (std::size_t kind = 0; kind < kinds; ++kind) {
    std::array<char, 64> line{};
    const int size = std::snprintf(line.data(), line.size(), "%s %llu\n", facts[kind].name,
                                   static_cast<unsigned long long>(counts[kind].load()));
    ::syscall(SYS_write, file, line.data(), static_cast<std::size_t>(size));
  }
  ::syscall(SYS_close, file);
}

bool is_this_program() {
  const char* const program = std::getenv("NOLI_FAULT_PROGRAM");
  return program == nullptr || std::strcmp(program, program_invocation_short_name) == 0;
}

using Main = int (*)(int, char**, char**);
Main real_main = nullptr;

int counted_main(int argc, char** argv, char** environment) {
  read_environment();
  in_main = is_this_program();
  const bool counted = in_main;
  const int code = real_main(argc, argv, environment);
  in_main = false;
  if (counted) write_counts();
  return code;
}

/// The next function of this name, the C library's.
template <class F>
F* next(F*, const char* name) {
  return reinterpret_cast<F*>(::dlsym(RTLD_NEXT, name));
}
#define NOLI_NEXT(function) static auto* const real = next(decltype(&function){}, #function)

bool needs_mode(int flags) { return (flags & O_CREAT) != 0 || (flags & O_TMPFILE) == O_TMPFILE; }

}  // namespace

extern "C" {

int __libc_start_main(Main main, int argc, char** argv, void (*init)(), void (*fini)(), void (*loaded)(),
                      void* stack_end) {
  real_main = main;
  using Start = int (*)(Main, int, char**, void (*)(), void (*)(), void (*)(), void*);
  const auto start = reinterpret_cast<Start>(::dlsym(RTLD_NEXT, "__libc_start_main"));
  return start(counted_main, argc, argv, init, fini, loaded, stack_end);
}

void* malloc(std::size_t size) { return fails(allocate) ? nullptr : __libc_malloc(size); }
void* calloc(std::size_t count, std::size_t size) { return fails(allocate) ? nullptr : __libc_calloc(count, size); }
void* realloc(void* old, std::size_t size) { return fails(allocate) ? nullptr : __libc_realloc(old, size); }
void* aligned_alloc(std::size_t alignment, std::size_t size) {
  return fails(allocate) ? nullptr : __libc_memalign(alignment, size);
}
int posix_memalign(void** memory, std::size_t alignment, std::size_t size) {
  if (fails(allocate)) return ENOMEM;
  *memory = __libc_memalign(alignment, size);
  return *memory == nullptr ? ENOMEM : 0;
}

int open(const char* path, int flags, ...) {
  mode_t mode = 0;
  if (needs_mode(flags)) {
    va_list more;
    va_start(more, flags);
    mode = va_arg(more, mode_t);
    va_end(more);
  }
  return fails(open_file) ? -1 : static_cast<int>(::syscall(SYS_openat, AT_FDCWD, path, flags, mode));
}
int open64(const char* path, int flags, ...) {
  mode_t mode = 0;
  if (needs_mode(flags)) {
    va_list more;
    va_start(more, flags);
    mode = va_arg(more, mode_t);
    va_end(more);
  }
  return fails(open_file) ? -1 : static_cast<int>(::syscall(SYS_openat, AT_FDCWD, path, flags, mode));
}
int openat(int folder, const char* path, int flags, ...) {
  mode_t mode = 0;
  if (needs_mode(flags)) {
    va_list more;
    va_start(more, flags);
    mode = va_arg(more, mode_t);
    va_end(more);
  }
  return fails(open_file) ? -1 : static_cast<int>(::syscall(SYS_openat, folder, path, flags, mode));
}
FILE* fopen(const char* path, const char* mode) {
  NOLI_NEXT(fopen);
  return fails(open_file) ? nullptr : real(path, mode);
}
FILE* fopen64(const char* path, const char* mode) {
  NOLI_NEXT(fopen64);
  return fails(open_file) ? nullptr : real(path, mode);
}
DIR* opendir(const char* path) {
  NOLI_NEXT(opendir);
  return fails(open_file) ? nullptr : real(path);
}

ssize_t read(int file, void* bytes, std::size_t size) {
  return fails(read_file) ? -1 : ::syscall(SYS_read, file, bytes, size);
}
ssize_t pread(int file, void* bytes, std::size_t size, off_t offset) {
  return fails(read_file) ? -1 : ::syscall(SYS_pread64, file, bytes, size, offset);
}
ssize_t pread64(int file, void* bytes, std::size_t size, off64_t offset) {
  return fails(read_file) ? -1 : ::syscall(SYS_pread64, file, bytes, size, offset);
}
/// Sets the stream's error flag, so that ferror() reports it.
static void mark_failed(FILE* stream) { stream->_flags |= 0x20; }
std::size_t fread(void* bytes, std::size_t size, std::size_t count, FILE* stream) {
  NOLI_NEXT(fread);
  if (!fails(read_file)) return real(bytes, size, count, stream);
  mark_failed(stream);
  return 0;
}
dirent* readdir(DIR* folder) {
  NOLI_NEXT(readdir);
  return fails(read_file) ? nullptr : real(folder);
}
dirent64* readdir64(DIR* folder) {
  NOLI_NEXT(readdir64);
  return fails(read_file) ? nullptr : real(folder);
}

ssize_t write(int file, const void* bytes, std::size_t size) {
  return fails(write_file) ? -1 : ::syscall(SYS_write, file, bytes, size);
}
ssize_t writev(int file, const iovec* parts, int count) {
  return fails(write_file) ? -1 : ::syscall(SYS_writev, file, parts, count);
}
int fflush(FILE* stream) {
  NOLI_NEXT(fflush);
  if (!fails(write_file)) return real(stream);
  if (stream != nullptr) mark_failed(stream);
  return EOF;
}
int ftruncate(int file, off_t size) {
  return fails(write_file) ? -1 : static_cast<int>(::syscall(SYS_ftruncate, file, size));
}
int ftruncate64(int file, off64_t size) {
  return fails(write_file) ? -1 : static_cast<int>(::syscall(SYS_ftruncate, file, size));
}

int fsync(int file) { return fails(sync_file) ? -1 : static_cast<int>(::syscall(SYS_fsync, file)); }
int fdatasync(int file) { return fails(sync_file) ? -1 : static_cast<int>(::syscall(SYS_fdatasync, file)); }

int rename(const char* from, const char* to) {
  return fails(rename_file) ? -1 : static_cast<int>(::syscall(SYS_renameat2, AT_FDCWD, from, AT_FDCWD, to, 0));
}
int link(const char* from, const char* to) {
  return fails(rename_file) ? -1 : static_cast<int>(::syscall(SYS_linkat, AT_FDCWD, from, AT_FDCWD, to, 0));
}
int unlink(const char* path) {
  return fails(rename_file) ? -1 : static_cast<int>(::syscall(SYS_unlinkat, AT_FDCWD, path, 0));
}
int remove(const char* path) {
  NOLI_NEXT(remove);
  return fails(rename_file) ? -1 : real(path);
}

int close(int file) {
  const bool fail = fails(close_file);
  const auto closed = static_cast<int>(::syscall(SYS_close, file));
  if (!fail) return closed;
  errno = EIO;
  return -1;
}
int fclose(FILE* file) {
  NOLI_NEXT(fclose);
  const bool fail = fails(close_file);
  const int closed = real(file);
  if (!fail) return closed;
  errno = EIO;
  return EOF;
}

}  // extern "C"
