// SPDX-License-Identifier: Apache-2.0
//
// Verifies frames or a run in parts, by processes that share nothing but a folder, and joins what they found.
//
//   noli::verify_shard(request, {.folder = "shards", .number = 3, .of = 64});      // in each of 64 processes
//   noli::VerifyWork whole = noli::request_of_shards("shards");                    // in one, when all are done
//   whole.open_proof = noli::proof_to_file("all.noli");
//   const noli::VerifyOutcome outcome = noli::run_verify(whole);                   // decides nothing again
//
// Notation
//   task      16 steps of the frames, the chain of proofs/prover/chain.h, or 16 windows of a run; tasks count from 0
//   shard     the file of a finished task: what was found in its steps, and their proof
//   part      with `divide`, one of the parts_of_step parts of the only step (proofs/prover/verifier.h): each is a task
//   shard K of N   the tasks K - 1, K - 1 + N, K - 1 + 2 N, ...
//
// The joined outcome, and the bytes of its proof, are those of one process that verifies all. Joining hashes all frames
// again, and reads them where a proof or a list of contacts needs it; of a run it reads all windows. No step is decided
// twice. A process that was killed leaves the shards that it had finished, and the same call then does the rest.
//
// Errors: as each function says. Thread safety: any thread; processes may work in one folder at the same time.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>

#include "certify/verify_work.h"

namespace noli {

/// How many parts a divided step has: not the number of processes, on which no shard may depend.
inline constexpr std::uint32_t parts_of_step = 64;

/// Which tasks one process does, and where their shards are.
struct ShardWork {
  std::filesystem::path folder;
  std::uint64_t number = 1, of = 1;
  /// The tasks one after another instead, ascending; nothing when there are no more.
  std::function<std::optional<std::uint64_t>()> next_task = {};
  /// Called when no task after those that were given is needed: something touches.
  std::function<void()> no_more = {};
  /// Whether tasks are still needed whose windows are not there yet; another process may know.
  std::function<bool()> are_needed = {};
};

struct ShardOutcome {
  std::uint64_t tasks_total = 0;             ///< of all frames, or of the run as it was last seen
  std::uint64_t done = 0;                    ///< tasks that this call finished
  std::uint64_t already_done = 0;            ///< tasks that were finished before, of the files as they are now
  std::uint64_t not_needed = 0;              ///< tasks after a contact
  std::optional<std::uint64_t> first_touch;  ///< the first step, from 1, of these tasks in which something touches
  std::optional<std::uint64_t> first_near;   ///< the same where something comes too near
  bool unproved = false;                     ///< the request needs a proof, and none was found of some step
  bool interrupted = false;                  ///< by the user; tasks are missing
  bool out_of_time = false;

  bool complete() const { return !interrupted && !out_of_time; }
  /// Not while tasks are missing, whatever was found: the rest is undecided.
  bool refuted() const { return complete() && (first_touch || first_near); }
  bool holds() const { return complete() && !refuted() && !unproved; }
};

/// A folder for the shards of a request that no other request has: noli-shards-HASH in the current folder.
std::filesystem::path usual_shard_folder(const VerifyWork& request);

/// Does tasks of a request and writes their shards; the folder is made if it is not there. Proofs are made if the
/// request has `check`, `proof`, or a least distance. Of a run that is being written, it does the windows that are
/// there, with `follow` also those to come. Throws as run_verify(), and UsageError for what cannot be cut into parts:
/// frames that are in no regular file, world lines that are in no file and are to be checked, shards of another request
/// in the folder; with `divide` also more than one step, first_only, only_new, ignore, and a least distance.
ShardOutcome verify_shard(const VerifyWork& request, const ShardWork& work);

/// The request whose shards are in a folder, for run_verify(), which then throws InputError when a shard is missing,
/// damaged, or was made from other files or windows. Whether and how a proof is written, threads and limits are for the
/// caller to set. One run_verify() at a time. Throws InputError when the folder has no shards of this version, or the
/// run is not there.
VerifyWork request_of_shards(const std::filesystem::path& folder);

}  // namespace noli
