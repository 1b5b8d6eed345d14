// SPDX-License-Identifier: Apache-2.0
#include "certify/process/unfinished_file.h"

#include <fmt/format.h>

#include <random>
#include <system_error>

#include "trajectory/blocks/block_sink.h"

namespace noli {

UnfinishedFile::UnfinishedFile(const std::filesystem::path& file) : file_(file) {
  std::random_device random;
  path_ = file.string() + fmt::format(".{:08x}{:08x}.part", random(), random());
}

UnfinishedFile::~UnfinishedFile() {
  std::error_code error;
  std::filesystem::remove(path_, error);
}

void UnfinishedFile::finish() const {
  std::filesystem::rename(path_, file_);
  sync_folder(file_.parent_path());
}

}  // namespace noli
