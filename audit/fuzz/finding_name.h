// SPDX-License-Identifier: Apache-2.0
//
// What a finding is saved as. Names tell where in a run it was found, so another run may find something else under the
// same name: what an earlier one has saved is nobody's to overwrite.
#pragma once

#include <filesystem>
#include <string>

namespace noli::audit {

/// `wanted`, or, where there is something of that name already, the first of "2-NAME", "3-NAME", ... that there is not.
/// Who asks makes it before the next one asks.
inline std::filesystem::path unused(const std::filesystem::path& wanted) {
  std::filesystem::path name = wanted;
  for (int number = 2; std::filesystem::exists(std::filesystem::symlink_status(name)); ++number) {
    name = wanted.parent_path() / (std::to_string(number) + "-" + wanted.filename().string());
  }
  return name;
}

}  // namespace noli::audit
