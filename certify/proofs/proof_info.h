// SPDX-License-Identifier: Apache-2.0
//
// Summarises a proof (proofs/FORMAT.md) for `noli info`: its claim, its times, and its size.
//
// It checks only that the blocks are whole; `noli check` checks the proof.
#pragma once

#include <filesystem>

#include "certify/json.h"

namespace noli {

/// Whether the file begins like a proof. False if it cannot be read.
bool is_proof(const std::filesystem::path& path);

/// Holds one block at a time. Throws InputError when the file is damaged, or its blocks are not those of a proof.
Json proof_info(const std::filesystem::path& path);

}  // namespace noli
