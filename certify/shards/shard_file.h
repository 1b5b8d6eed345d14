// SPDX-License-Identifier: Apache-2.0
//
// A shard: what was found in the steps of one task, and their proofs. A block file (trajectory/FORMAT.md) with the
// content `SHRD`, version 1:
//
//   file   =  TASK CMIT, then the groups of the task's steps as a proof file has them (proofs/FORMAT.md, section 2)
//   TASK   =  JSON: format, version, request (SHA-256 of request.json), task, first, end, groups, claim, touch, ends,
//             near, unproved, largest_distance, steps, and what they were made from (shard_motion.h): files or windows
//
// A part of a divided step has at most one group, its proof: STEP with only the step's number, TREE in the first part,
// and TOKS. Each piece of tokens has a TOKS of its own, so that joining gives the blocks that one process writes.
//
// `groups` says how many groups of steps follow, so a shard that was cut off is noticed before it is used.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <noli/errors.h>
#include <noli/frames.h>
#include <noli/proof.h>
#include "certify/json.h"
#include "proofs/prover/verifier.h"
#include "trajectory/blocks/block_file.h"

namespace noli {

/// What `read` reads of a file: what is not as it should be in JSON is an InputError about the file.
template <class Read>
auto reading(const std::string& file, const Read& read) {
  try {
    return read();
  } catch (const Json::exception& error) {
    throw InputError(file, "", error.what());
  } catch (const std::logic_error& error) {  // of numbers and words
    throw InputError(file, "", error.what());
  }
}

/// The claim as all shards of a request have it: how far a run goes is left out, as it may be being written.
Json shared_claim_json(Claim claim);

/// Writes a shard under another name first, so that it is there as a whole or not at all. `proof`: a proof file of the
/// task's steps, or nothing. `head` gets its member `groups`. Throws std::system_error, InputError.
void write_shard(const std::filesystem::path& file, Json head, const std::optional<std::filesystem::path>& proof);

/// The same for a part of a divided step. `proof`: of the part, or nullptr.
void write_part_shard(const std::filesystem::path& file, Json head, const StepProof* proof);

class ShardReader;

/// The name of the first of these files that is not the one that the shard was made from; nothing if all are. `files`:
/// all files of the frames, those that the shard was made from looked at. Throws InputError.
std::optional<std::string> other_input(const ShardReader& shard, const std::vector<FrameFacts>& files);

class ShardReader {
 public:
  /// Reads the head. Throws InputError when the file is not a whole shard of this request and task.
  ShardReader(const std::filesystem::path& file, const std::string& request_hash, std::uint64_t task);

  const Json& head() const { return head_; }
  const std::string& name() const { return reader_.name(); }
  /// Passes on the blocks of a step; nothing if the shard has none. Steps are asked for in ascending order. Throws
  /// InputError for a damaged file.
  void blocks(std::uint64_t step, const std::function<void(FourLetters, std::string_view)>& take);

 private:
  std::optional<Block> next_block();
  /// Number of the step whose blocks come next; nothing at the end.
  std::optional<std::uint64_t> next_step() const;

  BlockReader reader_;
  Json head_;
  std::optional<Block> next_;  ///< the first block of the next group
};

}  // namespace noli
