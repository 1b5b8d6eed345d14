// SPDX-License-Identifier: Apache-2.0
//
// What stands for `noli fuzz` and `noli audit` in a noli that is built without them (NOLI_WITH_AUDIT=OFF).
#include "app/commands.h"

#include <noli/errors.h>

namespace noli::app {

bool has_audits() { return false; }

std::vector<Command> add_audits(CLI::App& app) {
  std::vector<Command> commands;
  for (const char* name : {"fuzz", "audit"}) {
    CLI::App* const command = app.add_subcommand(name, "(not in this noli: it was built with NOLI_WITH_AUDIT=OFF)");
    command->allow_extras();
    commands.push_back({command, []() -> ExitCode {
                          throw UsageError(
                              "this noli was built without `fuzz` and `audit`; build it with NOLI_WITH_AUDIT=ON");
                        }});
  }
  return commands;
}

}  // namespace noli::app
