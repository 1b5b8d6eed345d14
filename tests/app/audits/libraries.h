// SPDX-License-Identifier: Apache-2.0
//
// Names the libraries that test `noli audit ccd` and `noli fuzz --library`, and defines the expectations that both
// fuzzers of libraries share.
#pragma once

#include <chrono>
#include <csignal>
#include <string>
#include <vector>

#include "tests/app/process.h"

namespace noli::app_tests {

using Words = std::vector<std::string>;

inline Words operator+(Words a, const Words& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

/// A library built from tests/app/ccd_libraries/misbehaving.c.
inline std::string faulty(const std::string& name) { return std::string(NOLI_TEST_LIBRARIES) + "/" + name + ".so"; }
/// A plug-in of audit/ccd/plugins.
inline std::string plugin(const std::string& name) { return std::string(NOLI_CCD_PLUGINS) + "/" + name + ".so"; }
/// A mutant of tests/app/ccd_libraries/mutants.
inline std::string mutant(const std::string& name) { return std::string(NOLI_MUTANTS) + "/" + name + ".so"; }

/// Interrupts a long-running command after the given time and expects that its findings are saved.
inline void expect_findings_kept(const Words& words, std::chrono::milliseconds after) {
  ProcessOptions options;
  options.signal = SIGINT;
  options.signal_after = after;
  const Process process = run_noli(words, options);
  EXPECT_EQ(process.exit_code, 2) << process.err;
  EXPECT_EQ(process.verdict_line().rfind("UNDECIDED ", 0), 0u) << process.out;
  EXPECT_NE(process.out.find("saved as "), std::string::npos) << process.out;
}

inline void expect_refused(const Words& words, const std::string& because) {
  const Process process = run_noli(words);
  EXPECT_EQ(process.exit_code, 3) << because << process.out;
  EXPECT_NE(process.err.find(because), std::string::npos) << process.err;
}

}  // namespace noli::app_tests
