// SPDX-License-Identifier: Apache-2.0
//
// Results of `noli verify` for continuous integration: a JUnit file, and annotations of GitHub Actions.
//
// Notation
//   case         one of JUnit: a step, a frame at rest, or a window. It fails where something touches, and is skipped
//                where it was not decided, with the reason
//   annotation   "::error title=...::message", a line of standard output that GitHub shows beside a run
//
// Sources: the schema of Jenkins' xUnit plugin (junit-10.xsd); "Workflow commands for GitHub Actions", GitHub Docs.
#pragma once

#include <string>

#include <noli/verify.h>

namespace noli::report {

/// The whole document. Deterministic: no times of day, no durations.
std::string verify_junit(const VerifyRequest& request, const VerifyOutcome& outcome);

/// A line for each of the first ten steps in which something touches; one for an answer that is undecided; one notice
/// for nothing touches.
std::string verify_annotations(const VerifyRequest& request, const VerifyOutcome& outcome);

}  // namespace noli::report
