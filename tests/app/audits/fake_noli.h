// SPDX-License-Identifier: Apache-2.0
//
// Programs that are `noli`, but for one fault: what audits of `noli` have to find.
#pragma once

#include <filesystem>
#include <string>

#include "tests/app/scene.h"

namespace noli::app_tests {

/// A script that does what `noli` does, unless `body` has ended before. In it $NOLI is the real one, $1, $2, ... the
/// words of the command line, $ALL all of them in one.
inline std::string fake_noli(const Folder& folder, const std::string& body) {
  const std::string path = folder.write("noli", std::string("#!/bin/sh\nNOLI='") + NOLI_COMMAND + "'\nALL=\" $* \"\n" +
                                                    body + "\nexec \"$NOLI\" \"$@\"\n");
  namespace fs = std::filesystem;
  fs::permissions(path, fs::perms::owner_all);
  // The checkers lie beside it, as they do beside the real one.
  for (const char* const checker : {"noli_check", "noli_check_verified"}) {
    const fs::path real = fs::path(NOLI_COMMAND).parent_path() / checker, here = folder.path(checker);
    if (fs::exists(real) && !fs::exists(here)) fs::create_symlink(real, here);
  }
  return path;
}

}  // namespace noli::app_tests
