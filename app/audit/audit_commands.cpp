// SPDX-License-Identifier: Apache-2.0
//
// The commands below `noli fuzz` and `noli audit`.
#include "app/commands.h"

namespace noli::app {

bool has_audits() { return true; }

std::vector<Command> add_audits(CLI::App& app) {
  CLI::App& fuzz = *app.add_subcommand("fuzz", "Look for wrong answers with adversarial input");
  fuzz.require_subcommand(1);
  fuzz.footer(
      "Examples:\n"
      "  noli fuzz queries --library ./mine.so --for 60s     a collision library against the truth\n"
      "  noli fuzz queries --for 60s --seed 1                the kernel of noli itself\n"
      "  noli fuzz trajectories --for 60s --seed 1\n"
      "  noli fuzz scenes --for 60s --seed 1\n"
      "  noli fuzz proofs --for 60s --seed 1\n");
  CLI::App& audit = *app.add_subcommand("audit", "Measure how far a library or a number can be trusted");
  audit.require_subcommand(1);
  audit.footer(
      "Examples:\n"
      "  noli audit ccd --library ./mine.so queries-edge-edge.csv\n"
      "  noli audit precision scenes/bounce.json --short\n"
      "  noli audit integrator --svg integrator.svg     error against run time\n"
      "  noli audit stability                           extreme scenes, and how they end\n"
      "  noli audit self                                everything noli can check about itself\n");
  return {add_fuzz_queries(fuzz),      add_fuzz_trajectories(fuzz), add_fuzz_proofs(fuzz),
          add_fuzz_scenes(fuzz),       add_audit_ccd(audit),        add_audit_precision(audit),
          add_audit_integrator(audit), add_audit_self(audit),       add_audit_stability(audit)};
}

}  // namespace noli::app
