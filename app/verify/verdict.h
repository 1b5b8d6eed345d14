// SPDX-License-Identifier: Apache-2.0
//
// Answers a request for a verdict, whoever decides the steps: verifies, has the proof checked, writes all results.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "app/exit_code.h"
#include "app/output.h"
#include "certify/verify_work.h"

namespace noli::app {

/// What is written beside the words.
struct VerdictOutputs {
  std::optional<std::filesystem::path> claim_out, junit;
  bool github = false;  ///< annotations for GitHub Actions on standard output
  OutputOptions results;
};

/// The files that are written beside the JSON. Throws UsageError for "-", which none of them can be.
std::vector<OutputFile> files_of(const VerifyWork& request, const VerdictOutputs& outputs);

/// Frames of one mesh, or a run. Throws as run_verify() and ProofRoute::check().
ExitCode answer(VerifyWork& request, const VerdictOutputs& outputs, const Output& output);

ExitCode exit_code(Verdict verdict);

}  // namespace noli::app
