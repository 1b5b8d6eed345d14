// SPDX-License-Identifier: Apache-2.0
//
// `noli simulate --reproduce`: integrates one window of a run again, from the state at its beginning.
#pragma once

#include <cstdint>
#include <filesystem>

#include "trajectory/blocks/sha256.h"

namespace noli {

struct ReproduceRequest {
  std::filesystem::path scene;
  bool brief = false;
  std::filesystem::path run;     ///< the run that has the window
  std::uint64_t window = 1;      ///< from 1
  std::filesystem::path output;  ///< a file for the block LINE of the window (trajectory/FORMAT.md)
};

struct ReproduceOutcome {
  bool same = false;  ///< the hash is that of the run
  Sha256Digest expected{}, found{};
  std::uint64_t breakpoints = 0;
};

/// Throws InputError (the scene, the run, no such window), UsageError, std::system_error.
ReproduceOutcome run_reproduce(const ReproduceRequest& request);

}  // namespace noli
