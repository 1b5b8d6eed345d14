// SPDX-License-Identifier: Apache-2.0
//
// What `noli fuzz queries` says: of the kernel against the oracle, and of a library against the kernel.
#pragma once

#include <string>
#include <vector>

#include "audit/fuzz/queries/fuzz_library.h"
#include "audit/fuzz/queries/fuzz_queries.h"
#include "certify/json.h"

namespace noli::audit {

/// Without `timing`. Precondition here and below: the options have the command that asks a finding again.
Json fuzz_json(const QueryFuzzOptions& options, const QueryFuzzReport& report);
std::string fuzz_text(const QueryFuzzOptions& options, const QueryFuzzReport& report);
/// Members of that JSON for the line of --porcelain; the report only selects the overload.
std::vector<std::string> fuzz_pairs(const QueryFuzzReport& report);

Json fuzz_json(const LibraryFuzzOptions& options, const LibraryFuzzReport& report);
std::string fuzz_text(const LibraryFuzzOptions& options, const LibraryFuzzReport& report);
std::vector<std::string> fuzz_pairs(const LibraryFuzzReport& report);

}  // namespace noli::audit
