// SPDX-License-Identifier: Apache-2.0
//
// What `noli fuzz queries` says: of the kernel against the oracle, and of a library against the kernel.
#pragma once

#include <string>

#include "app/answer.h"
#include "app/exit_code.h"
#include "app/json.h"
#include "audit/fuzz_library.h"
#include "audit/fuzz_queries.h"

namespace noli::app {

/// An interrupted run is undecided, whatever it has found: the findings are kept and listed.
ExitCode fuzz_exit_code(std::uint64_t findings, std::uint64_t queries, bool interrupted);

Answer fuzz_answer(const audit::FuzzOptions& options, const audit::FuzzReport& report, double seconds);
Json fuzz_json(const audit::FuzzOptions& options, const audit::FuzzReport& report, double seconds);

Answer library_fuzz_answer(const audit::LibraryFuzzOptions& options, const audit::LibraryFuzzReport& report,
                           double seconds);
Json library_fuzz_json(const audit::LibraryFuzzOptions& options, const audit::LibraryFuzzReport& report,
                       double seconds);

}  // namespace noli::app
