// SPDX-License-Identifier: Apache-2.0
//
// A finding is saved as a folder of several files, whole or not at all: a part of one (on a full disk) would look like
// a finding, and show something else or nothing.
#pragma once

#include <filesystem>
#include <system_error>

namespace noli::audit {

/// Lets `write` put files into a folder beside this one, and moves them into this one when all are there: what was in
/// it under other names stays. If something throws, nothing is left of them.
template <class Write>
void save_whole(const std::filesystem::path& folder, const Write& write) {
  namespace fs = std::filesystem;
  const fs::path part = folder.string() + ".part";
  try {
    fs::remove_all(part);  // of a process that was killed
    fs::create_directories(part);
    write(part);
    fs::create_directories(folder);
    for (const auto& entry : fs::directory_iterator(part)) fs::rename(entry.path(), folder / entry.path().filename());
    fs::remove(part);
  } catch (...) {
    std::error_code ignored;  // what cannot be removed stays
    fs::remove_all(part, ignored);
    throw;
  }
}

}  // namespace noli::audit
