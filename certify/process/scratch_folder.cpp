// SPDX-License-Identifier: Apache-2.0
#include "certify/process/scratch_folder.h"

#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <string>
#include <system_error>

namespace noli {
namespace {

namespace fs = std::filesystem;

fs::path path_of(ScratchFolder::Place place) {
  fs::path memory = "/dev/shm";
  const bool there = place == ScratchFolder::Place::memory && ::access(memory.c_str(), W_OK | X_OK) == 0;
  if (there) return memory;
  try {
    return fs::temp_directory_path();
  } catch (const fs::filesystem_error& error) {  // its message does not name the folder
    throw std::system_error(error.code(), "the folder for temporary files (TMPDIR), " + error.path1().string());
  }
}

}  // namespace

ScratchFolder::ScratchFolder(Place place) {
  std::string name =
      (path_of(place) / "noli-scratch-XXXXXX").string();  // mkdtemp needs these letters, and replaces them
  if (::mkdtemp(name.data()) == nullptr) throw std::system_error(errno, std::generic_category(), name);
  path_ = name;
}

ScratchFolder::~ScratchFolder() {
  std::error_code error;  // what cannot be removed stays
  fs::remove_all(path_, error);
}

}  // namespace noli
