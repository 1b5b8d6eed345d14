// SPDX-License-Identifier: Apache-2.0
#include "trajectory/regular_file.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <system_error>

#include "trajectory/error.h"

namespace noli {

void require_regular_file(const std::filesystem::path& path) {
  std::error_code ignored;
  const std::filesystem::file_status there = std::filesystem::status(path, ignored);
  if (!std::filesystem::exists(there) || std::filesystem::is_regular_file(there)) return;
  throw InputError(path.string(), "", "is no regular file; expected one");
}

std::ifstream open_regular_file(const std::filesystem::path& path) {
  require_regular_file(path);
  errno = 0;
  std::ifstream in(path, std::ios::binary);
  if (!in) throw InputError(path.string(), "", fmt::format("cannot be opened: {}", std::strerror(errno)));
  return in;
}

}  // namespace noli
