// SPDX-License-Identifier: Apache-2.0
//
// Asks somebody else's library of continuous collision detection (include/noli/ccd_plugin.h) in a process of its own. A
// crash, a call that does not come back, or one that takes all memory costs that process; the next one goes on behind
// the query that did it. With HostOptions::in_process, asks it in this process, which nothing then protects.
//
// What this does not do: it does not know what is right (audit/ccd/ccd_audit.h).
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "audit/ccd/host/exchange.h"
#include "audit/ccd/host_process.h"

namespace noli::audit {

/// Throws InputError, which says what it is that is not there or not as it has to be: no file, no shared library, one
/// for another machine, one that cannot be loaded, one without the functions or of another version of them.
void require_ccd_library(const std::filesystem::path& library, const HostOptions& options);

/// What one library answered to the queries of one file.
struct LibraryAnswers {
  std::vector<GivenAnswer> answers;  ///< one for each query
  std::vector<std::string> endings;  ///< of the process at a query, in words: "signal 11"; "" where it did not end
  std::uint64_t crashes = 0, hangs = 0, memory = 0;  ///< repetitions included
  double ns_per_query = 0;     ///< mean of a pass, median of passes; of the first answers where there was no whole pass
  std::uint64_t repeated = 0;  ///< calls during which memory was watched
  std::int64_t growth = 0;     ///< of memory during these, bytes
  bool leaks = false;          ///< it grew in either half of them
  std::string said;            ///< the end of what the last process that said something wrote to its standard error
  std::string description;     ///< what the library says that it is; "" if it says nothing
  bool complete = true;        ///< false: stopped, out of time, or given up
};

/// Asks all of them. Without a library: the textbook method. Precondition: require_ccd_library(library) has not thrown,
/// so that whatever ends a process is the library's doing. Throws std::system_error when the machine has no process or
/// memory left, std::runtime_error when the host is not there.
LibraryAnswers ask_library(const std::optional<std::filesystem::path>& library, int kind,
                           const std::vector<AskedQuery>& queries, double tolerance, const HostOptions& options);

}  // namespace noli::audit
