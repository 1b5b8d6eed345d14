// SPDX-License-Identifier: Apache-2.0
//
// What was found in a step as JSON, and back: every number as it was.
#pragma once

#include <noli/sequence.h>
#include <noli/verify.h>
#include "certify/json.h"

namespace noli {

/// Without the proof.
Json step_json(const StepResult& result);
Json near_json(const TooNear& near, bool witnessed);

/// `last`: the greatest time that a step may have. Throw Json::exception for what the functions above do not write, and
/// std::invalid_argument for numbers that no result about this mesh has.
StepResult step_of_json(const Json& json, const Mesh& mesh, double last);
ListedNear near_of_json(const Json& json, const Mesh& mesh, double last);

}  // namespace noli
