// SPDX-License-Identifier: Apache-2.0
//
// What was found in a step as JSON, and back: every number as it was.
#pragma once

#include <noli/sequence.h>
#include <noli/verify.h>
#include "certify/json.h"

namespace noli {

/// When a step begins and ends: of a run in seconds.
struct StepTimes {
  double begin = 0, end = 1;
};

/// Without the proof.
Json step_json(const StepResult& result);
Json near_json(const TooNear& near, bool witnessed);

/// Throw Json::exception for what the functions above do not write, and std::invalid_argument for numbers that no
/// result about this mesh and these times has.
StepResult step_of_json(const Json& json, const Mesh& mesh, StepTimes times);
ListedNear near_of_json(const Json& json, const Mesh& mesh);

}  // namespace noli
