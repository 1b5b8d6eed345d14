// SPDX-License-Identifier: Apache-2.0
//
// Takes a proof (proofs/FORMAT.md) apart into its blocks, and puts changed blocks together again with the right
// lengths, checksums and hashes.
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

/// The blocks that one commit closes.
using ProofGroup = std::vector<ProofBlock>;
using ProofGroups = std::vector<ProofGroup>;

/// The groups of a whole proof. Throws InputError, naming `name`, when it is not a block file, is damaged, or ends in
/// an open group.
ProofGroups parse_proof(std::string bytes, const std::string& name);

/// A fault to write on purpose.
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
