// SPDX-License-Identifier: Apache-2.0
//
// The motion whose steps are decided in shards: frames in files, or a run.
//
// Notation
//   source   what the steps of a task were made from, as members of the shard's head: `files`, those of frames with
//            their SHA-256; `windows`, the hashes of the windows' groups in trajectory.blocks: of the first one of the
//            run, which says how cells are grouped, then of those of the task
#pragma once

#include <cstdint>
#include <functional>
#include <memory>

#include "certify/shards/shard_file.h"
#include "certify/verify_work.h"

namespace noli {

class ShardMotion {
 public:
  ShardMotion() = default;
  virtual ~ShardMotion() = default;
  ShardMotion(const ShardMotion&) = delete;
  ShardMotion& operator=(const ShardMotion&) = delete;

  /// The number of steps so far. Throws InputError if it is 0, unless the request has `follow`.
  virtual std::uint64_t step_count() = 0;
  /// Waits until the motion has at least `count` steps, or gets no more: a run may still be being written. Ends early
  /// if `needed` returns false. Throws Stopped.
  virtual void wait_for(std::uint64_t /*count*/, const std::function<bool()>& /*needed*/) {}
  /// Whether a whole shard was made from these steps as they are now. Throws InputError, Stopped.
  virtual bool is_source_of(const ShardReader& shard, const StepRange& range) = 0;
  /// For VerifyWork::before.
  virtual const CommitPoint* before(const StepRange& /*range*/) { return nullptr; }
};

/// Throws UsageError for what cannot be cut into parts: frames in no regular file, world lines in no file; with
/// `divide` also a run, first_only, only_new, ignore and a least distance. Waits for windows that are still to come if
/// `request.follow`. `request` must outlive it.
std::unique_ptr<ShardMotion> motion_of_shards(const VerifyWork& request);

}  // namespace noli
