// SPDX-License-Identifier: Apache-2.0
//
// How findings are saved. Their names tell where in a run they were found, so another run may find something else under
// the same name: what an earlier one has saved is nobody's to overwrite. A folder of several files is saved whole or
// not at all: a part of one (on a full disk) would look like a finding, and show something else or nothing.
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

/// `wanted`, or, where there is something of that name already, the first of "2-NAME", "3-NAME", ... that there is not.
/// Who asks makes it before the next one asks.
inline std::filesystem::path unused(const std::filesystem::path& wanted) {
  std::filesystem::path name = wanted;
  for (int number = 2; std::filesystem::exists(std::filesystem::symlink_status(name)); ++number) {
    name = wanted.parent_path() / (std::to_string(number) + "-" + wanted.filename().string());
  }
  return name;
}

/// Lets `write` put files into a folder beside this one, which takes its name when all are there, with a README: what
/// is wrong, and the command that shows it again. What was saved under that name before goes then; if something throws,
/// it stays, and nothing is left of the new one.
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
