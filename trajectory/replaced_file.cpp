// SPDX-License-Identifier: Apache-2.0
#include "trajectory/replaced_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <random>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "trajectory/blocks/block_sink.h"
#include "trajectory/write_file.h"

namespace noli {

ReplacedFile::ReplacedFile(std::filesystem::path target, Replacing how) : target_(std::move(target)), how_(how) {
  if ((how.name == ScratchName::random && how.keep_permissions) || (how.name == ScratchName::part && !how.durable)) {
    throw std::logic_error("a file is replaced in a way that is not offered");
  }
  if (how.name == ScratchName::random) {
    std::random_device random;
    path_ = target_.string() + fmt::format(".{:08x}{:08x}.part", random(), random());
    return;
  }
  const bool numbered = how.name == ScratchName::numbered;
  struct stat old = {};
  // Until the scratch file has the permissions of the target, nobody else may read it.
  const mode_t mode = how.keep_permissions && ::stat(target_.c_str(), &old) == 0 ? 0600 : 0666;
  for (std::uint64_t number = 0; file_ < 0; ++number) {
    path_ = numbered ? target_.parent_path() / fmt::format(".noli-{}", number)
                     : std::filesystem::path(target_.string() + ".part");
    file_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, mode);
    if (file_ < 0 && !(numbered && errno == EEXIST)) fail();
  }
}

ReplacedFile::~ReplacedFile() {
  if (!named_ && (how_.name != ScratchName::part || is_there())) ::unlink(path_.c_str());
  if (file_ >= 0) ::close(file_);
}

void ReplacedFile::fail() const { throw std::system_error(errno, std::generic_category(), path_.string()); }

void ReplacedFile::write(std::string_view bytes) {
  if (!write_all(file_, bytes)) fail();
}

/// Gives it the owner and permissions of the target, if there is one.
bool ReplacedFile::take_permissions() const {
  struct stat old = {};
  if (::stat(target_.c_str(), &old) != 0) return true;
  const bool same_owner = old.st_uid == ::geteuid() && old.st_gid == ::getegid();
  if (!same_owner && ::fchown(file_, old.st_uid, old.st_gid) != 0) return false;
  return ::fchmod(file_, old.st_mode & 0777) == 0;
}

/// Whether the name still refers to the file that was created.
bool ReplacedFile::is_there() const {
  struct stat named = {}, made = {};
  return ::lstat(path_.c_str(), &named) == 0 && ::fstat(file_, &made) == 0 && named.st_dev == made.st_dev &&
         named.st_ino == made.st_ino;
}

/// A write that failed late shows when the file is synced, or else when it is closed.
void ReplacedFile::complete() {
  if (how_.keep_permissions && !take_permissions()) fail();
  while (how_.durable && ::fsync(file_) != 0) {
    if (errno != EINTR) fail();
  }
  if (how_.name == ScratchName::part && !is_there()) {
    throw std::system_error(std::make_error_code(std::errc::io_error),
                            path_.string() + ": another process replaced it");
  }
  if (!how_.durable && ::close(std::exchange(file_, -1)) != 0) fail();
}

void ReplacedFile::take_name() {
  if (file_ >= 0) complete();
  std::error_code error;
  std::filesystem::rename(path_, target_, error);
  if (error && how_.name == ScratchName::part) throw std::system_error(error, target_.string());
  if (error) throw std::filesystem::filesystem_error("cannot rename", path_, target_, error);
  named_ = true;
  if (how_.durable) sync_folder(target_.parent_path());
}

}  // namespace noli
