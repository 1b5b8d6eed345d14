// SPDX-License-Identifier: Apache-2.0
//
// Writes a finding of a fuzzer as a line of text and as JSON.
#pragma once

#include <string>

#include "audit/fuzz/fuzzing.h"
#include "certify/json.h"

namespace noli::audit {

/// "finding: GENERATOR, block 3, scene 7: DIFFERENCE; saved as PLACE", one line; `item` is "scene", and `more` comes
/// before the difference.
std::string finding_line(const FuzzFinding& finding, const char* item, const std::string& more = "");

/// {"generator": "", "block": 3, ...}. `place`: the JSON member with the path of the finding.
Json finding_json(const FuzzFinding& finding, const char* place);

}  // namespace noli::audit
