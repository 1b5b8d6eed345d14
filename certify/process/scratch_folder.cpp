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

ScratchFolder::ScratchFolder(Place place) : ScratchFolder(path_of(place)) {}

ScratchFolder::ScratchFolder(const fs::path& parent) : process_(::getpid()) {
  const bool there = ::access(parent.c_str(), W_OK | X_OK) == 0;
  std::string name = ((there ? parent : path_of(Place::disk)) / "noli-scratch-XXXXXX").string();
  // mkdtemp needs the last letters, and replaces them.
  if (::mkdtemp(name.data()) == nullptr) throw std::system_error(errno, std::generic_category(), name);
  path_ = name;
}

ScratchFolder::~ScratchFolder() {
  if (process_ != ::getpid()) return;
  std::error_code error;  // what cannot be removed stays
  fs::remove_all(path_, error);
}

}  // namespace noli
