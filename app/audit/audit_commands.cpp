// SPDX-License-Identifier: Apache-2.0
//
// The commands below `noli fuzz` and `noli audit`.
#include "app/commands.h"

namespace noli::app {

std::vector<Command> add_audits(CLI::App& app) {
  CLI::App& fuzz = *app.add_subcommand("fuzz", "Look for wrong answers with adversarial input");
  fuzz.require_subcommand(1);
  fuzz.footer(
      "Examples:\n"
      "  noli fuzz queries --for 60s --seed 1\n"
      "  noli fuzz queries --library ./mine.so --for 60s\n"
      "  noli fuzz trajectories --for 60s --seed 1\n"
      "  noli fuzz scenes --for 60s --seed 1\n"
      "  noli fuzz proofs --for 60s --seed 1\n"
      "`noli fuzz queries --help` says more.");
  CLI::App& audit = *app.add_subcommand("audit", "How far can numbers, and somebody else's code, be trusted?");
  audit.require_subcommand(1);
  audit.footer(
      "Examples:\n"
      "  noli audit ccd --library ./mine.so queries-edge-edge.csv\n"
      "  noli audit precision scenes/bounce.json --short\n"
      "  noli audit integrator --svg integrator.svg     error against run time\n"
      "  noli audit stability                           how far it goes, and how it ends there\n"
      "  noli audit self                                all that noli has to look at itself with\n"
      "`noli audit ccd --help` says more, and so for each.");
  return {add_fuzz_queries(fuzz),      add_fuzz_trajectories(fuzz), add_fuzz_proofs(fuzz),
          add_fuzz_scenes(fuzz),       add_audit_ccd(audit),        add_audit_precision(audit),
          add_audit_integrator(audit), add_audit_self(audit),       add_audit_stability(audit)};
}

}  // namespace noli::app
