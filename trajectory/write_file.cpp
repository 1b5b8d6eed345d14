// SPDX-License-Identifier: Apache-2.0
#include "trajectory/write_file.h"

#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <system_error>

#include "trajectory/replaced_file.h"

namespace noli {
namespace {

void require_file_or_nothing(const std::filesystem::path& path) {
  const std::filesystem::file_status there = std::filesystem::symlink_status(path);
  if (!std::filesystem::exists(there) || std::filesystem::is_regular_file(there)) return;
  throw std::system_error(std::make_error_code(std::errc::invalid_argument), path.string() + ": is not a regular file");
}

}  // namespace

void write_file(const std::filesystem::path& path, std::string_view bytes) {
  errno = 0;
  std::ofstream out(path, std::ios::binary);
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  out.close();
  if (!out) throw std::system_error(errno, std::generic_category(), path.string());
}

void replace_file(const std::filesystem::path& path, std::string_view bytes) {
  require_file_or_nothing(path);
  ReplacedFile file(path);
  file.write(bytes);
  file.take_name();
}

bool write_all(int descriptor, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t count = ::write(descriptor, bytes.data(), bytes.size());
    if (count < 0 && errno != EINTR) return false;
    if (count > 0) bytes.remove_prefix(static_cast<std::size_t>(count));
  }
  return true;
}

}  // namespace noli
