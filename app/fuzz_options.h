// SPDX-License-Identifier: Apache-2.0
//
// The options that the fuzzers of motions, scenes and proofs have in common, in the same words, and their verdicts.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "noli/app/exit_code.h"
#include "noli/audit/fuzz_blocks.h"

namespace noli::app {

/// --seed, --count, --for, --threads, --out, --json.
struct FuzzArgumentsInCommon {
  audit::FuzzLimits limits;
  std::optional<std::string> duration;
  std::string out = "fuzz-findings";
  std::optional<std::string> json;
};

/// `what` are the items: "motions".
void add_fuzz_options(CLI::App& command, FuzzArgumentsInCommon& arguments, const std::string& what);

/// Makes limits of what was given: a minute if nothing was. Throws UsageError.
void settle_limits(FuzzArgumentsInCommon& arguments);

/// "finding", "undecided" (interrupted, or nothing was done), "no_finding".
const char* fuzz_verdict(std::uint64_t findings, const audit::FuzzExtent& extent);
ExitCode fuzz_exit_code(std::uint64_t findings, const audit::FuzzExtent& extent);

}  // namespace noli::app
