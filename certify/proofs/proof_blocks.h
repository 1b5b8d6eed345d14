// SPDX-License-Identifier: Apache-2.0
//
// A proof (proofs/FORMAT.md) taken apart into its blocks, and put together again with whatever in it was changed:
// lengths, checksums and hashes are those of the blocks as they are now.
//
// What this does not do: it does not know what the blocks mean (proof_mutations.h does).
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "trajectory/blocks/block_file.h"

namespace noli {

struct ProofBlock {
  FourLetters kind = 0;
  std::string payload;
  friend bool operator==(const ProofBlock&, const ProofBlock&) = default;
};

/// What one commit closes.
using ProofGroup = std::vector<ProofBlock>;
using ProofGroups = std::vector<ProofGroup>;

/// The groups of a whole proof. Throws InputError, naming `name`, when it is no block file, is damaged, or ends in an
/// open group.
ProofGroups parse_proof(std::string bytes, const std::string& name);

/// What is written wrong on purpose.
struct Spoiled {
  enum class What : std::uint8_t { nothing, number, group_hash, running_hash, no_commit } what = What::nothing;
  std::size_t group = 0;
};

/// The bytes of the file.
std::string proof_bytes(const ProofGroups& groups, const Spoiled& spoiled = {});

/// An integer in groups of seven bits, and one with a sign: proofs/FORMAT.md, section 2.
std::string uint_bytes(std::uint64_t value);
std::string sint_bytes(std::int64_t value);

}  // namespace noli
