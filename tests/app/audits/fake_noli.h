// SPDX-License-Identifier: Apache-2.0
//
// Makes programs that behave like `noli` except for one fault, which audits of `noli` must find.
#pragma once

#include <filesystem>
#include <string>

#include "tests/app/scene.h"

namespace noli::app_tests {

/// A script that does what `noli` does, unless `body` exits first. In `body`, $NOLI is the real program, $1, $2, ...
/// are the words of the command line, and $ALL is all of them in one string.
inline std::string fake_noli(const Folder& folder, const std::string& body) {
  const std::string path = folder.write("noli", std::string("#!/bin/sh\nNOLI='") + NOLI_COMMAND + "'\nALL=\" $* \"\n" +
                                                    body + "\nexec \"$NOLI\" \"$@\"\n");
  namespace fs = std::filesystem;
  fs::permissions(path, fs::perms::owner_all);
  // Place the checkers beside it, as beside the real program.
  for (const char* const checker : {"noli_check", "noli_check_verified"}) {
    const fs::path real = fs::path(NOLI_COMMAND).parent_path() / checker, here = folder.path(checker);
    if (fs::exists(real) && !fs::exists(here)) fs::create_symlink(real, here);
  }
  return path;
}

}  // namespace noli::app_tests
