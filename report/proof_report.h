// SPDX-License-Identifier: Apache-2.0
//
// What a proof says of itself, as JSON for `noli info`.
#pragma once

#include <filesystem>

#include <noli/proof.h>
#include "certify/json.h"

namespace noli::report {

/// One of the "files" of `noli info`. `file`: where the proof is.
Json proof_info_json(const std::filesystem::path& file, const ProofInfo& info);

}  // namespace noli::report
