// SPDX-License-Identifier: Apache-2.0
//
// Describes what `noli verify --shard` did: how far one part of the steps got. It gives no verdict on all steps.
#pragma once

#include "certify/shards/shards.h"
#include "report/answer.h"

namespace noli::report {

/// `step_word`: "step" or "window", as messages about this motion say.
Answer shard_answer(const ShardWork& work, const ShardOutcome& outcome, const char* step_word);

}  // namespace noli::report
