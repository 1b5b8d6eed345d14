// SPDX-License-Identifier: Apache-2.0
#include "noli/app/scratch_folder.h"

#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <system_error>

namespace noli::app {
namespace {

namespace fs = std::filesystem;

fs::path best_place() {
  const fs::path memory = "/dev/shm";
  return ::access(memory.c_str(), W_OK | X_OK) == 0 ? memory : fs::temp_directory_path();
}

}  // namespace

ScratchFolder::ScratchFolder() {
  std::string name = best_place() / "noli-scratch-XXXXXX";  // for mkdtemp to fill in
  if (::mkdtemp(name.data()) == nullptr) throw std::system_error(errno, std::generic_category(), name);
  path_ = name;
}

ScratchFolder::~ScratchFolder() {
  std::error_code error;
  fs::remove_all(path_, error);
}

}  // namespace noli::app
