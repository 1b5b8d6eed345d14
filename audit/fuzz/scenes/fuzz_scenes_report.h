// SPDX-License-Identifier: Apache-2.0
//
// Writes the results of `noli fuzz scenes`: text and JSON of a run, and facts about a saved scene that is judged again.
#pragma once

#include <string>
#include <vector>

#include "audit/fuzz/scenes/fuzz_scenes.h"
#include "certify/json.h"

namespace noli::audit {

/// Without `timing`.
Json fuzz_json(const SceneFuzzOptions& options, const SceneFuzzReport& report);
std::string fuzz_text(const SceneFuzzOptions& options, const SceneFuzzReport& report);
/// Members of that JSON for the line of --porcelain; the report only selects the overload.
std::vector<std::string> fuzz_pairs(const SceneFuzzReport& report);

/// How its simulation ended, and what was done after it.
Json scene_facts(const SceneJudgement& judgement);

}  // namespace noli::audit
