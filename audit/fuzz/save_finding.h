// SPDX-License-Identifier: Apache-2.0
//
// How findings are saved. A name says where in a run the finding was made, so another run can use the same name for
// another finding: existing files are never overwritten. A folder is saved whole or not at all, because a part of it
// would look like a finding and show something else.
#pragma once

#include <fmt/format.h>
#include <unistd.h>

#include <filesystem>
#include <string>
#include <system_error>
#include <vector>

#include "certify/process/run_program.h"
#include "trajectory/write_file.h"

namespace noli::audit {

/// `wanted`, or the first of "2-NAME", "3-NAME", ... that does not exist. Create it before you call this again.
inline std::filesystem::path unused(const std::filesystem::path& wanted) {
  std::filesystem::path name = wanted;
  for (int number = 2; std::filesystem::exists(std::filesystem::symlink_status(name)); ++number) {
    name = wanted.parent_path() / (std::to_string(number) + "-" + wanted.filename().string());
  }
  return name;
}

/// `write` fills a temporary folder beside this one; a README with the difference and the command that reproduces it is
/// added. Then the folder takes this name and replaces what was there. If anything throws, the old folder stays and the
/// temporary one is removed.
template <class Write>
void save_whole(const std::filesystem::path& folder, const std::string& what, const std::vector<std::string>& command,
                const Write& write) {
  namespace fs = std::filesystem;
  const std::string name = "." + folder.filename().string() + "." + std::to_string(::getpid());
  const fs::path part = folder.parent_path() / name;
  try {
    fs::create_directories(part);
    write(part);
    write_file(part / "README", fmt::format("{}\nShown again by\n  {}\n", what, shell_words(command)));
    fs::remove_all(folder);
    fs::rename(part, folder);
  } catch (...) {
    std::error_code ignored;  // what cannot be removed stays
    fs::remove_all(part, ignored);
    throw;
  }
}

}  // namespace noli::audit
