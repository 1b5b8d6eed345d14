// SPDX-License-Identifier: Apache-2.0
#include "noli/trajectory/write_file.h"

#include <cerrno>
#include <fstream>
#include <system_error>

#include "noli/trajectory/block_sink.h"

namespace noli {

void write_file(const std::filesystem::path& path, std::string_view bytes) {
  errno = 0;
  std::ofstream out(path, std::ios::binary);
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  out.close();
  if (!out) throw std::system_error(errno, std::generic_category(), path.string());
}

void replace_file(const std::filesystem::path& path, std::string_view bytes) {
  std::filesystem::path part = path;
  part += ".part";
  std::error_code ignored;  // most often there is none to be removed
  std::filesystem::remove(part, ignored);
  try {
    FileSink sink(part, FileSink::Open::create);
    sink.write(bytes);
    sink.sync();
    std::filesystem::rename(part, path);
  } catch (...) {
    std::filesystem::remove(part, ignored);
    throw;
  }
  sync_folder(path.parent_path());
}

}  // namespace noli
