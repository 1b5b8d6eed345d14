// SPDX-License-Identifier: Apache-2.0
//
// Summarises the folder of a run for `noli info`.
#pragma once

#include <filesystem>

#include "certify/json.h"

namespace noli {

/// Reads the run from beginning to end, one window at a time. Checks that its files are consistent, also with its log.
/// Throws InputError when it is not a run or is damaged.
Json run_info(const std::filesystem::path& folder);

}  // namespace noli
