// SPDX-License-Identifier: Apache-2.0
//
// Describes, as text and as JSON, a finding of a fuzzer, and a saved item that was judged again.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "audit/fuzz/fuzzing.h"
#include "certify/json.h"
#include "report/answer.h"

namespace noli::audit {

/// "finding: GENERATOR, block 3, scene 7: DIFFERENCE; saved as PLACE", one line; `item` is "scene", and `more` comes
/// before the difference.
std::string finding_line(const FuzzFinding& finding, const char* item, const std::string& more = "");

/// {"generator": "", "block": 3, ...}. `place`: the JSON member with the path of the finding.
Json finding_json(const FuzzFinding& finding, const char* place);

/// The result of judging a saved item again.
struct ReplayResult {
  bool unknown = false;                        ///< interrupted, or not decided
  std::optional<std::string> difference;       ///< what is wrong with it
  std::optional<std::filesystem::path> saved;  ///< where the smaller one is
  Json facts;                                  ///< an object with further members
  std::vector<std::string> pairs;              ///< members of `facts` that the answer shows
  std::string text = {}, about_saved = {};     ///< above the difference; behind the name of what was saved
};

/// Schema "fuzz-replay". `place`: the JSON member with the path of what was saved.
Json replay_json(const ReplayResult& judged, const char* place);

/// `json`: what replay_json() returned for this result.
report::Answer replay_answer(const Json& json, const ReplayResult& judged);

}  // namespace noli::audit
