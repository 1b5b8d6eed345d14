// SPDX-License-Identifier: Apache-2.0
#include "noli/audit/scratch_folder.h"

#include <cerrno>
#include <cstdlib>
#include <system_error>

namespace noli::audit {

namespace fs = std::filesystem;

ScratchFolder::ScratchFolder() {
  std::string name = (fs::temp_directory_path() / "noli-audit-XXXXXX").string();
  if (::mkdtemp(name.data()) == nullptr) throw std::system_error(errno, std::generic_category(), name);
  path_ = name;
}

ScratchFolder::~ScratchFolder() {
  std::error_code error;  // what cannot be removed stays
  fs::remove_all(path_, error);
}

}  // namespace noli::audit
