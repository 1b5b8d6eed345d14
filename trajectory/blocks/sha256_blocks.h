// SPDX-License-Identifier: Apache-2.0
//
// The compression function of SHA-256 (FIPS 180-4, section 6.2.2). Internal to sha256.cpp and its tests.
//
// There are two implementations: plain C++, and the processor's instructions for SHA-256 (nine times as fast). A run
// hashes every breakpoint that it records.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace noli {

using Sha256State = std::array<std::uint32_t, 8>;

/// Adds whole blocks of 64 bytes to the state, in the fastest way that this processor has.
void sha256_blocks(Sha256State& state, std::string_view blocks);

void sha256_blocks_plain(Sha256State& state, std::string_view blocks);

/// Whether this processor has the instructions; and the implementation with them, whose precondition this is.
bool has_sha_instructions();
void sha256_blocks_by_instructions(Sha256State& state, std::string_view blocks);

}  // namespace noli
