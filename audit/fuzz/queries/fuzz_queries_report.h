// SPDX-License-Identifier: Apache-2.0
//
// What `noli fuzz queries` says: of the kernel against the oracle, and of a library against the kernel.
#pragma once

#include <string>

#include "audit/fuzz/queries/fuzz_library.h"
#include "audit/fuzz/queries/fuzz_queries.h"
#include "certify/json.h"
#include "report/answer.h"

namespace noli::audit {

report::Answer fuzz_answer(const QueryFuzzOptions& options, const QueryFuzzReport& report, double seconds);
Json fuzz_json(const QueryFuzzOptions& options, const QueryFuzzReport& report, double seconds);

report::Answer library_fuzz_answer(const LibraryFuzzOptions& options, const LibraryFuzzReport& report, double seconds);
Json library_fuzz_json(const LibraryFuzzOptions& options, const LibraryFuzzReport& report, double seconds);

}  // namespace noli::audit
