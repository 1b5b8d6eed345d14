// SPDX-License-Identifier: Apache-2.0
#include "trajectory/write_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <fstream>
#include <string>
#include <system_error>

#include "trajectory/blocks/block_sink.h"

namespace noli {
namespace {

namespace fs = std::filesystem;

/// Creates an empty file under a free name in this folder. An existing file may belong to another process, or to one
/// that was killed. The name is short, so that it is not too long when the target's name is not.
fs::path new_file(const fs::path& folder) {
  for (std::uint64_t number = 0;; ++number) {
    fs::path path = folder / (".noli-" + std::to_string(number));
    const int descriptor = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor >= 0) {
      ::close(descriptor);
      return path;
    }
    if (errno != EEXIST) throw std::system_error(errno, std::generic_category(), path.string());
  }
}

void require_file_or_nothing(const fs::path& path) {
  const fs::file_status there = fs::symlink_status(path);
  if (!fs::exists(there) || fs::is_regular_file(there)) return;
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
  const fs::path part = new_file(path.parent_path());
  try {
    FileSink sink(part, FileSink::Open::existing);
    sink.write(bytes);
    sink.sync();
    fs::rename(part, path);
  } catch (...) {
    std::error_code ignored;
    fs::remove(part, ignored);
    throw;
  }
  sync_folder(path.parent_path());
}

}  // namespace noli
