// SPDX-License-Identifier: Apache-2.0
//
// A finding is saved as a folder of several files, whole or not at all: a part of one (on a full disk) would look like
// a finding, and show something else or nothing.
#pragma once

#include <unistd.h>

#include <filesystem>
#include <string>
#include <system_error>

namespace noli::audit {

/// Lets `write` put files into a folder beside this one, which takes its name when all are there. What was saved under
/// that name before goes then; if something throws, it stays, and nothing is left of the new one.
template <class Write>
void save_whole(const std::filesystem::path& folder, const Write& write) {
  namespace fs = std::filesystem;
  const std::string name = "." + folder.filename().string() + "." + std::to_string(::getpid());
  const fs::path part = folder.parent_path() / name;
  try {
    fs::create_directories(part);
    write(part);
    fs::remove_all(folder);
    fs::rename(part, folder);
  } catch (...) {
    std::error_code ignored;  // what cannot be removed stays
    fs::remove_all(part, ignored);
    throw;
  }
}

}  // namespace noli::audit
