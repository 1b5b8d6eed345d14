// SPDX-License-Identifier: Apache-2.0
//
// `noli verify ... --shard K/N -o SHARDS`: decides one part of the steps, for `noli merge`; and `mpirun noli verify`,
// which does both.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "app/exit_code.h"
#include "app/output.h"
#include "app/verify/verdict.h"
#include "certify/ranks/ranks.h"
#include "certify/shards/shards.h"

namespace noli::app {

/// Decides all steps together with the other ranks of the job; the first one joins and answers. `shards`: the folder,
/// or nothing for the usual one, which is removed once there is an answer. `output`: of the first rank. Throws as
/// verify_shard() and run_verify().
ExitCode answer_in_ranks(VerifyWork& request, const std::optional<std::filesystem::path>& shards, Ranks& ranks,
                         const VerdictOutputs& outputs, const Output* output);

/// Does the work and says how far it got. Throws as verify_shard().
ExitCode answer_shard(VerifyWork& request, const ShardWork& work, const Output& output);

}  // namespace noli::app
