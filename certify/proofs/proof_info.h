// SPDX-License-Identifier: Apache-2.0
//
// What `noli info` tells of a proof (proofs/FORMAT.md): what it claims, of which times, in how many bytes.
//
// What this does not do: it checks nothing but that the blocks are whole; `noli check` checks what they say.
#pragma once

#include <filesystem>

#include "certify/json.h"

namespace noli {

/// Whether the file begins as a proof. False where it cannot be read.
bool is_proof(const std::filesystem::path& path);

/// Holds one block at a time. Throws InputError when the file is damaged, or its blocks are none of a proof.
Json proof_info(const std::filesystem::path& path);

}  // namespace noli
