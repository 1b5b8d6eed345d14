// SPDX-License-Identifier: Apache-2.0
#include "trajectory/input_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <system_error>
#include <utility>

#include <noli/errors.h>
#include "trajectory/stop.h"

namespace noli {
namespace {

constexpr std::size_t part_size = std::size_t{1} << 20;  ///< bytes that are read between two checks for a stop

/// The largest size that a file may have. Once parsed, its contents take at least as much memory again.
std::uint64_t most_bytes() {
  const long pages = ::sysconf(_SC_PHYS_PAGES), size = ::sysconf(_SC_PAGESIZE);
  constexpr std::uint64_t unknown = std::uint64_t{1} << 32;
  return pages > 0 && size > 0 ? static_cast<std::uint64_t>(pages) * static_cast<std::uint64_t>(size) / 2 : unknown;
}

[[noreturn]] void refuse_size(const std::string& name, std::uint64_t most) {
  throw InputError(name, "", fmt::format("has more than {} bytes, half of this machine's memory", most));
}

}  // namespace

InputFile::InputFile(const std::filesystem::path& path) : InputFile(path, path.string()) {}

InputFile::InputFile(const std::filesystem::path& path, std::string name) : name_(std::move(name)) {
  // O_NONBLOCK: to open a named pipe would wait for its writer, and hear no stop.
  descriptor_ = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY);
  look();
}

InputFile::InputFile(int descriptor, std::string name) : name_(std::move(name)), descriptor_(descriptor) { look(); }

/// Whether it may be read, and how long it is.
void InputFile::look() {
  struct stat status = {};
  if (descriptor_ < 0 || ::fstat(descriptor_, &status) != 0) {
    const int error = errno;
    if (descriptor_ >= 0) ::close(descriptor_);
    throw InputError(name_, "", fmt::format("cannot be opened: {}", std::strerror(error)));
  }
  const bool device = S_ISBLK(status.st_mode) || (S_ISCHR(status.st_mode) && ::isatty(descriptor_) == 0);
  if (device || S_ISDIR(status.st_mode)) {
    ::close(descriptor_);
    throw InputError(name_, "", device ? "is a device, expected a file or a pipe" : "is a folder, expected a file");
  }
  regular_ = S_ISREG(status.st_mode);
  size_ = regular_ ? static_cast<std::uint64_t>(status.st_size) : 0;
}

InputFile::~InputFile() { ::close(descriptor_); }

/// Waits until there is something to read, or the end of the file.
void InputFile::wait() const {
  constexpr int milliseconds = 50;
  for (;;) {
    if (regular_ && taken_ < part_size) return;  // small files take no time, and reports of a stop need some of them
    if (stop_asked()) throw ReadInterrupted(name_);
    if (regular_) return;
    pollfd one{descriptor_, POLLIN, 0};
    const int there = ::poll(&one, 1, milliseconds);
    if (there > 0) return;
    // The handler was installed without SA_RESTART, so the wait should end.
    if (there < 0 && errno == EINTR) throw ReadInterrupted(name_);
  }
}

std::size_t InputFile::read(char* to, std::size_t size) {
  for (;;) {
    wait();
    const ssize_t got = ::read(descriptor_, to, std::min(size, part_size));
    if (got >= 0) {
      taken_ += static_cast<std::size_t>(got);
      return static_cast<std::size_t>(got);
    }
    if (errno != EINTR && errno != EAGAIN) throw InputError(name_, "", "cannot be read to its end");
  }
}

std::string InputFile::read_to_end() {
  const std::uint64_t most = most_bytes();
  if (size_ > most) refuse_size(name_, most);
  std::string bytes;
  bytes.reserve(static_cast<std::size_t>(size_) + 1);
  for (std::size_t used = 0;;) {
    // One byte more than the file has, so that its end is found without growing.
    const std::size_t room =
        used <= size_ && regular_ ? std::min<std::uint64_t>(part_size, size_ + 1 - used) : part_size;
    if (bytes.size() == used) bytes.resize(used + room);
    const std::size_t got = read(bytes.data() + used, bytes.size() - used);
    used += got;
    if (used > most) refuse_size(name_, most);
    if (got > 0) continue;
    bytes.resize(used);
    return bytes;
  }
}

void require_regular_file(const std::filesystem::path& path) {
  std::error_code ignored;
  const std::filesystem::file_status there = std::filesystem::status(path, ignored);
  if (!std::filesystem::exists(there) || std::filesystem::is_regular_file(there)) return;
  throw InputError(path.string(), "", "is not a regular file; expected one");
}

std::ifstream open_regular_file(const std::filesystem::path& path) {
  require_regular_file(path);
  errno = 0;
  std::ifstream in(path, std::ios::binary);
  if (!in) throw InputError(path.string(), "", fmt::format("cannot be opened: {}", std::strerror(errno)));
  return in;
}

}  // namespace noli
