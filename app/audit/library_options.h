// SPDX-License-Identifier: Apache-2.0
//
// The options of the fuzzers that ask somebody else's library of collision detection, in the same words.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <string>
#include <vector>

#include "audit/ccd/library_answers.h"

namespace noli::app {

/// --library, --tolerance, --exact, --query-limit, --memory-limit, --sandbox, --first-only.
struct LibraryArguments {
  audit::LibraryUnderTest asked;  ///< path empty: none
  std::uint64_t megabytes = 2000;
  std::string query_limit = "1s";
  bool first_only = false;

  bool asks_a_library() const { return !asked.path.empty(); }
};

/// --sandbox, for all commands that load a library.
CLI::Option* add_sandbox_option(CLI::App& command, bool& sandbox);

/// `instead`: what is not asked then, "the kernel".
void add_library_options(CLI::App& command, LibraryArguments& arguments, const std::string& instead);

/// Fills in how libraries are run: --query-limit, --memory-limit, until an interruption. Throws UsageError.
void settle_host(audit::HostOptions& host, const std::string& query_limit, std::uint64_t megabytes);

/// Fills in how the library is run. Throws UsageError.
void settle_library(LibraryArguments& arguments);

/// The options that ask the same library in the same way; none if there is none.
std::vector<std::string> library_words(const LibraryArguments& arguments);

}  // namespace noli::app
