// SPDX-License-Identifier: Apache-2.0
//
// The motion whose steps are decided in shards: frames in files, or a run.
//
// Notation
//   source   what the steps of a task were made from, as members of the shard's head: for frames `files`, each with its
//            SHA-256; for a run `windows`, the hashes of their groups in trajectory.blocks, one after another
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include <noli/verify.h>
#include "certify/json.h"
#include "certify/shards/shard_file.h"

namespace noli {

class ShardMotion {
 public:
  ShardMotion() = default;
  virtual ~ShardMotion() = default;
  ShardMotion(const ShardMotion&) = delete;
  ShardMotion& operator=(const ShardMotion&) = delete;

  /// Throws InputError when there is none.
  virtual std::uint64_t step_count() = 0;
  /// Waits until the motion has at least `count` steps, or gets no more: a run may still be written. Throws Stopped.
  virtual void wait_for(std::uint64_t /*count*/) {}
  /// Whether a whole shard was made from these steps as they are now. Throws InputError, Stopped.
  virtual bool is_source_of(const ShardReader& shard, const StepRange& range) = 0;
  /// The source of these steps, which were verified.
  virtual Json source(const VerifyOutcome& outcome, const StepRange& range) = 0;
};

/// Throws UsageError for what cannot be parted: frames in no regular file, lines that no checker can read. Waits for
/// windows that are still to come if `request.follow`. `request` must outlive it.
std::unique_ptr<ShardMotion> motion_of_shards(const VerifyRequest& request);

}  // namespace noli
