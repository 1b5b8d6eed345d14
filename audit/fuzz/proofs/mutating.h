// SPDX-License-Identifier: Apache-2.0
//
// Small changes that all mutations of proofs use. Internal to this folder.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <vector>

#include "audit/fuzz/proofs/proof_mutations.h"
#include "trajectory/blocks/bytes.h"

namespace noli::audit::mutating {

inline constexpr FourLetters claim = four_letters("CLAM"), labels = four_letters("LABL"), step = four_letters("STEP"),
                             tree = four_letters("TREE"), tokens = four_letters("TOKS"), witness = four_letters("WITN");
inline constexpr std::size_t step_size = 65;  ///< of the payload of a STEP

/// The blocks of these kinds, in their order.
inline std::vector<ProofBlock*> blocks_of(Mutating& m, std::initializer_list<FourLetters> kinds) {
  std::vector<ProofBlock*> found;
  for (ProofGroup& group : m.groups) {
    for (ProofBlock& block : group) {
      if (std::ranges::find(kinds, block.kind) != kinds.end()) found.push_back(&block);
    }
  }
  return found;
}

/// The blocks STEP that have a step's size.
inline std::vector<ProofBlock*> whole_steps(Mutating& m) {
  std::vector<ProofBlock*> found = blocks_of(m, {step});
  std::erase_if(found, [](const ProofBlock* block) { return block->payload.size() != step_size; });
  return found;
}

/// A random block of these kinds, all equally likely; nullptr if the proof has no such block.
inline ProofBlock* some_block(Mutating& m, std::initializer_list<FourLetters> kinds) {
  const std::vector<ProofBlock*> found = blocks_of(m, kinds);
  return found.empty() ? nullptr : found[m.random.below(found.size())];
}

/// Any index of something that is not empty.
template <class Items>
std::size_t some_index(Random& random, const Items& items) {
  return random.below(items.size());
}

/// Replaces the number at a place by a function of it; false if the payload is shorter.
template <class T, class Change>
bool change_field(std::string& payload, std::size_t at, const Change& change) {
  if (at + sizeof(T) > payload.size()) return false;
  std::string bytes;
  put(bytes, static_cast<T>(change(get<T>(payload.data() + at))));
  payload.replace(at, bytes.size(), bytes);
  return true;
}

/// Another integer near this one, or far from it.
inline std::int64_t other_integer(Random& random, std::int64_t n) {
  const auto wrapped = static_cast<std::uint64_t>(n);
  switch (random.below(9)) {
    case 0:
    case 1: return static_cast<std::int64_t>(wrapped + 1);
    case 2:
    case 3: return static_cast<std::int64_t>(wrapped - 1);
    case 4: return static_cast<std::int64_t>(0 - wrapped);
    case 5: return static_cast<std::int64_t>(wrapped * 2);
    case 6: return 0;
    case 7: return static_cast<std::int64_t>(wrapped << random.below(40));
    default: return static_cast<std::int64_t>(wrapped ^ std::uint64_t{1} << random.below(40));
  }
}

inline double other_double(Random& random, double x) {
  switch (random.below(9)) {
    case 0: return std::bit_cast<double>(std::bit_cast<std::uint64_t>(x) ^ std::uint64_t{1} << random.below(64));
    case 1: return x + 1;
    case 2: return x - 1;
    case 3: return -x;
    case 4: return random.one_in(2) ? 0.0 : -0.0;
    case 5: return x * 2;
    case 6: return x / 2;
    case 7: return x + 0x1p-20;
    default: {
      constexpr std::array<double, 4> odd = {std::numeric_limits<double>::infinity(),
                                             std::numeric_limits<double>::quiet_NaN(), 5e-324, 1e300};
      return random.one_of(odd);
    }
  }
}

/// Makes the hashes in the claim and the steps of a mutant those of its claim and frames, where it has any that can be
/// read.
void fit_hashes(Mutating& m);

/// The frames that a case is about. Precondition: it is not about a run.
FrameMotion frames_of(const ProofCase& from);

/// Bits flipped, bytes changed, inserted, deleted, repeated; from `low` on.
void change_bytes(Random& random, std::string& bytes, std::size_t low = 0);

}  // namespace noli::audit::mutating
