// SPDX-License-Identifier: Apache-2.0
//
// Runs every self-test of `noli`, one after the other, for users who want to check it themselves. Each part runs the
// `noli` program and judges its output and exit code.
//
// Parts
//   rounding   the rounding self-test of the program
//   labels     labelled queries from files, by `noli ccd`
//   fuzz       each fuzzer, for a limited time
//   proofs     proofs of verified frames and of scenes, checked by each checker that is installed: built-in examples
//              (stability_rows.h), then the scenes of a folder in their short forms, for a limited time
// A part *held*, *failed*, or was *skipped* because something it needs is missing. A skipped part does not count as
// held.
//
// The parts' own verdicts are not checked a second time: each is as good as its own tests.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "certify/json.h"

namespace noli::audit {

/// Groups of parts, in their order.
inline constexpr const char* self_groups[] = {"rounding", "labels", "fuzz", "proofs"};

struct SelfOptions {
  std::filesystem::path program;                                 ///< the `noli` to test
  std::chrono::nanoseconds fuzz_time{std::chrono::seconds(60)};  ///< for each fuzzer
  std::chrono::nanoseconds scene_time{std::chrono::seconds(5)};  ///< for each scene of the folder
  std::uint64_t seed = 1;                                        ///< for the fuzzers
  int threads = 0;                                               ///< 0: all processors
  std::optional<std::filesystem::path> data;                     ///< with queries/*.csv; unset: skipped
  std::filesystem::path scenes;                                  ///< need not exist
  std::vector<std::string> only;                                 ///< groups; empty: all
  std::filesystem::path out;                                     ///< folder for findings of fuzzers
  const std::atomic<bool>* stop = nullptr;
  bool require_all = false;                            ///< a skipped part makes the audit undecided
  std::function<void(const std::string& part)> begun;  ///< may be empty
};

enum class PartState { held, failed, skipped };

struct SelfPart {
  std::string group, name;
  PartState state = PartState::failed;
  std::string words;              ///< what failed, or why it was skipped; one line
  Json figures = Json::object();  ///< numbers
  bool by_clock = false;          ///< figures depend on how fast the machine is
  double seconds = 0;
};

struct SelfReport {
  std::vector<SelfPart> parts;
  bool complete = true;  ///< false if it was stopped

  bool refuted() const { return count(PartState::failed) > 0; }
  /// It was not stopped, nothing failed, and something held; with `require_all`, nothing was skipped.
  bool holds(bool require_all) const;
  std::size_t count(PartState state) const;
};

/// Throws std::runtime_error if the program does not exist, std::system_error if a system call fails.
SelfReport audit_self(const SelfOptions& options);

}  // namespace noli::audit
