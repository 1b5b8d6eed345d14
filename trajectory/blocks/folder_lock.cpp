// SPDX-License-Identifier: Apache-2.0
#include "trajectory/blocks/folder_lock.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <fstream>
#include <optional>
#include <sstream>
#include <string>
#include <thread>

#include "trajectory/blocks/block_sink.h"

namespace noli {
namespace {

namespace fs = std::filesystem;

/// Whether the name still refers to the folder that was opened: another process may have put a new one there.
bool is_there(int descriptor, const fs::path& folder) {
  struct stat opened = {}, named = {};
  return ::fstat(descriptor, &opened) == 0 && ::stat(folder.c_str(), &named) == 0 && opened.st_dev == named.st_dev &&
         opened.st_ino == named.st_ino;
}

/// The process that holds the exclusive lock, from /proc/locks: "1: FLOCK  ADVISORY  WRITE 123 08:01:456 0 EOF".
std::optional<int> holder(int descriptor) {
  struct stat status = {};
  if (::fstat(descriptor, &status) != 0) return std::nullopt;
  const std::string inode = fmt::format("{:02x}:{:02x}:{}", major(status.st_dev), minor(status.st_dev), status.st_ino);
  std::ifstream locks("/proc/locks");
  for (std::string line; std::getline(locks, line);) {
    std::istringstream words(line);
    std::string number, kind, advisory, mode, place;
    int process = 0;
    if (words >> number >> kind >> advisory >> mode >> process >> place && kind == "FLOCK" && mode == "WRITE" &&
        place == inode && process > 0) {
      return process;
    }
  }
  return std::nullopt;
}

enum class Attempt { locked, refused, impossible };

Attempt lock(int descriptor, int how) {
  while (::flock(descriptor, how | LOCK_NB) != 0) {
    if (errno == EWOULDBLOCK) return Attempt::refused;
    if (errno != EINTR) return Attempt::impossible;
  }
  return Attempt::locked;
}

/// is_locked() in another process holds a shared lock for a moment. That is not a writer, so this waits for it.
int lock_folder(const fs::path& folder) {
  using Clock = std::chrono::steady_clock;
  const auto patience = Clock::now() + std::chrono::milliseconds(400);
  for (;;) {
    const int descriptor = open_folder(folder);
    const Attempt attempt = lock(descriptor, LOCK_EX);
    if (attempt != Attempt::refused && is_there(descriptor, folder)) return descriptor;
    const std::optional<int> process = attempt == Attempt::refused ? holder(descriptor) : std::nullopt;
    ::close(descriptor);
    if (process) throw FolderLocked(fmt::format("{}: is being written by process {}", folder.string(), *process));
    if (Clock::now() > patience) throw FolderLocked(folder.string() + ": is being written by another process");
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

}  // namespace

FolderLock::FolderLock(const fs::path& folder) : descriptor_(lock_folder(folder)) {}

FolderLock::~FolderLock() { ::close(descriptor_); }

bool is_locked(const fs::path& folder) {
  const int descriptor = try_open_folder(folder);
  if (descriptor < 0) return false;
  const bool locked = lock(descriptor, LOCK_SH) == Attempt::refused;
  ::close(descriptor);
  return locked;
}

}  // namespace noli
