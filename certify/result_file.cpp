// SPDX-License-Identifier: Apache-2.0
#include "certify/result_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <system_error>

#include <noli/errors.h>
#include "trajectory/replaced_file.h"
#include "trajectory/write_file.h"

namespace noli {
namespace {

std::string reason() { return std::strerror(errno); }

/// Whether the work throws no system error. Sets errno otherwise.
template <class Work>
bool succeeds(const Work& work) {
  try {
    work();
    return true;
  } catch (const std::system_error& error) {
    errno = error.code().value();
    return false;
  }
}

/// The file that a chain of symbolic links leads to, so that replacing the file leaves the links.
std::string link_target(const std::string& path) {
  std::error_code error;
  const auto target = std::filesystem::canonical(path, error);
  return error ? path : target.string();
}

/// Whether an existing file may be written but not replaced: its folder may not be changed, or it is a mount point.
/// Judged by the error of the attempt to replace it.
bool must_be_kept(int error) { return error == EACCES || error == EPERM || error == EBUSY; }

bool can_write(const std::string& path) {
  if (path.empty()) return errno = ENOENT, false;
  struct stat status = {};
  const bool exists = ::stat(path.c_str(), &status) == 0;
  if (!exists && errno != ENOENT) return false;
  if (exists && ::access(path.c_str(), W_OK) != 0) return false;
  if (!is_regular_or_nothing(path) || succeeds([&] { ReplacedFile{link_target(path)}; })) return true;
  return exists && must_be_kept(errno);
}

/// Whether files can be created in a folder. It tries, as permissions are not enough: root has them all, even where
/// files cannot be created, as in /proc. The file has no name, so that a kill leaves none behind, unless the file
/// system does not support this.
bool can_make_files(const std::string& folder) {
  const int descriptor = ::open(folder.c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, 0600);
  if (descriptor >= 0) return ::close(descriptor) == 0;
  return succeeds([&] { ReplacedFile{std::filesystem::path(folder) / "file"}; });
}

void replace(const std::string& path, const std::string& text) {
  ReplacedFile file(link_target(path), {.keep_permissions = true, .durable = false});
  file.write(text);
  file.take_name();
}

/// Writes to a device, a pipe, or a file that must be kept.
bool write_in_place(const std::string& path, const std::string& text) {
  const int descriptor = ::open(path.c_str(), O_WRONLY | O_TRUNC | O_CLOEXEC);
  if (descriptor < 0) return false;
  const bool written = write_all(descriptor, text);
  return ::close(descriptor) == 0 && written;
}

bool is_written(const std::string& path, const std::string& text) {
  if (!is_regular_or_nothing(path)) return write_in_place(path, text);
  if (succeeds([&] { replace(path, text); })) return true;
  return must_be_kept(errno) && ::access(path.c_str(), F_OK) == 0 && write_in_place(path, text);
}

}  // namespace

bool is_regular_or_nothing(const std::filesystem::path& path) {
  struct stat status = {};
  return ::stat(path.c_str(), &status) != 0 || S_ISREG(status.st_mode);
}

void write_result(const std::string& path, const std::string& text) {
  if (!is_written(path, text)) throw WriteError(path + ": cannot be written: " + reason());
}

void require_writable_file(const std::filesystem::path& file, const std::string& option) {
  std::error_code error;
  if (std::filesystem::is_directory(file, error)) {
    throw UsageError(option + " " + file.string() + ": is a folder; expected a file");
  }
  if (can_write(file.string())) return;
  throw UsageError(option + " " + file.string() + ": cannot be written: " + reason() +
                   "; expected a file in an existing, writable folder");
}

void require_program(const std::filesystem::path& program, const std::string& option) {
  std::error_code error;
  const bool file = std::filesystem::is_regular_file(program, error);
  if (!file || ::access(program.c_str(), X_OK) != 0) {
    throw UsageError(option + " " + program.string() + (file ? ": is not executable" : ": is not an existing file") +
                     "; expected a program that can be started");
  }
}

void make_writable_folder(const std::filesystem::path& folder, const std::string& option) {
  std::error_code error;
  if (!folder.empty()) std::filesystem::create_directories(folder, error);
  if (error) {
    throw UsageError(option + " " + folder.string() + ": cannot be made: " + error.message() +
                     "; expected a folder, or a place for one");
  }
  require_writable_folder(folder.empty() ? "." : folder.string(), option);
}

void require_writable_folder(const std::string& folder, const std::string& option) {
  const std::filesystem::path path(folder);
  std::error_code error;
  const bool exists = std::filesystem::exists(path, error);
  const std::filesystem::path parent = path.has_parent_path() ? path.parent_path() : ".";
  const std::string tried = exists ? path.string() : parent.string();
  errno = ENOTDIR;
  if (std::filesystem::is_directory(tried, error) && can_make_files(tried)) return;
  throw UsageError(option + " " + folder + ": cannot be written: " + reason() +
                   "; expected a writable folder, or a place for one");
}

std::filesystem::path place_of(std::filesystem::path path) {
  std::error_code error;
  for (int links = 0; links < 40 && std::filesystem::is_symlink(path, error); ++links) {
    const std::filesystem::path to = std::filesystem::read_symlink(path, error);
    path = to.is_absolute() ? to : path.parent_path() / to;
  }
  const std::filesystem::path place = std::filesystem::weakly_canonical(std::filesystem::absolute(path, error), error);
  if (error) return path;
  return place.has_filename() ? place : place.parent_path();  // without a slash at the end
}

}  // namespace noli
