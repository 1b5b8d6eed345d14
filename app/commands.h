// SPDX-License-Identifier: Apache-2.0
//
// The subcommands of `noli`, one file each. Each function adds its command to the parser and returns what is to be done
// when the user asked for it.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <vector>

#include "app/exit_code.h"

namespace noli::app {

struct Command {
  CLI::App* parser;
  std::function<ExitCode()> run;
};

Command add_verify(CLI::App& app);
Command add_merge(CLI::App& app);
Command add_check(CLI::App& app);
Command add_ccd(CLI::App& app);
Command add_simulate(CLI::App& app);
Command add_explain(CLI::App& app);
Command add_repair(CLI::App& app);
Command add_export(CLI::App& app);
Command add_info(CLI::App& app);
Command add_report(CLI::App& app);
Command add_schema(CLI::App& app);

/// `noli fuzz` and `noli audit` with all that is below them or, where they are not built, what says so.
std::vector<Command> add_audits(CLI::App& app);
/// Whether they are built.
bool has_audits();

// Below `noli fuzz` and `noli audit`.
Command add_fuzz_queries(CLI::App& fuzz);
Command add_fuzz_trajectories(CLI::App& fuzz);
Command add_fuzz_proofs(CLI::App& fuzz);
Command add_fuzz_scenes(CLI::App& fuzz);
Command add_audit_ccd(CLI::App& audit);
Command add_audit_precision(CLI::App& audit);
Command add_audit_integrator(CLI::App& audit);
Command add_audit_self(CLI::App& audit);
Command add_audit_stability(CLI::App& audit);

}  // namespace noli::app
