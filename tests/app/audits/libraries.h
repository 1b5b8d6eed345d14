// SPDX-License-Identifier: Apache-2.0
//
// The libraries that `noli audit ccd` and `noli fuzz --library` are tested with, and what both fuzzers that ask one
// have to do alike.
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

/// Of tests/app/ccd_libraries/misbehaving.c.
inline std::string faulty(const std::string& name) { return std::string(NOLI_TEST_LIBRARIES) + "/" + name + ".so"; }
/// Of audit/ccd/plugins.
inline std::string plugin(const std::string& name) { return std::string(NOLI_CCD_PLUGINS) + "/" + name + ".so"; }
/// Of tests/app/ccd_libraries/mutants.
inline std::string mutant(const std::string& name) { return std::string(NOLI_MUTANTS) + "/" + name + ".so"; }

/// A command that would go on for long is interrupted after that time, with findings.
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
