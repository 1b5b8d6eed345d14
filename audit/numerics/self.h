// SPDX-License-Identifier: Apache-2.0
//
// What a sceptical user runs: every way that `noli` has of looking at itself, one after the other, by the `noli`
// program itself, so that what is judged is what it says and how it exits.
//
// Parts
//   rounding   the rounding self-test of the program
//   labels     the labelled queries at hand, by `noli ccd`
//   fuzz       each fuzzer, for a time
//   proofs     what is verified or run, proved, and checked by each checker that is there: frames and scenes that the
//              program has in it (stability_rows.h), then the scenes of a folder, in their short forms and for a time
// A part *held*, *failed*, or was *skipped*, because what it needs is not there; what was skipped is not counted as
// held.
//
// What this does not do: it has no second opinion on what the parts say; each is as good as its own tests.
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
  std::filesystem::path program;                                 ///< the `noli` that looks at itself
  std::chrono::nanoseconds fuzz_time{std::chrono::seconds(60)};  ///< of each fuzzer
  std::chrono::nanoseconds scene_time{std::chrono::seconds(5)};  ///< of each scene of the folder
  std::uint64_t seed = 1;                                        ///< of fuzzers
  int threads = 0;                                               ///< 0: all there are
  std::optional<std::filesystem::path> data;                     ///< with queries/*.csv; nothing: skipped
  std::filesystem::path scenes;                                  ///< need not be there
  std::vector<std::string> only;                                 ///< groups; none: all
  std::filesystem::path out;                                     ///< folder for findings of fuzzers
  const std::atomic<bool>* stop = nullptr;
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
  bool complete = true;  ///< it was not stopped

  std::size_t count(PartState state) const;
};

/// Throws std::runtime_error when the program is not there, std::system_error when the machine does not do what it has
/// to.
SelfReport audit_self(const SelfOptions& options);

}  // namespace noli::audit
