// SPDX-License-Identifier: Apache-2.0
//
// Tests the messages of cmake/NoliCcdLibraries.cmake for missing third-party libraries. It runs as a script, so nothing
// needs to be configured.
#include <gtest/gtest.h>

#include <string>

#include "workspace.h"

namespace noli::repository {
namespace {

CommandResult look_for_libraries(const std::string& options) {
  const std::string script = std::string(NOLI_SOURCE_DIR) + "/cmake/NoliCcdLibraries.cmake";
  return run(quoted(NOLI_CMAKE) +
             " -DCMAKE_DISABLE_FIND_PACKAGE_fcl=TRUE -DCMAKE_DISABLE_FIND_PACKAGE_ipc_toolkit=TRUE " + options +
             " -P " + quoted(script) + " 2>&1");
}

void refused(const std::string& options, const std::string& words) {
  const auto [exit_code, output] = look_for_libraries(options);
  EXPECT_EQ(exit_code, 1) << options;
  EXPECT_NE(output.find(words), std::string::npos) << output;
}

TEST(CcdLibraries, AreNotNeeded) {
  const auto [exit_code, output] = look_for_libraries("");
  EXPECT_EQ(exit_code, 0) << output;
  EXPECT_EQ(output, "");
}

TEST(CcdLibraries, ThatAreAskedForAndNotThereAreMissed) {
  refused("-DNOLI_WITH_FCL=ON", "NOLI_WITH_FCL is ON, but there is no FCL");
  refused("-DNOLI_WITH_FCL=ON", "libfcl-dev");
  refused("-DNOLI_WITH_IPC_TOOLKIT=ON", "NOLI_WITH_IPC_TOOLKIT is ON, but there is no IPC Toolkit");
  refused("-DNOLI_WITH_IPC_TOOLKIT=ON", "NOLI_IPC_TOOLKIT_SOURCE");
  refused("-DNOLI_WITH_IPC_TOOLKIT=ON -DNOLI_IPC_TOOLKIT_SOURCE=/no/such/folder",
          "NOLI_IPC_TOOLKIT_SOURCE is '/no/such/folder'; expected a folder");
}

}  // namespace
}  // namespace noli::repository
